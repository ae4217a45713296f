// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_memory.h"

#include <catch2/catch.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "geometry/mesh/sheet.h"
#include "geometry/mesh/struts.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A short ridge of 4 cm on a sheet of 0.9 m, or a valley.
Stroke ridge(double x, double y, double angle, double height = 0.006) {
  Stroke stroke;
  stroke.name = "at " + std::to_string(x);
  stroke.height = height;
  stroke.width = 0.04;
  const double c = 0.05 * std::cos(angle), s = 0.05 * std::sin(angle);
  stroke.points = {{x - c, y - s, 0}, {x, y, 0}, {x + c, y + s, 0}};
  return stroke;
}

struct Drawn {
  std::string bits;
  WrinkleReport report;
};

Drawn drawn(const std::vector<Stroke>& strokes, const std::shared_ptr<FoldMemory>& memory) {
  Mesh mesh = equilateral_sheet(0.9, 0.9, 0.03);
  WrinkleOptions options;
  options.memory = memory;
  WrinkleReport report = wrinkle(mesh, strokes, options);
  REQUIRE(mesh.is_valid());
  return {bits_of(mesh), std::move(report)};
}

/// All that is drawn with what is remembered has the bits of what is drawn at once.
void check_same(const std::vector<Stroke>& strokes, const std::shared_ptr<FoldMemory>& memory) {
  const Drawn a = drawn(strokes, memory), b = drawn(strokes, nullptr);
  CHECK(a.bits == b.bits);
  REQUIRE(a.report.lines.size() == strokes.size());
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    CHECK(a.report.lines[i].name == strokes[i].name);
    CHECK(a.report.lines[i].chains == b.report.lines[i].chains);
    CHECK(a.report.lines[i].smoothed_height == b.report.lines[i].smoothed_height);
    CHECK(a.report.lines[i].path == b.report.lines[i].path);
  }
  CHECK(a.report.undisplaced == b.report.undisplaced);
  CHECK(a.report.insertion.changed_faces == b.report.insertion.changed_faces);
  CHECK(a.report.insertion.inserted == b.report.insertion.inserted);
  CHECK(a.report.warnings == b.report.warnings);
}

}  // namespace

TEST_CASE("fold_memory: lines drawn one by one are those drawn at once, bit for bit") {
  const auto memory = make_fold_memory();
  std::vector<Stroke> strokes;
  for (const auto& [x, y] : {std::pair{-0.25, 0.2}, {0.25, 0.2}, {-0.25, 0.65}, {0.25, 0.65}}) {
    strokes.push_back(ridge(x, y, 3 * x + y));
    check_same(strokes, memory);
    CHECK(memory->folded() == strokes.size());  // the new one alone
  }
  strokes.push_back(ridge(0.25, 0.21, 1.5, -0.005));  // crosses the second, after which two others came
  check_same(strokes, memory);
  CHECK(memory->folded() == 4 + 3);
  strokes.pop_back();
  check_same(strokes, memory);
  CHECK(memory->folded() == 7);  // it was known
}

TEST_CASE("fold_memory: a line that is changed or left out takes those after it along, and none before") {
  const auto memory = make_fold_memory();
  std::vector<Stroke> strokes;
  for (int i = 0; i < 4; ++i) strokes.push_back(ridge(-0.3 + 0.2 * i, 0.45, 1.4));
  check_same(strokes, memory);
  CHECK(memory->folded() == 4);
  strokes[2].height = 0.004;
  check_same(strokes, memory);
  CHECK(memory->folded() == 6);
  strokes.erase(strokes.begin() + 1);
  check_same(strokes, memory);
  CHECK(memory->folded() == 8);
}

TEST_CASE("fold_memory: another garment, or other options, are not taken for the same") {
  const auto memory = make_fold_memory();
  const std::vector<Stroke> strokes{ridge(0, 0.3, 0), ridge(0, 0.6, 0)};
  const Drawn one = drawn(strokes, memory);
  Mesh mesh = equilateral_sheet(0.9, 0.9, 0.029);
  WrinkleOptions options;
  options.memory = memory;
  wrinkle(mesh, strokes, options);
  CHECK(memory->folded() == 4);
  Mesh fine = equilateral_sheet(0.9, 0.9, 0.03);
  options.detail = Detail::fine;
  wrinkle(fine, strokes, options);
  CHECK(memory->folded() == 6);
  CHECK(bits_of(fine) != one.bits);
}

TEST_CASE("fold_memory: random strokes that touch, cross or lie apart come to the same bits one by one") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.1, 0.8), angle(0, 3.1);
  for (int round = 0; round < 4; ++round) {
    const auto memory = make_fold_memory();
    std::vector<Stroke> strokes;
    for (int i = 0; i < 5; ++i) {
      strokes.push_back(ridge(place(random) - 0.45, place(random), angle(random), i % 2 ? -0.004 : 0.006));
      drawn(strokes, memory);
    }
    check_same(strokes, memory);
    strokes.erase(strokes.begin() + 2);
    check_same(strokes, memory);
  }
}

TEST_CASE("fold_memory: a line that is gathered more than before has the thread that it asks for now") {
  const auto memory = make_fold_memory();
  for (const std::optional<double> share :
       {std::optional(0.8), std::optional(0.6), std::optional<double>()}) {
    std::vector<Stroke> strokes{ridge(0, 0.45, 1.4)};
    strokes[0].gather = share;
    Mesh known = equilateral_sheet(0.9, 0.9, 0.03), anew = known;
    WrinkleOptions options;
    const WrinkleReport report = wrinkle(anew, strokes, options);
    options.memory = memory;
    CHECK(wrinkle(known, strokes, options).lines[0].gather == report.lines[0].gather);
    const std::vector<Strut> a = struts(known), b = struts(anew);
    REQUIRE(a.size() == b.size());
    CHECK(a.empty() == !share);
    for (std::size_t i = 0; i < a.size(); ++i)
      CHECK((a[i].a == b[i].a && a[i].b == b[i].b && a[i].rest_length == b[i].rest_length));
  }
}
