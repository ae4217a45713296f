// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cctype>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/errors.h"
#include "geometry/rest/fold_rest.h"
#include "geometry/stroke/place_path_stroke.h"
#include "tests/geometry/insert/insertion_meshes.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

namespace furrow::tests {

using namespace geometry;

namespace {

/// What became of many folds.
struct Tally {
  std::size_t drawn = 0, refused = 0;
  std::vector<double> angles;  ///< smallest of each case, at rest, that had no smaller one before [degrees]
  std::vector<std::string> faults;             ///< what must not be
  std::map<std::string, std::size_t> reasons;  ///< of refusals, without names and numbers

  std::string reasons_text() const {
    std::string text;
    for (const auto& [reason, count] : reasons) text += std::to_string(count) + " times: " + reason + "\n";
    return text;
  }
  double share_below(double angle) const {
    const auto below = std::count_if(angles.begin(), angles.end(), [&](double a) { return a < angle; });
    return static_cast<double>(below) / static_cast<double>(std::max<std::size_t>(angles.size(), 1));
  }
};

/// Folds a copy of a mesh; a refusal must name the stroke and leave the mesh as it was.
void fold_copy(const Mesh& garment, const std::vector<Stroke>& strokes, double max_distance,
               const std::string& what, Tally& tally) {
  Mesh mesh = garment;
  WrinkleOptions options;
  options.insertion.rule = InsertionRule::fold;
  options.insertion.max_distance = max_distance;
  try {
    const WrinkleReport report = wrinkle(mesh, strokes, options);
    ++tally.drawn;
    if (report.fold->min_angle_before_deg >= 15) tally.angles.push_back(report.fold->min_angle_deg);
    if (report.fold->invalid_faces > 0 || invalid_rest_faces(mesh) > 0)
      tally.faults.push_back(what + ": invalid triangles at rest");
    for (const WrinkledLine& line : report.lines)
      if (strokes.size() == 1 && line.crest_height && *line.crest_height * line.height < 0)
        tally.faults.push_back(what + ": a fold to the wrong side");
    for (Vertex v : mesh.vertices())
      if (!std::isfinite(mesh.point(v).x() + mesh.point(v).y() + mesh.point(v).z()))
        tally.faults.push_back(what + ": a place that is no number");
    const bool thin = report.fold->min_angle_deg < std::min(3.0, report.fold->min_angle_before_deg / 2);
    const bool told = std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& w) {
      return w.find("too thin") != std::string::npos;
    });
    if (thin != told) tally.faults.push_back(what + ": thin faces and their warning do not agree");
  } catch (const ContentError& e) {
    ++tally.refused;
    std::string reason = e.what();
    std::erase_if(reason, [](char c) { return std::isdigit(static_cast<unsigned char>(c)) || c == '.'; });
    ++tally.reasons[reason];
    if (std::string(e.what()).find("stroke") == std::string::npos)
      tally.faults.push_back(what + ": " + e.what());
    if (mesh.num_vertices() != garment.num_vertices()) tally.faults.push_back(what + ": a changed mesh");
  }
}

double distance(const Point& a, const Point& b) { return std::sqrt((a - b).squared_length()); }

/// From one vertex to another, 8 to 40 cm away, with a height of 5 to 30 mm and 3 to 8 times that as width.
Stroke random_fold(const Mesh& mesh, std::mt19937& random, int number) {
  const auto in = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto vertex = [&] { return static_cast<std::size_t>(random() % mesh.num_vertices()); };
  Stroke stroke;
  stroke.name = "fold " + std::to_string(number);
  stroke.height = (random() % 2 ? 1 : -1) * in(0.005, 0.03);
  if (random() % 3) stroke.width = std::abs(stroke.height) * in(3, 8);
  for (int i = 0; i < 1000 && stroke.points.empty(); ++i) {
    const std::array<std::size_t, 2> ends{vertex(), vertex()};
    const auto place = [&](std::size_t v) { return mesh.point(Vertex(static_cast<Vertex::size_type>(v))); };
    const double apart = distance(place(ends[0]), place(ends[1]));
    if (apart < 0.08 || apart > 0.4) continue;
    try {
      const PlacedStroke placed = place_path_stroke(mesh, ends, false, stroke.name);
      stroke.points.assign(placed.points.begin(), placed.points.end());
      stroke.closed = false;
    } catch (const ContentError&) {  // no cloth joins them
    }
  }
  return stroke;
}

}  // namespace

TEST_CASE("wrinkle: twenty random folds on each garment are sound, or refused by name", "[release]") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  Tally all;
  for (const std::string name :
       {"mh_male/tshirt", "mh_male/longsleeve", "mh_male/trousers", "mh_female/skirt", "mh_female/top",
        "mh_female/leggings", "mh_female/bodysuit"}) {
    const Mesh mesh = read_plain_obj(shared_dir() / "meshes" / "pairs" / (name + ".obj"));
    std::mt19937 random(18);
    for (int i = 0; i < 20; ++i) {
      const Stroke stroke = random_fold(mesh, random, i);
      REQUIRE(!stroke.points.empty());
      fold_copy(mesh, {stroke}, 0.05, name + ", " + stroke.name, all);
    }
  }
  CAPTURE(all.drawn, all.refused, all.share_below(3), all.share_below(10));
  CHECK(all.faults == std::vector<std::string>{});
  CHECK(all.drawn + all.refused == 140);
  CHECK(all.refused <= 7);
  CHECK(all.share_below(3) <= 0.02);
}

TEST_CASE("wrinkle: random sets of folds on random sheets are sound, or refused by name", "[release]") {
  Tally all;
  for (int seed = 0; seed < FURROW_PROPERTY_CASES; ++seed) {
    std::mt19937 random(seed);
    const auto in = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    const Mesh mesh = random_sheet(static_cast<std::uint64_t>(seed), 15);
    std::vector<Stroke> strokes(1 + random() % 3);
    for (Stroke& stroke : strokes) {
      stroke.name = "fold";
      stroke.height = (random() % 2 ? 1 : -1) * in(0.01, 0.06);
      const int points = 2 + static_cast<int>(random() % 7);
      for (int i = 0; i < points; ++i) {
        const Point p(in(-0.03, 1.03), in(-0.03, 1.03), 0);
        const Vertex near = nearest_vertex(mesh, p);
        stroke.points.push_back(random() % 5 ? Point(p.x(), p.y(), mesh.point(near).z()) : mesh.point(near));
      }
      stroke.closed = points > 2 && random() % 4 == 0;
    }
    fold_copy(mesh, strokes, 0.3, "case " + std::to_string(seed), all);
  }
  CAPTURE(all.drawn, all.refused, all.reasons_text(), all.share_below(3), all.share_below(10));
  CHECK(all.faults == std::vector<std::string>{});
  // Half of these sets hold a stroke that crosses itself, and many graze each other or the border.
  CHECK(all.refused <= 2);
  CHECK(all.share_below(3) <= 0.02);
  CHECK(all.share_below(10) <= 0.12);
}

}  // namespace furrow::tests
