// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/state_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <sstream>

#include "bridge/arrays/store_rest_state.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "io/mesh/mesh_file.h"
#include "tests/cases/safe_rule.h"
#include "tests/test_meshes.h"

using namespace furrow;

namespace {

/// A wrinkled sheet in motion, with everything that a state can hold.
io::SavedState state() {
  io::SavedState s;
  geometry::Mesh& mesh = s.file.mesh;
  mesh = tests::jittered(6, 6, 0.2, 5);
  geometry::Stroke stroke;
  stroke.points = {{0.2, 0.2, 0}, {0.8, 0.7, 0}};
  geometry::wrinkle(mesh, std::span(&stroke, 1), tests::safe_rule());
  s.file.comments = {"made by hand"};
  io::set_wrinkle_record(s.file, {});
  auto velocity = geometry::ensure_map(mesh, geometry::attribute::velocity);
  physics::SimulateState& sim = s.simulation;
  for (auto v : mesh.vertices()) {
    const double t = 0.1 * static_cast<double>(v) + 1.0 / 3;
    velocity[v] = {std::sin(t), -0.0, t};
    sim.contact.push_back({{t, 2 * t, 1e-300}, v % 2 ? t : std::nan("")});
    sim.compensation.force.push_back({t, -t, 1 / t});
    sim.steps.anchors.push_back({{t, 1 / t, -t}, {0, t, 1e-300}, v % 3 ? t : -1, v % 2 == 0, 1e-4 * t});
    sim.steps.acceleration.push_back({-t, 3 * t, 1 / t});
  }
  sim.time = 0.1 + 0.2;
  sim.step = 1234567890123;
  sim.planned = true;
  sim.dt = 1.0 / 3e4;
  sim.dt_longest = sim.dt;
  sim.steps_left = 99;
  sim.end = sim.time + 99 * sim.dt;
  sim.cloth = 0xfedcba9876543210;
  s.body = "0123456789abcdef";
  sim.estimated_at = 17;
  sim.dt_limit = std::numeric_limits<double>::infinity();
  sim.strain_at_estimate = 0.01;
  sim.homes = {{1, 2, 3}, {0.1, 0.2, 0.3}};
  sim.compensation.start = 0.1;
  sim.compensation.time_constant = std::numeric_limits<double>::infinity();
  sim.totals.force_evaluations = 12;
  sim.totals.open_steps = 3;
  sim.totals.longest_edge = {1 / 3.0, 0.1, {1, -1e-9, 7}};
  sim.totals.energy = {0.1, 1 / 3.0, -0.2, 1e-300, 5, 6, 7, 8, 9, 1 / 7.0};
  sim.steps.contact_stiffness = 1234.5;
  sim.steps.self = {1 / 3.0,  {{true, {4, 9, 1, 2}, 0.1 / 3, 0.2}},
                    {1, 2},   5,
                    {{3, 1}}, {{false, {4, 9, 3, 5}, {1 / 3.0, -0.0, 1e-300}, true}},
                    {{2, 1}}};
  sim.steps.fresh = {3, 7};
  s.pins = {{1, 2}, {}};
  s.lines_drawn = 2;
  *s.scene = {{"garment", {{"mesh", "../g.obj"}}}, {"simulation", {{"seconds", 2}}}};
  return s;
}

}  // namespace

TEST_CASE("state_file: a state that is read and written again has the same bytes") {
  const std::string bytes = io::state_bytes(state());
  CHECK(io::state_bytes(io::parse_state(bytes, "s.ply")) == bytes);
}

TEST_CASE("state_file: a state holds everything to the last bit") {
  const io::SavedState was = state(), is = io::parse_state(io::state_bytes(was), "s.ply");
  const auto &a = was.simulation, &b = is.simulation;
  {  // a member that is added does not compile here: read and write it, and compare it below
    const auto& [time, step, planned, end, dt, dt_longest, steps_left, estimated_at, dt_limit, strain, cloth,
                 contact, steps, body_travel, homes, compensation, totals] = a;
    const auto& [anchors, acceleration, contact_stiffness, self, fresh] = steps;
    const auto& [anchor, plane, limit, slides, nearer] = anchors.front();
    const auto& [file, simulation, scene, pins, body, lines_drawn, contact_gap, integrator, tolerance] = was;
    CHECK(fresh == b.steps.fresh);
    CHECK(nearer == b.steps.anchors.front().nearer);
    CHECK(body_travel == b.body_travel);
    CHECK(contact_gap == is.contact_gap);
  }
  CHECK(a.time == b.time);
  CHECK(a.step == b.step);
  CHECK(b.planned);
  CHECK(a.end == b.end);
  CHECK(a.dt == b.dt);
  CHECK(a.dt_longest == b.dt_longest);
  CHECK(a.steps_left == b.steps_left);
  CHECK(a.cloth == b.cloth);
  CHECK(was.body == is.body);
  CHECK(a.estimated_at == b.estimated_at);
  CHECK(a.dt_limit == b.dt_limit);
  CHECK(a.strain_at_estimate == b.strain_at_estimate);
  CHECK(a.homes == b.homes);
  CHECK(a.compensation.start == b.compensation.start);
  CHECK(a.compensation.time_constant == b.compensation.time_constant);
  CHECK(a.compensation.force == b.compensation.force);
  CHECK(a.totals.force_evaluations == b.totals.force_evaluations);
  CHECK(a.totals.open_steps == b.totals.open_steps);
  CHECK(a.totals.longest_edge.strain == b.totals.longest_edge.strain);
  CHECK(a.totals.longest_edge.time == b.totals.longest_edge.time);
  CHECK(a.totals.longest_edge.at == b.totals.longest_edge.at);
  CHECK(a.totals.energy.seconds == b.totals.energy.seconds);
  CHECK(a.totals.energy.to_contact == b.totals.energy.to_contact);
  CHECK(a.totals.energy.to_steps() == b.totals.energy.to_steps());
  CHECK(a.steps.anchors == b.steps.anchors);
  CHECK(a.steps.acceleration == b.steps.acceleration);
  CHECK(a.steps.contact_stiffness == b.steps.contact_stiffness);
  CHECK(a.steps.self == b.steps.self);
  CHECK(geometry::vertex_attributes(is.file.mesh).empty());
  REQUIRE(b.contact.size() == a.contact.size());
  for (std::size_t i = 0; i < a.contact.size(); ++i) {
    CHECK(a.contact[i].x == b.contact[i].x);
    CHECK((a.contact[i].level == b.contact[i].level ||
           (std::isnan(a.contact[i].level) && std::isnan(b.contact[i].level))));
  }
  CHECK(was.pins == is.pins);
  CHECK(was.lines_drawn == is.lines_drawn);
  CHECK(*was.scene == *is.scene);
  CHECK(was.file.comments == is.file.comments);
  const auto velocity = *geometry::find_map(was.file.mesh, geometry::attribute::velocity),
             read = *geometry::find_map(is.file.mesh, geometry::attribute::velocity);
  const auto generation = *geometry::find_map(was.file.mesh, geometry::attribute::generation),
             generation_read = *geometry::find_map(is.file.mesh, geometry::attribute::generation);
  for (auto v : was.file.mesh->vertices()) {
    CHECK(was.file.mesh->point(v) == is.file.mesh->point(v));
    CHECK(velocity[v] == read[v]);
  }
  for (auto f : was.file.mesh->faces()) CHECK(generation[f] == generation_read[f]);
}

TEST_CASE(
    "state_file: a rest state that was stored element by element gives the same elements after save and "
    "load") {
  io::SavedState was = state();
  geometry::Mesh& mesh = was.file.mesh;
  bridge::GatherOptions o;
  o.mean_structural_length = 0.2, o.mean_bending_length = 0.3;
  for (const auto membrane : {bridge::Membrane::paper, bridge::Membrane::triangles})
    for (const auto bending : {bridge::Bending::cross, bridge::Bending::hinge}) {
      o.membrane = membrane, o.bending = bending;
      physics::Cloth cloth = bridge::gather(mesh, o);
      for (auto* springs : {&cloth.structural, &cloth.bending})
        for (physics::Spring& s : *springs) s.rest_length *= 1 + 0.001 * s.a, s.stiffness /= 3 + s.b;
      for (physics::MembraneTriangle& t : cloth.membrane)
        for (int k = 0; k < 3; ++k) t.rest_lengths[k] *= 1 + 1e-4 * t.vertices[k];
      for (physics::Hinge& h : cloth.hinges) h.rest_angle += 0.01 * h.vertices[0], h.stiffness *= 10.0 / 3;
      cloth.bending.push_back({3, 40, 0.7, 0.3});
      bridge::store_rest_state(cloth, o, mesh);
      const std::string bytes = io::state_bytes(was);
      const io::SavedState is = io::parse_state(bytes, "s.ply");
      CHECK(io::state_bytes(is) == bytes);
      CHECK(physics::fingerprint(bridge::gather(is.file.mesh, o)) ==
            physics::fingerprint(bridge::gather(mesh, o)));
    }
}

TEST_CASE("state_file: a state is a mesh to others, and no state is no state") {
  const std::string bytes = io::state_bytes(state());
  std::istringstream in(bytes);
  const io::MeshFile mesh = io::read_mesh(in, io::MeshFormat::ply, "s.ply");
  CHECK(mesh.mesh->number_of_vertices() == state().file.mesh->number_of_vertices());
  CHECK(mesh.warnings.empty());
  io::MeshFile plain = state().file;
  io::drop_motion(plain);
  std::ostringstream out;
  io::write_mesh(out, io::MeshFormat::ply, plain);
  CHECK(out.str().find("property double vx") == std::string::npos);
  CHECK_THROWS_AS(io::parse_state(out.str(), "s.ply"), geometry::ContentError);
}

TEST_CASE("state_file: damaged states are refused") {
  const std::string bytes = io::state_bytes(state());
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string copy = bytes;
    const std::size_t at = copy.find(from);
    REQUIRE(at != std::string::npos);
    return copy.replace(at, from.size(), to);
  };
  CHECK_THROWS_AS(io::parse_state(bytes.substr(0, bytes.size() / 2), "s"), geometry::ContentError);
  CHECK_THROWS_AS(io::parse_state(changed("\"time\":", "\"tame\":"), "s"), geometry::ContentError);
  CHECK_THROWS_AS(io::parse_state(changed("\"planned\":true", "\"planned\":7"), "s"), geometry::ContentError);
  CHECK_THROWS_AS(io::parse_state(changed("\"end\":", "\"end\":null,\"was\":"), "s"), geometry::ContentError);
  CHECK_THROWS_AS(io::parse_state(changed("furrow state {", "furrow state ["), "s"), geometry::ContentError);
  CHECK_THROWS_AS(io::parse_state(changed("\"version\":3", "\"version\":4"), "s"), geometry::ContentError);
  io::SavedState wrong = state();
  wrong.simulation.contact.pop_back();
  CHECK_THROWS_AS(io::state_bytes(wrong), std::invalid_argument);
}
