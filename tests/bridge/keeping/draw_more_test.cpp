// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/draw_more.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/couple_bending.h"
#include "bridge/arrays/gather.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/stiffness.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "physics/motion/compensation.h"
#include "physics/motion/simulate.h"
#include "tests/cases/friction.h"
#include "tests/cases/safe_rule.h"
#include "tests/physics/cloth/one_kind.h"
#include "tests/test_meshes.h"

using namespace furrow;
using geometry::Edge;
using geometry::Mesh;
using geometry::Vertex;
using physics::Vec3;

namespace {

constexpr double edge = 1.0 / 14;  // h [m]
constexpr double cloth_density = 0.15;

/// 14 x 14 cells in the unit square, at rest.
Mesh jittered_sheet() {
  Mesh mesh = tests::jittered(14, 14, 0.15, 7);
  geometry::ensure_rest_lengths(mesh);
  geometry::rebuild_bending_springs(mesh);
  geometry::lump_masses(mesh, cloth_density);
  return mesh;
}

bridge::DrawMoreOptions options_for(const Mesh& mesh, double stiffness = 1000) {
  bridge::DrawMoreOptions o;
  o.wrinkle = tests::safe_rule();
  o.wrinkle.density = cloth_density;
  o.wrinkle.mean_structural_length = geometry::mean_rest_length(mesh);
  o.wrinkle.mean_bending_length = geometry::mean_bending_rest_length(mesh);
  o.springs = {stiffness, 0.1 * stiffness, *o.wrinkle.mean_structural_length, *o.wrinkle.mean_bending_length};
  return o;
}

/// A diagonal and a curve; scaled with the sheet.
std::vector<geometry::Stroke> strokes(double height, double scale = 1) {
  std::vector<geometry::Stroke> list(2);
  list[0].name = "diagonal";
  list[0].points = {{0.2 * scale, 0.22 * scale, 0}, {0.8 * scale, 0.71 * scale, 0}};
  list[1].name = "bow";
  for (int i = 0; i <= 12; ++i)
    list[1].points.emplace_back((0.2 + 0.05 * i) * scale, (0.8 - 0.25 * std::sin(0.26 * i)) * scale, 0);
  for (geometry::Stroke& s : list) s.height = height;
  return list;
}

void stretch(Mesh& mesh, double factor) {
  for (Vertex v : mesh.vertices()) mesh.point(v) = CGAL::ORIGIN + factor * (mesh.point(v) - CGAL::ORIGIN);
}

std::vector<Vec3> forces(const physics::Cloth& cloth) {
  std::vector<Vec3> f(cloth.particles.size(), Vec3::Zero());
  for (const auto* springs : {&cloth.structural, &cloth.bending})
    physics::add_forces(tests::only(*springs), cloth.particles.x, f);
  return f;
}

double largest(const std::vector<Vec3>& list) {
  double most = 0;
  for (const Vec3& f : list) most = std::max(most, f.norm());
  return most;
}

void pin_border(physics::Cloth& cloth, const Mesh& mesh, double from_y = -1) {
  std::vector<int> pins;
  for (Vertex v : mesh.vertices())
    if (mesh.is_border(v) && mesh.point(v).y() > from_y) pins.push_back(static_cast<int>(v));
  physics::pin(cloth.particles, pins);
}

/// Lets the cloth come to rest and returns where it is.
void settle(Mesh& mesh, const bridge::GatherOptions& springs, physics::SimulateState& state, double gravity,
            double pin_from_y) {
  physics::Cloth cloth = bridge::gather(mesh, springs);
  pin_border(cloth, mesh, pin_from_y);
  physics::SimulateOptions o;
  o.gravity = {0, -gravity, 0};
  o.air_drag = 8;
  o.spring_damping = 0.2;
  o.seconds = state.time + 6;
  const auto report = physics::simulate(cloth, physics::World{}, o, &state);
  REQUIRE(report.outcome == physics::Outcome::finished);
  REQUIRE(report.kinetic_energy < 1e-9);
  bridge::scatter(cloth.particles, mesh);
  bridge::scatter_velocities(cloth.particles, mesh);
}

/// Largest move of any vertex while the cloth, with lines of height 0 in it, finds its new rest [edges].
double pop(Mesh& mesh, const bridge::DrawMoreOptions& o, double gravity, double pin_from_y, double scale,
           double& strain) {
  physics::SimulateState state;
  settle(mesh, o.springs, state, gravity, pin_from_y);
  const bridge::DrawMoreReport report = draw_more(mesh, state, strokes(0, scale), o);
  strain = report.mean_strain;
  const std::vector<Vec3> before = bridge::positions_of(mesh);
  settle(mesh, o.springs, state, gravity, pin_from_y);
  double most = 0;
  for (Vertex v : mesh.vertices())
    most = std::max(most, (bridge::to_eigen(mesh.point(v)) - before[v]).norm() / edge);
  return most;
}
double pop(Mesh& mesh, double stiffness, double gravity, double pin_from_y, double scale, double& strain) {
  return pop(mesh, options_for(mesh, stiffness), gravity, pin_from_y, scale, strain);
}

}  // namespace

TEST_CASE("draw_more: the mean strain is told of a membrane of triangles, too") {
  Mesh mesh = jittered_sheet();
  bridge::DrawMoreOptions o = options_for(mesh);
  o.springs.membrane = bridge::Membrane::triangles;
  stretch(mesh, 1.05);
  physics::SimulateState state;
  CHECK(draw_more(mesh, state, strokes(0, 1.05), o).mean_strain == Approx(0.05));
}

TEST_CASE("draw_more: lines of height 0 leave a strained cloth isometric") {
  Mesh mesh = jittered_sheet();
  const bridge::DrawMoreOptions o = options_for(mesh);
  stretch(mesh, 1.05);
  const std::vector<geometry::Point> old(mesh.points().begin(), mesh.points().end());
  physics::SimulateState state;
  const auto report = draw_more(mesh, state, strokes(0, 1.05), o);
  CHECK(report.mean_strain == Approx(0.05));
  CHECK(report.wrinkle.insertion.inserted > 10);
  CHECK(report.wrinkle.rest_area_after == Approx(report.wrinkle.rest_area_before).epsilon(1e-12));
  for (std::size_t i = 0; i < old.size(); ++i) REQUIRE(mesh.point(Vertex(i)) == old[i]);
  const auto rest = *geometry::find_map(mesh, geometry::attribute::rest_length);
  double worst = 0;
  for (Edge e : mesh.edges()) {
    const double length =
        std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
    worst = std::max(worst, std::abs(rest[e] - length / 1.05) / length);
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("draw_more: a cloth without strain stays free of force when lines of height 0 are drawn") {
  Mesh mesh = jittered_sheet();
  const bridge::DrawMoreOptions o = options_for(mesh);
  physics::SimulateState state;
  const auto report = draw_more(mesh, state, strokes(0), o);
  CHECK(largest(forces(bridge::gather(mesh, o.springs))) < 1e-12 * 1000 * edge);
  CHECK(report.largest_jump < 1e-12 * 1000 * edge);
}

TEST_CASE("draw_more: what drawing changes in the forces is taken off at first and fades in") {
  Mesh mesh = jittered_sheet();
  const bridge::DrawMoreOptions o = options_for(mesh);
  stretch(mesh, 1.05);
  physics::SimulateState state;
  state.time = 2;
  const std::vector<Vec3> before = forces(bridge::gather(mesh, o.springs));
  const auto report = draw_more(mesh, state, strokes(0.01, 1.05), o);
  const std::vector<Vec3> after = forces(bridge::gather(mesh, o.springs));
  REQUIRE(report.largest_jump > 0.1);
  REQUIRE(state.compensation.force.size() == after.size());
  CHECK(state.compensation.time_constant == 0.3);
  CHECK_FALSE(state.planned);
  for (const double t : {2.0, 2.3, 3.2}) {
    const double share = physics::share_left(state.compensation, t);
    CHECK(share == Approx(std::exp(-(t - 2) / 0.3)));
    double worst = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      const Vec3 was = i < before.size() ? before[i] : Vec3::Zero();
      const Vec3 acts = after[i] - share * state.compensation.force[i];
      worst = std::max(worst, (acts - (was + (1 - share) * (after[i] - was))).norm());
    }
    CHECK(worst < 1e-12 * 1000 * edge);
  }
  CHECK(physics::net_force(state.compensation, 2).norm() < 1e-10);
}

TEST_CASE("draw_more: of bent cloth the forces of its plate are taken off, as those of its hinges are") {
  for (const bridge::Bending bending : {bridge::Bending::hinge, bridge::Bending::plate}) {
    CAPTURE(int(bending));
    Mesh mesh = jittered_sheet();
    bridge::DrawMoreOptions o = options_for(mesh);
    o.springs.membrane = bridge::Membrane::triangles;
    o.springs.bending = bending;
    o.springs.rigidity = 1e-2;
    tests::lift(mesh, [](double x, double y) { return 0.05 * std::sin(4 * x) * y; });
    const auto all_forces = [&] {
      physics::Cloth cloth = bridge::gather(mesh, o.springs);
      bridge::couple_bending(mesh, o.springs, cloth);
      std::vector<Vec3> f(cloth.particles.size(), Vec3::Zero());
      physics::add_forces(cloth, cloth.particles.x, f);
      return f;
    };
    const std::vector<Vec3> before = all_forces();
    physics::SimulateState state;
    auto list = strokes(0.01);
    for (geometry::Stroke& s : list)
      for (auto& p : s.points) p = {p.x(), p.y(), 0.05 * std::sin(4 * p.x()) * p.y()};
    draw_more(mesh, state, list, o);
    const std::vector<Vec3> after = all_forces();
    REQUIRE(state.compensation.force.size() == after.size());
    double worst = 0, most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      worst = std::max(worst, (after[i] - state.compensation.force[i] - before[i]).norm());
      most = std::max(most, (after[i] - before[i]).norm());
    }
    CHECK(most > 0.01);
    CHECK(worst < 1e-11 * largest(after));
  }
}

TEST_CASE("draw_more: a second round of lines carries on what is left of the first one's forces") {
  Mesh mesh = jittered_sheet();
  bridge::DrawMoreOptions o = options_for(mesh);
  stretch(mesh, 1.05);
  physics::SimulateState state;
  auto lines = strokes(0, 1.05);
  draw_more(mesh, state, std::span(lines).first(1), o);
  const std::vector<Vec3> first = state.compensation.force, before = forces(bridge::gather(mesh, o.springs));
  state.time = 0.15;
  o.wrinkle.first_line = 1;
  draw_more(mesh, state, std::span(lines).last(1), o);
  const std::vector<Vec3> after = forces(bridge::gather(mesh, o.springs));
  double worst = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    worst = std::max(
        worst, ((after[i] - state.compensation.force[i]) - (before[i] - std::exp(-0.5) * first[i])).norm());
  CHECK(worst < 1e-10);
}

TEST_CASE("draw_more: drawing keeps the momentum of a cloth in motion") {
  for (const double height : {0.0, 0.02}) {
    Mesh mesh = jittered_sheet();
    const bridge::DrawMoreOptions o = options_for(mesh);
    auto velocity = geometry::ensure_map(mesh, geometry::attribute::velocity);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> speed(-2, 2);
    for (Vertex v : mesh.vertices()) velocity[v] = {speed(random), speed(random), speed(random)};
    physics::SimulateState state;
    const auto report = draw_more(mesh, state, strokes(height), o);
    CAPTURE(height);
    CHECK((report.momentum_after - report.momentum_before).norm() < 1e-12 * report.wrinkle.total_mass * 2);
    Vec3 sum = Vec3::Zero();
    const physics::Cloth cloth = bridge::gather(mesh, o.springs);
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      sum += cloth.particles.mass[i] * cloth.particles.v[i];
    CHECK((sum - report.momentum_before).norm() < 1e-12 * report.wrinkle.total_mass * 2);
  }
}

TEST_CASE("draw_more: cloth that lies by implicit steps keeps contact and friction beside the lines") {
  Mesh mesh = jittered_sheet();
  for (Vertex v : mesh.vertices()) mesh.point(v) = mesh.point(v) + geometry::Vector(0, 0, 0.003);
  const bridge::DrawMoreOptions o = options_for(mesh);
  const cases::Plane floor({0.2, 0, 1});
  for (Vertex v : mesh.vertices())
    mesh.point(v) = mesh.point(v) + geometry::Vector(0, 0, -0.2 * mesh.point(v).x());
  physics::World world;
  world.collider = &floor;
  physics::SimulateOptions how;
  how.gravity = {0, 0, -9.81};
  how.friction = 0.5;
  how.integrator = GENERATE(physics::Integrator::implicit, physics::Integrator::tr_bdf2);
  how.seconds = 0.3;
  physics::SimulateState state;
  const auto move = [&](Mesh& of, physics::SimulateState& s) {
    physics::Cloth cloth = bridge::gather(of, o.springs);
    physics::simulate(cloth, world, how, &s);
    bridge::scatter(cloth.particles, of);
    bridge::scatter_velocities(cloth.particles, of);
  };
  move(mesh, state);
  Mesh undrawn = mesh;
  physics::SimulateState was = state;
  const std::vector<Vec3> lay = bridge::positions_of(mesh);
  std::vector<geometry::Stroke> line(1);
  line[0].points = {{0.2, 0.5, 0.003 - 0.04}, {0.8, 0.5, 0.003 - 0.16}};
  line[0].height = GENERATE(0.0, 0.01);
  bridge::draw_more(mesh, state, line, o);
  const std::size_t all = mesh.number_of_vertices();
  CHECK_NOTHROW(physics::check(state, all));
  REQUIRE(state.steps.anchors.size() == all);
  std::size_t stayed = 0;
  for (std::size_t i = 0; i < lay.size(); ++i) {
    if (bridge::to_eigen(mesh.point(Vertex(i))) != lay[i]) continue;
    ++stayed;
    REQUIRE(state.steps.anchors[i] == was.steps.anchors[i]);
  }
  CHECK(stayed > lay.size() / 2);
  CHECK(state.steps.fresh.size() == all - stayed);
  if (line[0].height != 0) return;
  how.seconds = 0.4;
  move(mesh, state);
  move(undrawn, was);
  double most = 0;
  for (Vertex v : undrawn.vertices())
    most = std::max(most, std::sqrt(CGAL::squared_distance(mesh.point(v), undrawn.point(v))));
  CHECK(most < 1e-4);
}

TEST_CASE("draw_more: a strained cloth moves little when lines of height 0 are drawn into it", "[release]") {
  double strain = 0;
  SECTION("stretched in its plane") {
    Mesh mesh = jittered_sheet();
    stretch(mesh, 1.05);
    const double most = pop(mesh, 1000, 0, -1, 1.05, strain);
    INFO("pop " << most << " edges at mean strain " << strain);
    CHECK(strain == Approx(0.05).epsilon(0.05));
    CHECK(most <= 6 * strain);
    CHECK(most > 1e-4);  // springs do feel another triangulation
  }
  SECTION("sagging in a frame under gravity") {
    Mesh mesh = jittered_sheet();
    const double most = pop(mesh, 2.35, 9.81, -1, 1.05, strain);
    INFO("pop " << most << " edges at mean strain " << strain);
    CHECK(strain == Approx(0.05).epsilon(0.2));
    CHECK(most <= 6 * strain);
  }
  SECTION("hanging from its upper edge: what the line gives way adds up below it") {
    Mesh mesh = jittered_sheet();
    const double most = pop(mesh, 4.4, 9.81, 0.99, 1.1, strain);
    INFO("pop " << most << " edges at mean strain " << strain);
    CHECK(strain == Approx(0.05).epsilon(0.1));
    CHECK(most <= 10 * strain);
  }
}

TEST_CASE("draw_more: a strained membrane of triangles hardly moves when folds of height 0 are drawn into it",
          "[release]") {
  Mesh mesh = jittered_sheet();
  stretch(mesh, 1.05);
  bridge::DrawMoreOptions o = options_for(mesh);
  o.wrinkle.insertion.rule = geometry::InsertionRule::fold;
  o.springs.membrane = bridge::Membrane::triangles;
  o.springs.bending = bridge::Bending::hinge;
  double strain = 0;
  const double most = pop(mesh, o, 0, -1, 1.05, strain);
  CHECK(strain == Approx(0.05).epsilon(0.05));
  CHECK(most < 0.01);  // the stretch is homogeneous, and triangles bear it on any mesh
}

TEST_CASE("draw_more: drawing that fails leaves cloth and state as they were") {
  Mesh mesh = jittered_sheet();
  bridge::DrawMoreOptions o = options_for(mesh);
  physics::SimulateState state;
  state.planned = true;
  auto far = strokes(0);
  for (auto& p : far[1].points) p = {p.x(), p.y(), 3};
  CHECK_THROWS(draw_more(mesh, state, far, o));
  o.fade = 0;
  CHECK_THROWS_AS(draw_more(mesh, state, strokes(0), o), std::invalid_argument);
  CHECK(mesh.number_of_vertices() == 15 * 15);
  CHECK(state.planned);
  CHECK(state.compensation.force.empty());
}

TEST_CASE("draw_more: a line with width and press is raised by its profile, and its press comes with it") {
  Mesh mesh = jittered_sheet();
  bridge::DrawMoreOptions options = options_for(mesh);
  options.springs.bending = bridge::Bending::hinge;
  std::vector<geometry::Stroke> list = strokes(0.02);
  list.pop_back();
  list[0].width = 0.3;
  list[0].press = 20;
  physics::SimulateState state;
  const bridge::DrawMoreReport report = bridge::draw_more(mesh, state, list, options);
  CHECK(report.wrinkle.lines[0].smoothed_height == Approx(0.02).epsilon(0.02));
  bridge::GatherOptions pressed = options.springs;
  pressed.line_presses = {20};
  pressed.line_widths = {0.3};
  const physics::Cloth with = bridge::gather(mesh, pressed), without = bridge::gather(mesh, options.springs);
  double most = 0;
  for (std::size_t i = 0; i < with.hinges.size(); ++i)
    most = std::max(most, with.hinges[i].stiffness / without.hinges[i].stiffness);
  CHECK(most == Approx(20));
  Mesh plain = jittered_sheet();
  list[0].press = 1;
  physics::SimulateState other;
  CHECK(bridge::draw_more(plain, other, list, options).largest_jump < report.largest_jump);
}
