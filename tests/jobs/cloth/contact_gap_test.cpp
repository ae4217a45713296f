// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/rest/rest_metric.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/state_file.h"
#include "jobs/body/world_body.h"

using namespace furrow;

namespace {

geometry::Mesh sheet_with_lines(geometry::InsertionRule rule, int lines) {
  geometry::Mesh mesh = geometry::equilateral_sheet(1, 1, 0.04);
  std::vector<geometry::Stroke> strokes;
  for (int i = 0; i < lines; ++i) {
    geometry::Stroke stroke;
    stroke.name = "line " + std::to_string(i);
    stroke.height = 0.006;
    if (rule == geometry::InsertionRule::fold) stroke.width = 0.04;
    stroke.points = {{0.1 * i - 0.25, 0.1, 0}, {0.1 * i - 0.25, 0.9, 0}};
    strokes.push_back(stroke);
  }
  geometry::WrinkleOptions options;
  options.insertion.rule = rule;
  if (lines > 0) geometry::wrinkle(mesh, strokes, options);
  geometry::ensure_rest_lengths(mesh);
  return mesh;
}

double sag_by_count(const geometry::Mesh& mesh) {
  std::vector<double> lengths = geometry::rest_lengths(mesh);
  std::sort(lengths.begin(), lengths.end());
  const double l = lengths[static_cast<std::size_t>(0.95 * double(lengths.size() - 1))];
  return l * l / (8 * 0.05);
}

}  // namespace

TEST_CASE("edge_sag: the fine cloth of folds does not hide the long edges beside it", "[long]") {
  const geometry::Mesh plain = sheet_with_lines(geometry::InsertionRule::fold, 0),
                       folded = sheet_with_lines(geometry::InsertionRule::fold, 5);
  REQUIRE(sag_by_count(folded) < 0.7 * jobs::edge_sag(plain));  // so it was
  CHECK(jobs::edge_sag(folded) == Approx(jobs::edge_sag(plain)).epsilon(0.1));
}

TEST_CASE("tolerance_for: lines that are drawn into a state leave the field as it was") {
  const auto with_gap = [](int lines) {
    io::SavedState state;
    state.file.mesh = sheet_with_lines(geometry::InsertionRule::safe, lines);
    io::WrinkleRecord record;
    record.contact_gap = 0.002;
    io::set_wrinkle_record(state.file, record);
    return state;
  };
  const io::SavedState before = with_gap(0);
  io::SavedState after = with_gap(4);
  REQUIRE(jobs::tolerance_for(after.file) != jobs::tolerance_for(before.file));
  after.field_tolerance = 7e-4;
  const io::SavedState read = io::parse_state(io::state_bytes(after), "state.ply");
  CHECK(jobs::tolerance_for(read) == 7e-4);
}

TEST_CASE("edge_sag: cloth without folds, and with lines of the rule safe, keeps its bits") {
  for (const int lines : {0, 2}) {
    const geometry::Mesh mesh = sheet_with_lines(geometry::InsertionRule::safe, lines);
    CHECK(jobs::edge_sag(mesh) == sag_by_count(mesh));
  }
}
