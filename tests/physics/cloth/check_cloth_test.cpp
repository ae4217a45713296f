// SPDX-License-Identifier: GPL-3.0-or-later
// Every public door that takes a cloth, each with every way in which one can be broken.
#include "physics/cloth/check_cloth.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "physics/body/distance_field.h"
#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "physics/rest/prestress.h"
#include "physics/rest/settle.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/public_functions.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 endless = std::numeric_limits<double>::infinity();

/// Has one or more of each kind of element.
Cloth whole_cloth() {
  Cloth cloth = sheet(4, 4, 0.05, 0.2, 3, 200, 2);
  add_membrane(cloth, 50);
  add_hinges(cloth, 1e-5);
  cloth.tension.push_back({0, 5, 0.07, 2, 1});
  return cloth;
}

struct Damage {
  const char* name;
  std::function<void(Cloth&)> make;
  const char* message = "";  ///< a part of what is said
};

/// Sets a number to each value that it cannot have.
void add_numbers(std::vector<Damage>& all, const char* name, const std::function<double&(Cloth&)>& number,
                 const std::vector<double>& values) {
  for (const double value : values) all.push_back({name, [=](Cloth& c) { number(c) = value; }});
}

std::vector<Damage> damages() {
  using C = Cloth&;
  std::vector<Damage> all{
      {"position missing", [](C c) { c.particles.x.pop_back(); }, "particles"},
      {"velocity missing", [](C c) { c.particles.v.pop_back(); }, "velocities"},
      {"mass missing", [](C c) { c.particles.mass.pop_back(); }, " masses"},
      {"inverse mass missing", [](C c) { c.particles.inv_mass.pop_back(); }, "inverse masses"},
      {"free without mass", [](C c) { c.particles.mass[3] = 0; }, "free particle 3"},
      {"inverse of another mass", [](C c) { c.particles.inv_mass[3] *= 1.5; }, "neither 0 nor 1 / "},
      {"spring beyond", [](C c) { c.structural.back().b = 1 << 20; }, "1048576"},
      {"spring before", [](C c) { c.structural[0].a = -1; }, "-1"},
      {"spring in itself", [](C c) { c.structural[0].b = c.structural[0].a; }, "itself"},
      {"bending beyond", [](C c) { c.bending.back().b = 1 << 20; }, "1048576"},
      {"triangle beyond", [](C c) { c.triangles[0][1] = 999999; }, "999999"},
      {"triangle before", [](C c) { c.triangles[0][1] = -2; }, "-2"},
      {"triangle of two", [](C c) { c.triangles[0][1] = c.triangles[0][0]; }, "triangle"},
      {"membrane beyond", [](C c) { c.membrane[0].vertices[1] = 999999; }, "999999"},
      {"membrane of two", [](C c) { c.membrane[0].vertices[1] = c.membrane[0].vertices[0]; }},
      {"membrane without area",
       [](C c) {
         c.membrane[0].rest_lengths = {1, 0.1, 0.1};
       }},
      {"hinge beyond", [](C c) { c.hinges[0].vertices[2] = 123456; }, "123456"},
      {"hinge of three", [](C c) { c.hinges[0].vertices[2] = c.hinges[0].vertices[0]; }, "twice"},
      {"tension beyond", [](C c) { c.tension[0].b = 77777; }, "77777"},
      {"tension pushes more", [](C c) { c.tension[0].compress = 3; }, "compress"},
      {"energy null", [](C c) { c.energies.push_back(nullptr); }, "null"}};
  add_numbers(all, "position", [](C c) -> double& { return c.particles.x[3].y(); }, {no_number, endless});
  add_numbers(all, "velocity", [](C c) -> double& { return c.particles.v[3].y(); }, {no_number, endless});
  add_numbers(all, "mass", [](C c) -> double& { return c.particles.mass[3]; }, {no_number, endless, -1});
  add_numbers(all, "inverse", [](C c) -> double& { return c.particles.inv_mass[3]; },
              {no_number, endless, -1});
  const std::vector<double> lengths{0, -1, no_number, endless}, stiffnesses{-5, no_number, endless};
  add_numbers(
      all, "rest", [](C c) -> double& { return c.structural[0].rest_length; }, lengths);
  add_numbers(
      all, "stiffness", [](C c) -> double& { return c.structural[0].stiffness; }, stiffnesses);
  add_numbers(
      all, "bending", [](C c) -> double& { return c.bending[0].rest_length; }, lengths);
  add_numbers(
      all, "membrane", [](C c) -> double& { return c.membrane[0].rest_lengths[1]; }, lengths);
  add_numbers(all, "lambda", [](C c) -> double& { return c.membrane[0].lambda; }, {no_number, endless});
  add_numbers(
      all, "mu", [](C c) -> double& { return c.membrane[0].mu; }, stiffnesses);
  add_numbers(all, "threads", [](C c) -> double& { return c.membrane[0].threads.warp; }, {no_number, -1e9});
  add_numbers(all, "angle", [](C c) -> double& { return c.hinges[0].rest_angle; }, {4, no_number});
  add_numbers(
      all, "hinge", [](C c) -> double& { return c.hinges[0].stiffness; }, stiffnesses);
  add_numbers(
      all, "tension", [](C c) -> double& { return c.tension[0].rest_length; }, lengths);
  return all;
}

struct Door {
  std::string name;
  std::function<void(Cloth&)> enter;
};

std::vector<Door> doors() {
  std::vector<Door> all;
  for (int integrator = 0; integrator <= int(Integrator::tr_bdf2); ++integrator)
    for (const bool self : {false, true})
      all.push_back({"simulate " + std::to_string(integrator) + (self ? " self" : ""), [=](Cloth& c) {
                       SimulateOptions o;
                       o.seconds = 0.01;
                       o.integrator = Integrator(integrator);
                       o.self.on = self;
                       const Collider* const nothing = nullptr;
                       simulate(c, nothing, o);
                     }});
  for (const bool self : {false, true})
    all.push_back({self ? "settle self" : "settle", [=](Cloth& c) {
                     SettleOptions o;
                     o.max_iterations = 2;
                     o.self.on = self;
                     settle(c, nullptr, o);
                   }});
  all.push_back({"displace_by_force", [](Cloth& c) {
                   DisplaceOptions o;
                   o.max_passes = 2;
                   displace_by_force(c, nullptr, o);
                 }});
  all.push_back({"displacement_rate", [](Cloth& c) { displacement_rate(c, Vec3(0, -9.81, 0), 0.01); }});
  all.push_back({"prestress", [](Cloth& c) { prestress(c); }});
  all.push_back({"certify", [](Cloth& c) { certify(c); }});
  return all;
}

struct Ground : Collider {
  SignedDistance at(const Vec3& x) const override { return {x.y(), Vec3::UnitY()}; }
};

/// What only measures a cloth, or its arrays: a motion that diverged can be measured, too.
std::vector<Door> measures() {
  return {{"strain_statistics", [](Cloth& c) { strain_statistics(c); }},
          {"strain_statistics of springs", [](Cloth& c) { strain_statistics(c.particles.x, c.structural); }},
          {"measured_edges", [](Cloth& c) { measured_edges(c); }},
          {"kinetic_energy", [](Cloth& c) { kinetic_energy(c.particles); }},
          {"fingerprint", [](Cloth& c) { fingerprint(c); }},
          {"bring_out", [](Cloth& c) { bring_out(c.particles, Ground(), 0.003); }},
          {"vertex_normals", [](Cloth& c) { vertex_normals(c.triangles, c.particles.x); }},
          {"check_body",
           [](Cloth& c) {
             check_body({c.particles.x, c.triangles}, "test");
           }},
          {"bounding_diagonal",
           [](Cloth& c) {
             bounding_diagonal({c.particles.x, c.triangles});
           }},
          {"ExactDistance",
           [](Cloth& c) {
             ExactDistance({c.particles.x, c.triangles});
           }},
          {"moved",
           [](Cloth& c) {
             const Cloth whole = whole_cloth();
             ExactDistance({whole.particles.x, whole.triangles}).moved({c.particles.x, c.triangles});
           }},
          {"build", [](Cloth& c) {
             DistanceFieldOptions o;
             o.max_depth = o.band_depth = 3;
             DistanceField::build({c.particles.x, c.triangles}, o);
           }}};
}

template <class Array>
bool same_bytes(const Array& a, const Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

bool is_untouched(const Cloth& a, const Cloth& b) {
  const Particles &p = a.particles, &q = b.particles;
  return same_bytes(p.x, q.x) && same_bytes(p.v, q.v) && same_bytes(p.mass, q.mass) &&
         same_bytes(p.inv_mass, q.inv_mass) && same_bytes(a.structural, b.structural) &&
         same_bytes(a.hinges, b.hinges);
}

/// Puts each of the values into each of an operation's options, and none may be taken.
template <class Options>
struct BadNumber {
  const char* name;
  double Options::*number;
  std::vector<double> values;
};

template <class Options, class Enter>
void refuses_numbers(const std::vector<BadNumber<Options>>& numbers, const Enter& enter) {
  for (const auto& [name, number, values] : numbers)
    for (const double value : values) {
      Options options;
      options.*number = value;
      Cloth cloth = whole_cloth();
      const Cloth before = cloth;
      CAPTURE(name, value);
      CHECK_THROWS_AS(enter(cloth, options), std::invalid_argument);
      CHECK(is_untouched(cloth, before));
    }
}

}  // namespace

TEST_CASE("check_cloth: every door refuses every broken cloth by name, and leaves it as it was") {
  for (const Door& door : doors()) {
    Cloth whole = whole_cloth();
    const bool takes_all = door.name.find("simulate 2") != 0;  // XPBD knows springs alone
    if (takes_all) CHECK_NOTHROW(door.enter(whole));
    for (const Damage& damage : damages()) {
      Cloth cloth = whole_cloth();
      damage.make(cloth);
      const Cloth before = cloth;
      CAPTURE(door.name, damage.name);
      CHECK_THROWS_AS(door.enter(cloth), std::invalid_argument);
      CHECK(is_untouched(cloth, before));
      CHECK_THROWS_WITH(check_cloth(cloth, "door"),
                        Catch::StartsWith("door: ") && Catch::Contains(damage.message));
    }
  }
}

TEST_CASE(
    "check_cloth: what measures a cloth refuses arrays that do not fit, and measures what is not finite") {
  const std::vector<std::pair<const char*, std::vector<const char*>>> must_refuse{
      {"spring beyond", {"strain_statistics", "strain_statistics of springs"}},
      {"spring before", {"strain_statistics", "strain_statistics of springs"}},
      {"velocity missing", {"kinetic_energy"}},
      {"mass missing", {"kinetic_energy"}},
      {"inverse mass missing", {"kinetic_energy", "bring_out"}},
      {"triangle beyond",
       {"vertex_normals", "check_body", "bounding_diagonal", "ExactDistance", "moved", "build"}},
      {"triangle before",
       {"vertex_normals", "check_body", "bounding_diagonal", "ExactDistance", "moved", "build"}}};
  for (const Door& door : measures())
    for (const Damage& damage : damages()) {
      Cloth cloth = whole_cloth();
      damage.make(cloth);
      CAPTURE(door.name, damage.name);
      bool must = false, refused = false;
      for (const auto& [name, by] : must_refuse)
        if (damage.name == std::string(name)) must = std::count(by.begin(), by.end(), door.name) > 0;
      try {
        door.enter(cloth);
      } catch (const std::invalid_argument&) {
        refused = true;
      }
      if (must) CHECK(refused);
    }
  Cloth diverged = whole_cloth();
  diverged.particles.v[3].x() = diverged.particles.x[3].x() = no_number;
  CHECK(std::isnan(kinetic_energy(diverged.particles)));
  CHECK(std::isnan(strain_statistics(diverged).max));
}

TEST_CASE("check_cloth: no public function is left out") {
  std::set<std::string> entered;
  for (const auto& list : {doors(), measures()})
    for (const Door& door : list) entered.insert(door.name.substr(0, door.name.find(' ')));
  for (const std::string& name : public_functions_of("physics", "Cloth|Particles|TriangleMesh")) {
    INFO(name << "() is given a cloth or a body: add it to the tables above");
    CHECK(entered.count(name));
  }
}

TEST_CASE("check_cloth: a state that leads pins is refused where there are none") {
  Cloth cloth = whole_cloth();
  SimulateState state;
  state.homes.assign(3, Vec3::Zero());
  SimulateOptions o;
  o.seconds = 0.01;
  CHECK_THROWS_WITH(simulate(cloth, World(), o, &state), Catch::Contains("3 moved pins"));
}

TEST_CASE("check_cloth: a field's lengths are such that its numbers can be computed with") {
  const TriangleMesh body{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  for (double DistanceFieldOptions::*length :
       {&DistanceFieldOptions::margin, &DistanceFieldOptions::outer_band, &DistanceFieldOptions::inner_band})
    for (const double value : {-1.0, 1e300, no_number, endless}) {
      DistanceFieldOptions o;
      o.max_depth = o.band_depth = 3;
      o.*length = value;
      CAPTURE(value);
      CHECK_THROWS_AS(DistanceField::build(body, o), std::invalid_argument);
    }
}

TEST_CASE("check_cloth: loads are finite, one a particle") {
  Cloth cloth = whole_cloth();
  std::vector<Vec3> loads(cloth.particles.size(), Vec3::Zero());
  CHECK_NOTHROW(certify(cloth, {}, nullptr, loads));
  loads[7].z() = no_number;
  CHECK_THROWS_WITH(certify(cloth, {}, nullptr, loads), "certify: load 7 is not finite");
  CHECK_THROWS_WITH(prestress(cloth, {}, nullptr, loads), "prestress: load 7 is not finite");
  loads.pop_back();
  CHECK_THROWS_AS(certify(cloth, {}, nullptr, loads), std::invalid_argument);
  CHECK_THROWS_AS(prestress(cloth, {}, nullptr, loads), std::invalid_argument);
}

TEST_CASE("check_cloth: no door takes an option that is out of its range") {
  using S = SimulateOptions;
  const std::vector<double> below{-1, no_number, endless, -endless}, not_above{0, -1, no_number, endless};
  refuses_numbers<S>({{"seconds", &S::seconds, below},
                      {"dt_factor", &S::dt_factor, {0, 2, no_number}},
                      {"dt_max", &S::dt_max, not_above},
                      {"limit_strain", &S::limit_strain, not_above},
                      {"air_drag", &S::air_drag, below},
                      {"spring_damping", &S::spring_damping, below},
                      {"friction", &S::friction, below},
                      {"contact_gap", &S::contact_gap, not_above},
                      {"recovery_speed", &S::recovery_speed, not_above},
                      {"speed_limit", &S::speed_limit, not_above}},
                     [](Cloth& c, const S& o) {
                       const Collider* const nothing = nullptr;
                       simulate(c, nothing, o);
                     });
  using R = SettleOptions;
  refuses_numbers<R>({{"friction", &R::friction, below},
                      {"gap", &R::gap, not_above},
                      {"contact_depth", &R::contact_depth, {0, -1, no_number}},
                      {"tolerance", &R::tolerance, not_above},
                      {"longest_move", &R::longest_move, not_above}},
                     [](Cloth& c, const R& o) { settle(c, nullptr, o); });
  using P = PrestressOptions;
  refuses_numbers<P>({{"friction", &P::friction, below},
                      {"gap", &P::gap, not_above},
                      {"max_strain", &P::max_strain, {0, 0.2, no_number}},
                      {"max_compression", &P::max_compression, {-1, 0.2, no_number}},
                      {"max_angle", &P::max_angle, {0, 4, no_number}},
                      {"tolerance", &P::tolerance, not_above}},
                     [](Cloth& c, const P& o) { prestress(c, o); });
  using C = CertificateOptions;
  refuses_numbers<C>({{"friction", &C::friction, below}, {"gap", &C::gap, not_above}},
                     [](Cloth& c, const C& o) { certify(c, o); });
  using D = DisplaceOptions;
  refuses_numbers<D>({{"friction", &D::friction, below}, {"gap", &D::gap, not_above}},
                     [](Cloth& c, const D& o) { displace_by_force(c, nullptr, o); });
  for (const int threads : {0, -3, 1 << 30}) {
    Cloth cloth = whole_cloth();
    const Collider* const nothing = nullptr;
    SimulateOptions simulated;
    SettleOptions settled;
    simulated.threads = settled.threads = threads;
    CAPTURE(threads);
    CHECK_THROWS_AS(simulate(cloth, nothing, simulated), std::invalid_argument);
    CHECK_THROWS_AS(settle(cloth, nothing, settled), std::invalid_argument);
  }
  for (const double g : {no_number, endless}) {
    Cloth cloth = whole_cloth();
    const Collider* const nothing = nullptr;
    const Vec3 gravity(0, g, 0);
    SimulateOptions simulated;
    simulated.gravity = gravity;
    CHECK_THROWS_AS(simulate(cloth, nothing, simulated), std::invalid_argument);
    SettleOptions settled;
    settled.gravity = gravity;
    CHECK_THROWS_AS(settle(cloth, nothing, settled), std::invalid_argument);
    CHECK_THROWS_AS(certify(cloth, {.gravity = gravity}), std::invalid_argument);
    CHECK_THROWS_AS(prestress(cloth, {.gravity = gravity}), std::invalid_argument);
    CHECK_THROWS_AS(displacement_rate(cloth, gravity, 0.01), std::invalid_argument);
  }
}
