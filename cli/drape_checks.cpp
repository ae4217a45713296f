// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/drape_checks.h"

#include <algorithm>
#include <cstdlib>

#include "io/scene/settings_schema.h"

namespace furrow::cli {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

}  // namespace

std::vector<Band> parse_bands(const std::vector<std::string>& texts) {
  std::vector<Band> bands;
  for (const std::string& text : texts) {
    const auto fail = [&](const std::string& what) {
      throw UsageError(
          "--band " + text + ": " + what +
          "; write a border loop and the band's length as a share of the loop's: --band top=0.95 "
          "is a band 5 % shorter than the garment's upper border");
    };
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) fail("there is no length");
    if (equals == 0) fail("there is no loop");
    const std::string loop = text.substr(0, equals), number = text.substr(equals + 1);
    char* end = nullptr;
    const double length = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != 0) fail("'" + number + "' is no number");
    if (!(length > 0 && length <= 2)) fail("the length must be above 0 and at most 2");
    if (std::any_of(bands.begin(), bands.end(), [&](const Band& b) { return b.loop == loop; }))
      fail("'" + loop + "' has a band already");
    bands.push_back({loop, length});
  }
  return bands;
}

std::vector<std::string> parse_fabrics(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    names.push_back(trimmed(text.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  if (std::find(names.begin(), names.end(), "") != names.end())
    throw UsageError(
        "--compare '" + text +
        "': a name is missing; write fabrics parted by commas, as in --compare cotton,silk,denim");
  return names;
}

void warn_of_unused_settings(const io::TomlDocument& document, const CommonArguments& common) {
  std::string names;
  for (const std::string& path : io::settings_without_use(document, io::used_by::drape))
    names += (names.empty() ? "" : ", ") + path;
  if (!names.empty()) warn("a garment at rest has no use for " + names + "; furrow simulate has", common);
}

}  // namespace furrow::cli
