// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/own_output.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "io/base/nesting.h"
#include "io/base/own_mark.h"
#include "io/mesh/mesh_formats.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t looked_at = 1 << 24;        // of a file's beginning [bytes]
constexpr std::uintmax_t longest_json = 1 << 26;  // [bytes]

/// A file, how it begins, and how it ends.
struct Ends {
  fs::path path;
  std::uintmax_t size = 0;
  std::string head;  ///< at most looked_at bytes
  std::string tail;  ///< at most 100 bytes

  bool begins(std::string_view word) const { return head.starts_with(word); }
  bool has(std::string_view word) const { return head.find(word) != head.npos; }
  bool ends(std::string_view word) const { return tail.ends_with(word); }
};

bool is_own_mesh(const Ends& file) {
  return std::ranges::any_of(io::mesh_endings(), [&](const io::MeshEnding& e) {
    return e.is_own && e.is_own(file.head, file.tail);
  });
}

/// PC2 and MDD; the latter has no word at its beginning.
bool is_own_point_cache(const Ends& file) { return file.ends(io::own_tail); }

bool is_own_png(const Ends& file) {
  return file.begins("\x89PNG\r\n\x1a\n") && file.ends(std::string(io::png_mark).append(io::png_end));
}

/// Strokes, a camera or a record of maps; laid out to the byte as furrow does it, as people change numbers in
/// such files, and add lines.
bool is_own_json(const Ends& file) {
  if (!file.begins("{") || file.size > longest_json) return false;
  std::ifstream in(file.path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (io::is_nested_too_deep(text)) return false;
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return false;
  const bool is_marked = json.contains("generator") && json["generator"] == io::own_generator;
  if (!is_marked && !json.contains("furrow_maps")) return false;
  const int indent = json.contains("strokes") ? 1 : json.contains("furrow_maps") ? 2 : -1;
  return text == json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool is_own_chart(const Ends& file) {
  return file.begins("name,integrator,dt,cost,error,error_is") ||
         (file.begins("<?xml") && file.ends("<!-- " + std::string(io::own_mark) + " -->\n"));
}

bool is_own_batch(const Ends& file) {
  return (file.begins("<!DOCTYPE html>\n") && file.has(batch_page_mark)) ||
         (file.begins("{\"case\":\"") && file.has("\",\"values\":{"));
}

bool is_own_manual(const Ends& file) { return file.begins(".TH \"FURROW") && file.has("\"Furrow\""); }

Ends ends_of(const fs::path& path) {
  Ends file{path, fs::file_size(path), {}, {}};
  std::ifstream in(path, std::ios::binary);
  const auto read = [&](std::string& part, std::uintmax_t most) {
    part.resize(std::min(most, file.size));
    in.read(part.data(), std::streamsize(part.size()));
    part.resize(std::size_t(std::max<std::streamsize>(0, in.gcount())));
  };
  read(file.head, looked_at);
  in.clear();
  in.seekg(-std::streamoff(std::min<std::uintmax_t>(100, file.size)), std::ios::end);
  read(file.tail, 100);
  return file;
}

}  // namespace

bool is_own_output(const fs::path& path) {
  std::error_code error;
  if (fs::file_size(path, error) == 0 && !error) return true;
  if (error) return false;
  const Ends file = ends_of(path);
  for (const auto is_own :
       {is_own_mesh, is_own_point_cache, is_own_png, is_own_json, is_own_chart, is_own_batch, is_own_manual})
    if (is_own(file)) return true;
  return false;
}

}  // namespace furrow::jobs
