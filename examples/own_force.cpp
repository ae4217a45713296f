// SPDX-License-Identifier: MIT
// A force of your own, by the physics alone: two particles, joined by a spring, lie on a soft floor y = 0
// that pushes with k times the depth. At rest each is  m g / k  deep, however it got there.
#include <cmath>
#include <cstdio>
#include <memory>

#include "physics/cloth/cloth.h"
#include "physics/motion/simulate.h"
#include "physics/rest/settle.h"

using namespace furrow::physics;

class SoftFloor : public Energy {
 public:
  explicit SoftFloor(double stiffness) : k_(stiffness) {}

  double energy(std::span<const Vec3> x) const override {
    double sum = 0;
    for (const Vec3& p : x) sum += 0.5 * k_ * depth(p) * depth(p);
    return sum;
  }
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override {
    for (std::size_t i = 0; i < x.size(); ++i) force[i].y() += k_ * depth(x[i]);
  }
  // Not needed, but settle() and backward Euler are faster with it: a block for each particle, zero where it
  // is above the floor, so that the sequence is always the same.
  bool add_stiffness(std::span<const Vec3> x, Stiffness, const BlockSink& sink) const override {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Mat3 block = Mat3::Zero();
      block(1, 1) = depth(x[i]) > 0 ? k_ : 0;
      sink(int(i), int(i), block);
    }
    return true;
  }

 private:
  static double depth(const Vec3& p) { return p.y() < 0 ? -p.y() : 0; }
  double k_;
};

int main() {
  const double mass = 0.02, k = 40;
  Cloth cloth;
  cloth.particles = {
      {{0, 0.05, 0}, {0.1, 0.02, 0}}, {{0, 0, 0}, {0, 0, 0}}, {mass, mass}, {1 / mass, 1 / mass}};
  cloth.structural = {{0, 1, 0.1, 100}};  // particles, rest length [m], stiffness [N/m]
  cloth.energies = {std::make_shared<SoftFloor>(k)};
  Cloth fallen = cloth;
  settle(cloth, nullptr, {.tolerance = 1e-8});
  SimulateOptions options;
  options.seconds = 10;
  options.air_drag = 5;
  const Collider* no_body = nullptr;
  simulate(fallen, no_body, options);
  bool good = true;
  for (const Cloth* c : {&cloth, &fallen}) {
    for (const Vec3& p : c->particles.x) {
      std::printf("%.6f m deep, expected %.6f\n", -p.y(), mass * 9.81 / k);
      good = good && std::abs(-p.y() - mass * 9.81 / k) < 1e-6;
    }
  }
  return good ? 0 : 1;
}
