// SPDX-License-Identifier: GPL-3.0-or-later
// A contact of one's own, given to searches for rest and to implicit steps.
#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>

#include "physics/base/contact_term.h"
#include "physics/linear/free_stiffness.h"
#include "physics/motion/simulate.h"
#include "physics/rest/settle.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double surface = 0.1, gap = 0.003, push = 500;  // [m], [m], of a particle [N/m]

/// A table that pushes as a spring does from a gap above it on.
class Table : public ContactTerm {
 public:
  void look(std::span<const Vec3> x, std::span<const double> inv_mass, ThreadPool*) override {
    depth_.clear();
    for (std::size_t i = 0; i < x.size(); ++i)
      depth_.push_back(inv_mass[i] > 0 ? std::max(surface + gap - x[i].y(), 0.0) : 0);
  }
  double energy() const override {
    double sum = 0;
    for (const double d : depth_) sum += 0.5 * push * d * d;
    return sum;
  }
  void add_forces(std::span<Vec3> force) const override {
    for (std::size_t i = 0; i < depth_.size(); ++i) force[i].y() += push * depth_[i];
  }
  void add_stiffness(FreeStiffness& stiffness, SlipStiffness) const override {
    for (std::size_t i = 0; i < depth_.size(); ++i)
      if (depth_[i] > 0) stiffness.add(int(i), push * Vec3::UnitY() * Vec3::UnitY().transpose());
  }

 private:
  std::vector<double> depth_;  ///< of particles [m]
};

const ContactMaker table = [](const Cloth&, double) { return std::make_unique<Table>(); };

/// Two particles joined by a spring, above the table.
Cloth above_the_table() {
  Cloth cloth;
  add_particle(cloth, {0, 0.11, 0}, 0.02);
  add_particle(cloth, {0.1, 0.105, 0}, 0.02);
  cloth.structural = {{0, 1, 0.1, 100}};
  return cloth;
}

constexpr double height_at_rest = surface + gap - 0.02 * 9.81 / push;

SimulateOptions five_seconds() {
  SimulateOptions options;
  options.integrator = Integrator::implicit;
  options.dt = 1.0 / 60;
  options.seconds = 5;
  options.air_drag = 5;
  options.implicit.contacts = {table};
  return options;
}

}  // namespace

TEST_CASE("further contact: cloth rests where its weight and the push balance, by settle and by steps") {
  Cloth settled = above_the_table(), fallen = settled;
  const SettleReport report = settle(settled, nullptr, {.tolerance = 1e-8, .contacts = {table}});
  CHECK(report.converged);
  CHECK(report.contact_energy == Approx(2 * 0.5 * 0.02 * 0.02 * 9.81 * 9.81 / push));
  const Collider* no_body = nullptr;
  simulate(fallen, no_body, five_seconds());
  for (const Cloth* c : {&settled, &fallen})
    for (const Vec3& p : c->particles.x) CHECK(p.y() == Approx(height_at_rest).margin(1e-5));
}

TEST_CASE("further contact: its maker sees the cloth, and what it throws comes out") {
  int made = 0;
  const ContactMaker counts = [&](const Cloth& cloth, double stiffness) -> std::unique_ptr<ContactTerm> {
    CHECK(cloth.particles.size() == 2);
    CHECK(stiffness > 0);
    ++made;
    throw std::invalid_argument("table: it has no legs");
  };
  Cloth cloth = above_the_table();
  CHECK_THROWS_WITH(settle(cloth, nullptr, {.contacts = {counts}}), Catch::Contains("no legs"));
  SimulateOptions options = five_seconds();
  options.implicit.contacts = {counts};
  const Collider* no_body = nullptr;
  CHECK_THROWS_WITH(simulate(cloth, no_body, options), Catch::Contains("no legs"));
  CHECK(made == 2);
}
