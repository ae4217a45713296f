// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/garment_list.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

std::string path_of(std::size_t i) { return "garment." + std::to_string(i); }

/// With the i-th garment in place of the list.
TomlDocument document_with(const TomlDocument& document, std::size_t i) {
  TomlDocument own{document.root, {}, document.name};
  own.root["garment"] = document.root["garment"][i];
  const std::string before = path_of(i);
  for (const auto& [path, place] : document.where) {
    if (path == before || path.rfind(before + ".", 0) == 0)
      own.where["garment" + path.substr(before.size())] = place;
    else if (path != "garment" && path.rfind("garment.", 0) != 0)
      own.where[path] = place;
  }
  return own;
}

[[noreturn]] void fail(const TomlDocument& document, std::size_t i, const char* key,
                       const std::string& what) {
  throw geometry::ContentError(document.place(path_of(i) + "." + key) + ": " + what);
}

void check_list(const TomlDocument& document) {
  const Json& list = document.root["garment"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_object()) fail(document, i, "", "each garment must be a table: write [[garment]]");
    if (list.size() > 1 && !list[i].contains("mesh"))
      fail(document, i, "mesh", "garment.mesh is missing; of several garments each names its own");
    for (std::size_t k = 0; k < i; ++k) {
      if (list[i].contains("layer") != list[k].contains("layer"))
        fail(document, i, "layer",
             "garment.layer: some garments have one and others do not; give it to all of them, or to none "
             "and write the innermost first");
      if (list[i].contains("layer") && list[i]["layer"] == list[k]["layer"])
        fail(document, i, "layer",
             "garment.layer = " + value_text(list[i]["layer"]) + " is that of another garment, too");
      if (list[i]["mesh"] == list[k]["mesh"])
        fail(document, i, "mesh",
             "garment.mesh = " + value_text(list[i]["mesh"]) +
                 " is another garment's, too: no garment is worn over itself");
    }
  }
}

}  // namespace

std::vector<TomlDocument> scenes_by_garment(const TomlDocument& document) {
  const auto list = document.root->find("garment");
  if (list == document.root->end() || !list->is_array()) return {document};
  check_list(document);
  std::vector<std::size_t> order(list->size());
  std::iota(order.begin(), order.end(), 0);
  const auto layer = [&](std::size_t i) {
    const Json& garment = (*list)[i];
    const bool known = garment.contains("layer") && garment["layer"].is_number();
    return known ? garment["layer"].get<double>() : 0;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return layer(a) < layer(b); });
  std::vector<TomlDocument> documents;
  for (const std::size_t i : order) documents.push_back(document_with(document, i));
  return documents;
}

}  // namespace furrow::io
