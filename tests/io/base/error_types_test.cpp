// SPDX-License-Identifier: GPL-3.0-or-later
// What docs/library.md says about errors and cancelling, across the layers. The test `errors` reads the
// sources.
#include <catch2/catch.hpp>
#include <span>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/property_names.h"
#include "io/animation/animation_file.h"
#include "io/mesh/mesh_file.h"
#include "io/stroke/stroke_file.h"
#include "physics/body/distance_field.h"
#include "physics/motion/simulate.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

geometry::Mesh sheet() { return io::read_mesh(std::string(FURROW_SOURCE_DIR) + "/meshes/sheet.obj").mesh; }

geometry::Stroke ridge() {
  geometry::Stroke stroke;
  stroke.points = {{-0.2, 0.5, 0}, {0.2, 0.5, 0}};
  return stroke;
}

physics::Cloth spring() {
  physics::Cloth cloth;
  cloth.particles = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}, {1, 1}, {1, 1}};
  cloth.structural = {{0, 1, 1.0, 100.0}};
  return cloth;
}

/// invalid_argument, content, cancelled, system, other; none.
std::string kind_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::invalid_argument&) {
    return "invalid_argument";
  } catch (const geometry::ContentError&) {
    return "content";
  } catch (const physics::Cancelled&) {
    return "cancelled";
  } catch (const std::runtime_error&) {
    return "system";
  } catch (...) {
    return "other";
  }
  return "none";
}

}  // namespace

TEST_CASE("errors: each layer tells a bad option, bad content and a refusing system apart") {
  geometry::Mesh mesh = sheet();
  const geometry::Stroke stroke = ridge();
  const auto lines = std::span(&stroke, 1);
  physics::Cloth cloth = spring();
  const physics::Collider* nothing = nullptr;
  geometry::WrinkleOptions massless;
  massless.density = 0;
  physics::SimulateOptions backwards;
  backwards.seconds = -1;
  CHECK(kind_of([&] { geometry::wrinkle(mesh, lines, massless); }) == "invalid_argument");
  CHECK(kind_of([&] { physics::simulate(cloth, nothing, backwards); }) == "invalid_argument");
  CHECK(kind_of([&] { physics::DistanceField::build(physics::TriangleMesh{}); }) == "invalid_argument");
  CHECK(kind_of([&] { bridge::gather(mesh, {}); }) == "invalid_argument");
  CHECK(kind_of([&] { bridge::scatter(cloth.particles, mesh); }) == "invalid_argument");
  CHECK(kind_of([&] { io::read_mesh("a.obj", {.metres_per_unit = 0}); }) == "invalid_argument");

  geometry::Stroke far = stroke;
  far.points = {{0, 50, 0}};
  CHECK(kind_of([&] { geometry::wrinkle(mesh, std::span(&far, 1)); }) == "content");
  CHECK(kind_of([&] { geometry::repair_body(geometry::Mesh()); }) == "content");
  CHECK(kind_of([&] { io::read_mesh("/absent/a.obj"); }) == "content");
  CHECK(kind_of([&] { io::open_frames("/absent/a.pc2", 3); }) == "content");

  io::MeshFile file;
  file.mesh = mesh;
  CHECK(kind_of([&] { io::write_mesh("/absent/a.obj", file); }) == "system");
}

TEST_CASE("cancelling: wrinkle() lets out what its callbacks throw, the mesh is as it was") {
  geometry::Mesh mesh = sheet();
  const geometry::Mesh before = mesh;
  const geometry::Stroke stroke = ridge();
  using geometry::Stage;
  for (const Stage last : {Stage::inserted, Stage::displaced, Stage::smoothed})
    CHECK_THROWS_AS(geometry::wrinkle(mesh, std::span(&stroke, 1), {},
                                      [&](Stage stage, const geometry::Mesh&) {
                                        if (stage == last) throw 7;
                                      }),
                    int);
  geometry::WrinkleOptions options;
  int asked = 0;
  options.insertion.may_flip = [&](const auto&) -> bool { return ++asked < 5 ? true : throw 7; };
  CHECK_THROWS_AS(geometry::wrinkle(mesh, std::span(&stroke, 1), options), int);
  CHECK(asked == 5);
  CHECK(same_positions(mesh, before));
  CHECK(corners_of(mesh) == corners_of(before));
  CHECK_FALSE(geometry::find_map(mesh, geometry::attribute::line));
}

TEST_CASE("cancelling: simulate() lets out what its observer throws, with one thread and with several") {
  const physics::Collider* nothing = nullptr;
  for (const int threads : {1, 3}) {
    physics::Cloth cloth = spring();
    physics::SimulateOptions options;
    options.threads = threads;
    options.observe_steps = 1;
    int calls = 0;
    CHECK_THROWS_AS(physics::simulate(cloth, nothing, options,
                                      [&](const physics::SimulateProgress&) -> bool {
                                        return ++calls < 3 ? true : throw 7;
                                      }),
                    int);
    CHECK(calls == 3);
    CHECK(cloth.particles.x[0].allFinite());
  }
}

TEST_CASE("cancelling: a field's Progress gives Cancelled, which is no ContentError") {
  const physics::TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  CHECK(kind_of([&] { physics::DistanceField::build(tetrahedron, {}, [](double) { return false; }); }) ==
        "cancelled");
}
