// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke/resolve_strokes.h"

#include <rapidcheck.h>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/face_point.h"
#include "geometry/stroke/place_view_stroke.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A wavy sheet at z = 0, seen from +z.
io::MeshFile wavy_garment() {
  io::MeshFile file;
  file.mesh = jittered(24, 24, 0.2, 11);
  lift(file.mesh, [](double x, double y) { return 0.03 * std::sin(8 * x) * std::sin(6 * y); });
  return file;
}

/// Where a point is seen; written apart from line_of_sight(): by a projection matrix.
std::array<double, 2> pixel_of(const io::CameraPicture& picture, const Point& p) {
  using Eigen::Vector3d;
  const io::Camera& c = picture.camera;
  const Vector3d eye(c.eye.data()), target(c.target.data()), up(c.up.data());
  Eigen::Matrix3d view;
  view.row(2) = (eye - target).normalized();
  view.row(0) = up.cross(view.row(2).transpose()).normalized();
  view.row(1) = view.row(2).cross(view.row(0));
  const Vector3d v = view * (Vector3d(p.x(), p.y(), p.z()) - eye);
  const double focal = picture.height / 2.0 / std::tan(c.field_of_view_deg * std::numbers::pi / 360);
  const double scale = c.parallel_height ? picture.height / *c.parallel_height : focal / -v.z();
  return {picture.width / 2.0 + scale * v.x() - 0.5, picture.height / 2.0 - scale * v.y() - 0.5};
}

}  // namespace

TEST_CASE("resolve_strokes: a stroke drawn in the pixels of a picture lies where they were seen", "[long]") {
  CHECK(rc::check([] {
    const io::MeshFile garment = wavy_garment();
    const SurfaceProjector projector(garment.mesh);
    const auto share = [] { return *rc::gen::inRange(0, 1001) / 1000.; };
    io::CameraPicture picture{
        {{share(), share(), 2.5 + share()}, {0.5, 0.5, 0}, {share() - 0.5, 1, 0}, 20 + 40 * share()},
        *rc::gen::inRange(50, 2000),
        *rc::gen::inRange(50, 2000)};
    if (*rc::gen::arbitrary<bool>()) picture.camera.parallel_height = 0.5 + share();
    io::DrawnStroke drawn;
    io::PictureStroke on{picture, {}};
    std::vector<Point> points;
    for (int i = *rc::gen::inRange(1, 5); i > 0; --i) {
      points.push_back(
          projector.first_hit({0.05 + 0.9 * share(), 0.05 + 0.9 * share(), 9}, {0, 0, -1})->position);
      on.pixels.push_back(pixel_of(picture, points.back()));
    }
    drawn.on = on;
    const io::ResolvedStrokes resolved = io::resolve_strokes({&drawn, 1}, garment);
    for (const std::string& warning : resolved.warnings)  // a camera may look past a point
      RC_ASSERT(warning.find("outside of the camera's picture") != std::string::npos);
    const Stroke& stroke = resolved.strokes.at(0);
    std::size_t at = 0;
    for (const Point& p : points) {
      while (at < stroke.points.size() && CGAL::squared_distance(Point(stroke.points[at]), p) > 1e-9) ++at;
      RC_ASSERT(at < stroke.points.size());
    }
  }));
}

TEST_CASE("resolve_strokes: each kind by its own way, names and heights are kept") {
  io::MeshFile garment = wavy_garment();
  garment.group_names = {"front", "back"};
  auto texture = ensure_map(garment.mesh, attribute::texture);
  for (Halfedge h : garment.mesh->halfedges())
    texture[h] = {garment.mesh->point(garment.mesh->target(h)).x(),
                  garment.mesh->point(garment.mesh->target(h)).y()};
  auto group = ensure_map(garment.mesh, attribute::group);
  for (Face f : garment.mesh->faces()) group[f] = 0;
  std::vector<io::DrawnStroke> drawn(3);
  drawn[0].stroke = {"space", 0.02, {{0.1, 0.1, 0.5}, {0.2, 0.3, 0.5}}, false, Vector(0, 0, -1)};
  drawn[1].stroke = {"flat", -0.02, {}, false, {}};
  drawn[1].on = io::TextureStroke{{{0.2, 0.3}, {0.7, 0.4}}, "front", {}};
  drawn[2].stroke = {"path", 0.03, {}, true, {}};
  drawn[2].on = io::VertexStroke{{30, 40, 400}};
  const auto strokes = io::resolve_strokes(drawn, garment).strokes;
  REQUIRE(strokes.size() == 3);
  CHECK(strokes[0].points == drawn[0].stroke.points);
  CHECK(strokes[0].direction);
  CHECK(strokes[1].name == "flat");
  CHECK(strokes[1].height == -0.02);
  CHECK(strokes[1].points.back().x() == Approx(0.7).margin(1e-4));
  CHECK(strokes[2].closed);
  CHECK(strokes[2].points.front() == garment.mesh->point(Vertex(30)));
  std::get<io::TextureStroke>(drawn[1].on).group = "frunt";
  CHECK(content_error([&] { io::resolve_strokes(drawn, garment); }) ==
        "stroke 'flat': the garment has no group 'frunt'; did you mean 'front'?");
  std::get<io::TextureStroke>(drawn[1].on).group = "back";
  CHECK(content_error([&] { io::resolve_strokes(drawn, garment); }).find("point 0") != std::string::npos);
}
