// SPDX-License-Identifier: MIT
#include "physics/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <string>

#include "physics/base/lanes.h"
#include "physics/packed/packed_forces.h"

namespace furrow::physics {
namespace {

constexpr int most_pair_sweeps = 16;  // a step

void check_not_negative(double value, const char* name) {
  if (!(value >= 0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + " is not >= 0");
  }
}

struct Kick {
  const Vec4* force;
  const double* inv_mass;
  Vec4* v;
  Vec4 gravity;                   // times seconds
  double seconds, before, after;  // v = ((before v) + seconds a) after
};

FURROW_VECTOR_CLONES
void kick_range(const Kick* kick, int begin, int end) {
  const Kick k = *kick;
  const Lanes g = *(const Lanes*)&kick->gravity;
  Lanes before, after;
  spread(k.before, before);
  spread(k.after, after);
  for (int i = begin; i < end; ++i) {
    if (k.inv_mass[i] == 0) continue;
    Lanes h;
    spread(k.seconds * k.inv_mass[i], h);
    Lanes* v = (Lanes*)(k.v + i);
    *v = ((*v * before) + (h * *(const Lanes*)(k.force + i) + g)) * after;
  }
}

void kick(PackedCloth& cloth, const Loads& loads, ThreadPool& pool, double seconds, double before,
          double after) {
  const Vec3 g = seconds * loads.gravity;
  const Kick k{cloth.force.data(),
               cloth.inv_mass.data(),
               cloth.v.data(),
               {g.x(), g.y(), g.z(), 0},
               seconds,
               before,
               after};
  pool.run(cloth.particles(), [&](int begin, int end) { kick_range(&k, begin, end); });
}

FURROW_VECTOR_CLONES
void drift_range(Vec4* x, const Vec4* v, double seconds, int begin, int end) {
  Lanes h;
  spread(seconds, h);
  for (int i = begin; i < end; ++i) *(Lanes*)(x + i) += h * *(const Lanes*)(v + i);
}

ContactCounts drift_with_contact(PackedCloth& cloth, BodyContact& contact, double seconds, int begin,
                                 int end) {
  ContactCounts counts;
  const bool asks_in_world = contact.asks_in_world();
  for (int i = begin; i < end; ++i) {
    if (cloth.inv_mass[i] == 0) continue;
    Vec4 &x4 = cloth.x[i], &v4 = cloth.v[i];
    const Vec3 before(x4.x, x4.y, x4.z);
    Vec3 v(v4.x, v4.y, v4.z), x = before + seconds * v;
    if (asks_in_world && contact.is_clear(i, x)) {
      x4 = {x.x(), x.y(), x.z(), 0};
      continue;
    }
    contact.respond(i, before, seconds, x, v, counts);
    x4 = {x.x(), x.y(), x.z(), 0};
    v4 = {v.x(), v.y(), v.z(), 0};
  }
  return counts;
}

}  // namespace

Motion::Motion(const Cloth& cloth, const Loads& loads, ThreadPool& pool, const Surroundings& around,
               double time)
    : cloth_(pack(cloth, loads.spring_damping > 0)),
      loads_(loads),
      pool_(pool),
      around_(around),
      from_(time),
      to_(time) {
  check_not_negative(loads.air_drag, "air drag");
  check_not_negative(loads.spring_damping, "spring damping");
  if (!loads.gravity.allFinite()) throw std::invalid_argument("gravity is not finite");
  if (around_.pins) around_.pins->attach(cloth_);
  if (around_.pairs) around_.pairs->attach(cloth_, led(), pool_);
  update_forces();
}

const DampingSweep& Motion::damping(double seconds) {
  if (seconds != damping_seconds_) damping_ = DampingSweep(cloth_, loads_.spring_damping, seconds);
  damping_seconds_ = seconds;
  return damping_;
}

void Motion::damp_forward(double seconds) { damping(seconds).forward(cloth_, pool_); }
void Motion::damp_reverse(double seconds) { damping(seconds).reverse(cloth_, pool_); }

void Motion::begin_step(double from, double to) {
  from_ = from, to_ = to;
  if (around_.pins) around_.pins->begin_step(cloth_, to, to - from);
  if (!around_.contact) return;
  const WorkClock::Within contact(clock(), WorkPart::contact);
  around_.contact->begin_step(from, to);
}

void Motion::drag_and_kick(double seconds) {
  const double decay = std::exp(-loads_.air_drag * seconds);
  if (around_.wind) blow(cloth_, *around_.wind, from_, decay, pool_);
  kick(cloth_, loads_, pool_, seconds, around_.wind ? 1 : decay, 1);
}

void Motion::kick_and_drag(double seconds) {
  const double decay = std::exp(-loads_.air_drag * seconds);
  kick(cloth_, loads_, pool_, seconds, 1, around_.wind ? 1 : decay);
  if (around_.wind) blow(cloth_, *around_.wind, to_, decay, pool_);
}

void Motion::drift(double seconds) {
  const std::vector<Vec4> before = around_.pairs ? cloth_.x : std::vector<Vec4>{};
  if (around_.contact) {
    const WorkClock::Within contact(clock(), WorkPart::contact);
    std::mutex mutex;
    pool_.run(cloth_.particles(), [&](int begin, int end) {
      const ContactCounts counts = drift_with_contact(cloth_, *around_.contact, seconds, begin, end);
      const std::lock_guard lock(mutex);
      work_.contact += counts;
    });
  } else {
    pool_.run(cloth_.particles(), [&](int begin, int end) {
      drift_range(cloth_.x.data(), cloth_.v.data(), seconds, begin, end);
    });
  }
  arrive();
  if (around_.pairs) keep_apart(before, seconds);
}

/// What cloth pushes may come to be nearer to the body than it was, so the two take turns.
void Motion::keep_apart(const std::vector<Vec4>& before, double seconds) {
  const WorkClock::Within self(clock(), WorkPart::self_contact);
  PairResponse& pairs = *around_.pairs;
  if (!pairs.begin_step(before, cloth_, pool_)) return;
  for (int sweep = 0; sweep < most_pair_sweeps; ++sweep) {
    const bool again = pairs.sweep(seconds, cloth_);
    if (around_.contact) meet_body(pairs.touched(), before, seconds);
    if (!again) break;
  }
  pairs.finish_step(before, seconds, cloth_, pool_);
}

void Motion::meet_body(const std::vector<int>& places, const std::vector<Vec4>& before, double seconds) {
  for (const int place : places) {
    const auto i = std::size_t(place);
    if (cloth_.inv_mass[i] == 0) continue;
    const Vec4 &x0 = before[i], &x1 = cloth_.x[i], &v1 = cloth_.v[i];
    Vec3 x(x1.x, x1.y, x1.z), v(v1.x, v1.y, v1.z);
    around_.contact->respond(place, {x0.x, x0.y, x0.z}, seconds, x, v, work_.contact);
    cloth_.x[i] = {x.x(), x.y(), x.z(), 0};
    cloth_.v[i] = {v.x(), v.y(), v.z(), 0};
  }
}

void Motion::update_forces(double time) {
  const WorkClock::Within elements(clock(), WorkPart::elements);
  update_spring_forces(cloth_, pool_);
  add_element_forces(cloth_.elements, cloth_.x, cloth_.force, pool_);
  add_other_forces(cloth_);
  if (around_.compensation) compensate(time);
  ++work_.force_evaluations;
  work_.spring_evaluations += cloth_.springs() - cloth_.dashpots + cloth_.elements.tension_count;
  work_.triangle_evaluations += cloth_.elements.triangle_count;
  work_.hinge_evaluations += cloth_.elements.hinge_count;
}

void Motion::update_compensation(double time) {
  std::fill(cloth_.force.begin(), cloth_.force.end(), Vec4{});
  if (around_.compensation) compensate(time);
}

void Motion::compensate(double time) {
  const double share = share_left(*around_.compensation, time);
  if (share == 0) return;
  for (std::size_t i = 0; i < cloth_.force.size(); ++i) {
    const Vec3 f = share * around_.compensation->force[std::size_t(cloth_.particle[i])];
    Vec4& force = cloth_.force[i];
    force = {force.x - f.x(), force.y - f.y(), force.z - f.z(), 0};
  }
}

void Motion::arrive() {
  if (around_.pins) around_.pins->arrive(cloth_);
}

void Motion::unpack(Particles& particles) const {
  physics::unpack(cloth_, particles);
  if (around_.pins) around_.pins->unpack(cloth_, particles);
}

}  // namespace furrow::physics
