// SPDX-License-Identifier: GPL-3.0-or-later
// J6: three garments on two bodies in two fabrics, under names that a shell or a page could take for
// something else, and the page that is made of them.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>

#include "tests/journeys/journey.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

/// A tube about the y axis, its radius linear from its top to its bottom, closed or open at both ends.
std::string tube(int columns, int rows, std::array<double, 2> heights, std::array<double, 2> radii,
                 bool closed) {
  std::ostringstream v, f;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double t = double(j) / rows, a = 2 * std::numbers::pi * i / columns;
      const double r = std::lerp(radii[0], radii[1], t);
      v << "v " << r * std::sin(a) << " " << std::lerp(heights[0], heights[1], t) << " " << r * std::cos(a)
        << "\n";
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * columns + i + 1, b = j * columns + (i + 1) % columns + 1;
      f << "f " << a << " " << a + columns << " " << b + columns << " " << b << "\n";
    }
  const int last = columns * (rows + 1);
  if (closed) v << "v 0 " << heights[0] << " 0\nv 0 " << heights[1] << " 0\n";
  for (int i = 0; closed && i < columns; ++i) {
    const int next = (i + 1) % columns;
    f << "f " << last + 1 << " " << i + 1 << " " << next + 1 << "\n";
    f << "f " << last + 2 << " " << rows * columns + next + 1 << " " << rows * columns + i + 1 << "\n";
  }
  return v.str() + f.str();
}

std::string in_quotes(const std::string& name) {
  std::string word = "'";
  for (const char c : name) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; ++at) ++n;
  return n;
}

const std::string plan = R"(title = "Skirts & <sizes>"
output = "fits; $(rm) {}"
[options]
subdivide = 0
size = "240,200"
quality = "draft"
[cases]
garment = ["my 'best' skirt.obj", 'skirt "B" & C.obj', "short {x}.obj"]
body = ["anna b.obj", "berta's.obj"]
fabric = ["cotton", "silk"]
)";

}  // namespace

TEST_CASE("journey: a batch of odd names comes to the numbers of single runs, and to a page that opens",
          "[release]") {
  const Journey journey;
  write_text("my 'best' skirt.obj", tube(16, 6, {0.9, 0.5}, {0.155, 0.24}, false));
  write_text("skirt \"B\" & C.obj", tube(16, 5, {0.88, 0.6}, {0.16, 0.25}, false));
  write_text("short {x}.obj", tube(12, 3, {0.85, 0.7}, {0.17, 0.22}, false));
  write_text("anna b.obj", tube(24, 12, {1.2, 0.2}, {0.1, 0.27}, true));
  write_text("berta's.obj", tube(24, 12, {1.2, 0.2}, {0.105, 0.28}, true));
  write_text("my plan.toml", plan);
  CHECK(json::parse(run_furrow("batch parallel 'my plan.toml' --json").out)["finished"] == 12);
  std::istringstream rows(read_text("fits; $(rm) {}/results.jsonl"));
  std::size_t cases = 0;
  for (std::string line; std::getline(rows, line); ++cases) {
    const json row = json::parse(line), values = row["values"], report = row["report"];
    const auto word = [&](const char* key) { return in_quotes(values[key].get<std::string>()); };
    const json single = step("drape " + word("garment") + " --body " + word("body") + " --fabric " +
                                 word("fabric") + " --subdivide 0 -o single.ply",
                             row["exit"].get<int>());
    INFO(line);
    for (const char* key : {"outcome", "residual_force", "fit", "crossings"})
      CHECK(report[key] == single[key]);
    CHECK(read_text(std::filesystem::path("fits; $(rm) {}") / row["mesh"].get<std::string>()) ==
          read_text("single.ply"));
  }
  CHECK(cases == 12);
  const std::string page = read_text("fits; $(rm) {}/report.html");
  CHECK(page.starts_with("<!DOCTYPE html>\n"));
  CHECK(page.ends_with("</body></html>\n"));
  CHECK(count_of(page, "<tr>") == 13);
  CHECK(count_of(page, "src=\"data:image/png;base64,") == 12);
  CHECK(count_of(page, "skirt &quot;B&quot; &amp; C.obj") == 4);
  CHECK(page.find("<h1>Skirts &amp; &lt;sizes&gt;</h1>") != page.npos);
  CHECK(page.find("http") == page.npos);  // no network

  write_text("bad.toml", std::regex_replace(plan, std::regex("berta's.obj"), "ber\\nta.obj"));
  CHECK(run_furrow("batch parallel bad.toml").exit_code == 3);
}
