// SPDX-License-Identifier: GPL-3.0-or-later
// The garments of the journeys are sound, and lie about their body with the options that their frame needs.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "bridge/arrays/convert.h"
#include "io/mesh/mesh_file.h"
#include "journey.h"

using namespace furrow;
using namespace furrow::tests;
using Catch::Contains;

namespace {

/// The garment of a file as two panels, left and right of the middle, 10 um apart.
io::MeshFile in_two_panels(const std::string& path) {
  const geometry::Mesh whole = io::read_mesh(path).mesh;
  const std::vector<physics::Vec3> x = bridge::positions_of(whole);
  double low = x[0].x(), high = low;
  for (const physics::Vec3& p : x) low = std::min(low, p.x()), high = std::max(high, p.x());
  io::MeshFile panels;
  for (const bool left : {true, false}) {
    std::map<int, geometry::Vertex> of;
    const auto at = [&](int i) {
      const physics::Vec3& p = x[std::size_t(i)];
      if (!of.contains(i)) of[i] = panels.mesh->add_vertex({p.x() + (left ? 0 : 1e-5), p.y(), p.z()});
      return of[i];
    };
    for (const auto& [a, b, c] : bridge::triangles_of(whole)) {
      const double middle = (x[std::size_t(a)] + x[std::size_t(b)] + x[std::size_t(c)]).x() / 3;
      if ((middle < (low + high) / 2) == left) panels.mesh->add_face(at(a), at(b), at(c));
    }
  }
  return panels;
}

}  // namespace

TEST_CASE(
    "journeys: the dress in centimetres and the tunic off the origin are sound and lie about their body",
    "[release]") {
  const Journey here;
  here.bring("meshes/dress_cm.obj", "mine/dress.obj");
  here.bring_body_of_dress("mine/body.obj");
  CHECK(step("doctor mine/dress.obj --unit cm --up z --body mine/body.obj")["found"].empty());
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  CHECK(step("doctor tunic.obj --body she.obj")["found"].empty());
}

TEST_CASE("journeys: panels 10 um apart are told, come to rest as one garment, and keep every vertex",
          "[release]") {
  const Journey here;
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  io::write_mesh("panels.obj", in_two_panels("tunic.obj"));
  const auto found = step("doctor panels.obj --body she.obj", 4)["found"];
  REQUIRE(found.size() == 1);
  CHECK(found[0]["code"] == "seams_apart");
  step("doctor panels.obj --repair -o whole.obj");
  for (const std::string mesh : {"whole", "panels"}) {
    const auto rest = step("drape " + mesh + ".obj --body she.obj --subdivide 0 -o " + mesh + "-rest.ply");
    CHECK(rest["end"]["parts"].size() == 1);
    CHECK(rest["end"]["parts_lost"] == 0);
  }
  // The shape goes back into the file, whose panels meet then.
  const std::size_t vertices = io::read_mesh("panels.obj").mesh->number_of_vertices();
  CHECK(step("transfer panels.obj panels-rest.ply -o back.obj")["copied"] == vertices);
  CHECK(io::read_mesh("back.obj").mesh->number_of_vertices() == vertices);
  const auto left = step("doctor back.obj --body she.obj", 4)["found"];
  REQUIRE(left.size() == 1);
  CHECK(left[0]["code"] == "unjoined");
  // A GLB is joined as it is read.
  io::write_mesh("panels.glb", in_two_panels("tunic.obj"));
  CHECK(step("doctor panels.glb --body she.obj")["components"] == 1);
}
