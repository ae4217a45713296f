// SPDX-License-Identifier: MIT
#include "physics/motion/rk4_step.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "physics/base/lanes.h"
#include "physics/packed/dashpots.h"

namespace furrow::physics {
namespace {

struct Stage {
  const Vec4 *force, *air, *x0, *v0;  // air: null if it is still
  const double* inv_mass;
  Vec4 *x, *v, *sum_v, *sum_a;
  Vec4 gravity;
  double drag, weight, ahead;
};

FURROW_INLINE Lanes& lanes(Vec4& v) { return *(Lanes*)&v; }
FURROW_INLINE const Lanes& lanes(const Vec4& v) { return *(const Lanes*)&v; }

/// sums += weight (v, a);  (x, v) = (x0, v0) + ahead (v, a)
FURROW_VECTOR_CLONES
void run_stage(const Stage* stage, int begin, int end) {
  const Stage s = *stage;
  const Lanes g = lanes(stage->gravity);
  Lanes drag, weight, ahead;
  spread(s.drag, drag);
  spread(s.weight, weight);
  spread(s.ahead, ahead);
  for (int i = begin; i < end; ++i) {
    if (s.inv_mass[i] == 0) {
      lanes(s.x[i]) = lanes(s.x0[i]) + ahead * lanes(s.v0[i]);
      continue;
    }
    Lanes inv;
    spread(s.inv_mass[i], inv);
    const Lanes v = lanes(s.v[i]), u = s.air ? lanes(s.air[i]) - v : -v;
    const Lanes a = inv * lanes(s.force[i]) + g + drag * u;
    lanes(s.sum_v[i]) += weight * v;
    lanes(s.sum_a[i]) += weight * a;
    lanes(s.x[i]) = lanes(s.x0[i]) + ahead * v;
    lanes(s.v[i]) = lanes(s.v0[i]) + ahead * a;
  }
}

}  // namespace

Rk4::Rk4(Motion& motion)
    : motion_(motion), dashpots_(dashpots(motion.cloth(), motion.loads().spring_damping)) {}

void Rk4::stage(double time, double weight, double ahead) {
  PackedCloth& cloth = motion_.cloth();
  const Loads& loads = motion_.loads();
  add_dashpot_forces(cloth, dashpots_, motion_.pool());
  if (motion_.wind()) air_at(cloth, *motion_.wind(), time, air_, motion_.pool());
  const Vec3& g = loads.gravity;
  const Stage s{cloth.force.data(),
                motion_.wind() ? air_.data() : nullptr,
                x_.data(),
                v_.data(),
                cloth.inv_mass.data(),
                cloth.x.data(),
                cloth.v.data(),
                sum_v_.data(),
                sum_a_.data(),
                {g.x(), g.y(), g.z(), 0},
                loads.air_drag,
                weight,
                ahead};
  motion_.pool().run(cloth.particles(), [&](int begin, int end) { run_stage(&s, begin, end); });
}

/// From the sums: the move with the mean velocity, then the kick by what is left.
void Rk4::move(double dt) {
  PackedCloth& cloth = motion_.cloth();
  Lanes h;
  spread(dt, h);
  cloth.x = x_;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (cloth.inv_mass[i] == 0) continue;
    lanes(cloth.v[i]) = lanes(sum_v_[i]);
    lanes(sum_a_[i]) = lanes(v_[i]) + h * lanes(sum_a_[i]) - lanes(sum_v_[i]);
  }
  motion_.drift(dt);
  for (std::size_t i = 0; i < x_.size(); ++i)
    if (cloth.inv_mass[i] != 0) lanes(cloth.v[i]) += lanes(sum_a_[i]);
}

void Rk4::step(double dt) {
  if (!(dt > 0)) throw std::invalid_argument("Rk4: dt = " + std::to_string(dt) + " is not > 0");
  const double from = motion_.from(), to = motion_.to(), middle = from + (to - from) / 2;
  x_ = motion_.cloth().x;
  v_ = motion_.cloth().v;
  sum_v_.assign(x_.size(), Vec4{});
  sum_a_.assign(x_.size(), Vec4{});
  stage(from, 1.0 / 6, dt / 2);
  motion_.update_forces(middle);
  stage(middle, 1.0 / 3, dt / 2);
  motion_.update_forces(middle);
  stage(middle, 1.0 / 3, dt);
  motion_.update_forces(to);
  stage(to, 1.0 / 6, 0);
  move(dt);
  motion_.update_forces();
  ++motion_.work().steps;
}

}  // namespace furrow::physics
