// SPDX-License-Identifier: MIT
#include "physics/motion/implicit_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/base/require.h"
#include "physics/base/vector_sums.h"
#include "physics/motion/pair_memory.h"
#include "physics/motion/step_elements.h"

namespace furrow::physics {
namespace {

using Vectors = std::vector<Vec3>;

constexpr double standard_gravity = 9.81;  // m/s^2: the scale of a tolerance, whatever acts
constexpr int most_iterations = 12;
constexpr double push_over_inertia = 100;  // of a mean particle in a step
constexpr int most_parts = 32;             // of a step
constexpr int most_rounds_of_leading = 8;  // in which cloth goes out of the way of what is led
constexpr int iterations_of_round = 4;
constexpr double moment = 0.01;  // of a step, for a velocity

Vectors sum(const Vectors& a, double factor, const Vectors& b) {
  Vectors result = a;
  add_multiple(result, factor, b);
  return result;
}

template <class Numbers>
Numbers scaled(double factor, Numbers v) {
  for (auto& e : v) e *= factor;
  return v;
}

}  // namespace

ImplicitStep::ImplicitStep(Motion& motion, Integrator scheme, const ImplicitOptions& options,
                           const SelfContactOptions& self)
    : motion_(motion),
      scheme_(scheme),
      options_(options),
      self_(self),
      cloth_(cloth_by_place(motion.cloth())) {
  require("implicit step", "tolerance", options.tolerance, options.tolerance > 0, "> 0");
  require("implicit step", "few", options.few, options.few >= 1, ">= 1");
  if (!self.on) return;
  require("implicit step", "thickness", self.thickness, self.thickness > 0, "> 0");
  if (cloth_.triangles.empty())
    refuse("implicit step", "contact of the cloth with itself needs its triangles (Cloth::triangles)");
}

/// On the first step: recall() may come before it. Push beats inertia by far, so that soft cloth that falls
/// is stopped, too, and what lies on the body at the start is held from there on.
void ImplicitStep::prepare(double dt) {
  if (search_) return;
  const Particles& p = cloth_.particles;
  const BodyAround* body = motion_.body();
  StepSearch scale(cloth_, motion_, nullptr, nullptr, {});
  begins_ = stiffness_ == 0;
  if ((body || self_.on || !options_.contacts.empty()) && begins_) {
    stiffness_ = std::max(scale.contact_stiffness(p.x), push_over_inertia * scale.mean_mass() / (dt * dt));
  }
  if (body) {
    contact_ = std::make_unique<StepContact>(*body, stiffness_, p.size(), motion_.from());
    begin_contact(scale.elements_at(p.x).pull);
  }
  if (self_.on) make_pairs();
  for (const ContactMaker& make : options_.contacts) others_.push_back(make(cloth_, stiffness_));
  make_search();
  fresh_.clear();
}

/// What begins here may lie as deep as it does, and is pushed by what presses it to the body: pull is the
/// elements'.
void ImplicitStep::begin_contact(Vectors pull) {
  const Particles& p = cloth_.particles;
  const bool known = !anchors_.empty();
  if (known) contact_->set_anchors(anchors_);
  if (known && fresh_.empty()) return;
  std::vector<char> fresh(p.size(), !known), begins;
  for (const int i : fresh_) fresh[std::size_t(i)] = 1;
  for (const int i : motion_.cloth().particle) begins.push_back(fresh[std::size_t(i)]);
  for (std::size_t i = 0; i < p.size(); ++i) pull[i] += p.mass[i] * motion_.loads().gravity;
  contact_->look(p.x, p.inv_mass, &motion_.pool());
  contact_->let_in(pull, begins);
  if (known) return;  // the step gives anchors to what it finds pushed and without one
  contact_->look(p.x, p.inv_mass, &motion_.pool());
  contact_->move_anchors();
}

void ImplicitStep::make_pairs() {
  const WorkClock::Within pair_part(motion_.clock(), WorkPart::self_contact);
  pairs_ = std::make_unique<ClothContact>(with_free_leads(cloth_, motion_.led()),
                                          ClothContactOptions{self_.thickness, stiffness_, self_.friction},
                                          cloth_.particles.x, std::span<const Vec3>{}, &motion_.pool());
  const Vectors x = read().x;
  if (known_.stiffness == 0 && self_.friction > 0) {  // what lies on the cloth is held from here on
    pairs_->look(x, &motion_.pool());
    pairs_->move_anchors(x);
  }
  recall_pairs(known_, fresh_, motion_.cloth().particle, x, *pairs_, &motion_.pool());
}

SelfContactMemory ImplicitStep::pair_memory() const {
  if (!pairs_) return known_;
  const std::vector<int>& particle = motion_.cloth().particle;
  SelfContactMemory result = memory_of(*pairs_, stiffness_, particle);
  const auto by_particle = [&](FreeStiffness::Pairs pairs) {
    for (auto& pair : pairs)
      for (int& i : pair) i = particle[std::size_t(i)];
    return pairs;
  };
  result.coupled = by_particle(search_->coupled());
  if (!result.coupled.empty()) result.ordered_for = by_particle(search_->ordered_for());
  return result;
}

SelfContactState ImplicitStep::self_contact() const {
  SelfContactState state;
  state.on = self_.on;
  if (!pairs_) return state;
  state.pairs = pairs_->touching();
  if (state.pairs > 0) state.nearest = pairs_->nearest();
  state.crossed_at_start = pairs_->crossed_at_start();
  state.exempt = pairs_->exempt();
  return state;
}

/// Brings a guess to where the cloth can go from a place. Returns how many particles do not arrive; one that
/// is held is noted.
int ImplicitStep::approach(const Vectors& from, Vectors& x) {
  const WorkClock::Within pair_part(motion_.clock(), WorkPart::self_contact);
  Vectors reached = from;
  no_room_.reset();
  const int stopped = pairs_->approach(reached, x, &motion_.pool());
  if (stopped > 0)
    for (std::size_t i = 0; i < x.size() && !no_room_; ++i)
      if (!(cloth_.particles.inv_mass[i] > 0) && reached[i] != x[i]) no_room_ = reached[i];
  x = std::move(reached);
  return stopped;
}

ImplicitStep::State ImplicitStep::read() const {
  const PackedCloth& cloth = motion_.cloth();
  State state;
  state.a = a_;
  for (std::size_t i = 0; i < cloth.x.size(); ++i) {
    state.x.push_back(xyz(cloth.x[i]));
    state.v.push_back(xyz(cloth.v[i]));
  }
  return state;
}

/// From the step before, if nothing was put elsewhere: the same bits.
void ImplicitStep::know_elements(State& state) {
  state.elements = state.x == end_ ? elements_ : search_->elements_at(state.x);
}

void ImplicitStep::write(const State& state) {
  PackedCloth& cloth = motion_.cloth();
  for (std::size_t i = 0; i < cloth.x.size(); ++i) {
    const Vec3 &x = state.x[i], &v = state.v[i];
    cloth.x[i] = {x.x(), x.y(), x.z(), 0};
    if (cloth.inv_mass[i] > 0) cloth.v[i] = {v.x(), v.y(), v.z(), 0};
  }
  motion_.arrive();
  a_ = state.a;
  end_ = state.x;
  elements_ = state.elements;
}

/// What compensates, and the air where the cloth is.
StepLoads ImplicitStep::loads_at(double time) {
  StepLoads given;
  PackedCloth& cloth = motion_.cloth();
  if (motion_.compensates()) {
    motion_.update_compensation(time);
    for (const Vec4& f : cloth.force) given.force.push_back(xyz(f));
  }
  if (motion_.wind()) {
    std::vector<Vec4> air;
    air_at(cloth, *motion_.wind(), time, air, motion_.pool());
    for (const Vec4& w : air) given.air.push_back(xyz(w));
  }
  return given;
}

/// Brings a guess to where cloth lets it. Where cloth is in its own way, what is free begins where it was
/// instead: a guess that is stopped particle by particle is torn, and its pairs all but touch.
/// What is led goes as far as it can, and then, round by round, as the rest goes out of its way. false: it
/// does not arrive.
bool ImplicitStep::make_way(const Stage& stage, const StepLoads& loads, const StageStart& start,
                            SearchOptions options, Vectors& x) {
  const std::vector<double>& inv_mass = cloth_.particles.inv_mass;
  options.few = options.most = iterations_of_round;
  const Vectors goal = x;
  Vectors reached(start.x.begin(), start.x.end());
  if (approach(reached, x) == 0) return true;
  x = reached;
  const auto lead = [&] {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!(inv_mass[i] > 0)) x[i] = goal[i];
  };
  lead();
  for (int round = 0; approach(reached, x), no_room_; ++round) {
    if (round == most_rounds_of_leading) return false;
    search_->find(stage, loads, start, options, x);
    reached = x;
    lead();
  }
  return true;
}

/// From the step's guess in x. true: the stage is solved, and friction has followed.
ImplicitStep::Solved ImplicitStep::solve(const Stage& stage, const State& start, Interval time, int few,
                                         Vectors& x) {
  const Particles& p = cloth_.particles;
  const double h = time.length();
  Solved solved;
  Vectors carried;
  if (contact_) {
    const WorkClock::Within contact(motion_.clock(), WorkPart::contact);
    carried = contact_->move_body(time.from, time.to, start.x);
    contact_->keep_out(carried, p.inv_mass, x, motion_.pool());
  }
  // Parts may leave as much in velocity as the whole step may.
  const double tolerance = options_.tolerance * standard_gravity * h * h * time.parts;
  const bool first_order = scheme_ == Integrator::implicit;
  const SearchOptions options{tolerance, few, most_iterations, first_order,
                              first_order && options_.keep_factors};
  solved.loads = loads_at(time.to);
  const StageStart begin{start.x, carried};
  if (pairs_ && !make_way(stage, solved.loads, begin, options, x)) return solved;
  solved.converged = search_->find(stage, solved.loads, begin, options, x).converged;
  solved.forces = search_->found();
  if (contact_) solved.body_way = contact_->ways(carried, start.x);
  solved.carried = std::move(carried);
  search_->hold(x);
  return solved;
}

/// What a solved step did. Backward Euler's forces are those at the end, so what leads has its velocity of
/// then: a push straight outwards does no work on what turns. Else it is that of the way in the step.
void ImplicitStep::book(const State& start, const State& end, const StepImpulse& impulse, double seconds) {
  Vectors after = end.v;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (!(cloth_.particles.inv_mass[i] > 0)) after[i].setZero();
  const std::span<const int> led = motion_.led();
  const bool first_order = scheme_ == Integrator::implicit;
  const Vectors at_end = first_order ? motion_.led_velocities(moment) : Vectors{};
  for (std::size_t k = 0; k < led.size(); ++k) {
    const auto i = std::size_t(led[k]);
    after[i] = first_order ? at_end[k] : Vec3((end.x[i] - start.x[i]) / seconds);
  }
  motion_.work().energy +=
      balance_of(cloth_.particles, motion_.loads().gravity, {start.x, start.v, start.elements.energy},
                 {end.x, after, end.elements.energy}, impulse, seconds);
}

std::optional<ImplicitStep::State> ImplicitStep::euler(const State& start, Interval time) {
  const double h = time.length();
  const bool last = time.parts == most_parts;
  // A velocity of backward Euler is that of the middle of its step; the first step, which gets that of its
  // start, has the forces for half of its time. Without that, what slides stops v h / 2 too soon.
  const bool begins = begins_ && contact_ && scheme_ == Integrator::implicit && time.from == motion_.from();
  const double seconds = begins ? h / 2 : h;
  Stage stage{1 / (seconds * h), 1 / h, sum(start.x, h, start.v), scaled(-1 / h, start.x)};
  State end;
  end.x = stage.y;
  const Solved solved = solve(stage, start, time, options_.few, end.x);
  if (!solved.converged && !last) return std::nullopt;
  if (!solved.converged && no_room_) throw StepBlocked(*no_room_);
  open_ = open_ || !solved.converged;
  end.v = sum(stage.q, stage.p, end.x);
  end.elements = solved.forces.elements;
  StepImpulse impulse(cloth_.particles, motion_.loads().air_drag);
  impulse.add(seconds, solved.forces, solved.loads, end.v);
  if (contact_) {
    const auto [surface, slip] =
        contact_->beside(solved.carried, solved.body_way, start.x, start.v, end.x, time.from, time.to);
    impulse.go_along(surface, slip);
  }
  book(start, end, impulse, h);
  if (scheme_ == Integrator::tr_bdf2) end.a = scaled(1 / h, sum(end.v, -1, start.v));
  return end;
}

/// What the body did to the cloth where the last step ended: what is left of the acceleration.
Vectors ImplicitStep::contact_before(const State& start, const std::vector<ContactAnchor>& anchors,
                                     const StepLoads& loads) const {
  if (anchors.empty()) return {};
  const Particles& p = cloth_.particles;
  Vectors force(p.size(), Vec3::Zero());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!(p.inv_mass[i] > 0) || anchors[i].limit < 0) continue;
    const Vec3 wind = loads.air.empty() ? start.v[i] : Vec3(start.v[i] - loads.air[i]);
    force[i] = p.mass[i] * (start.a[i] - motion_.loads().gravity + motion_.loads().air_drag * wind) -
               start.elements.pull[i];
  }
  return force;
}

std::optional<ImplicitStep::State> ImplicitStep::tr_bdf2(const State& start, Interval time) {
  const double h = time.length(), gamma = 2 - std::numbers::sqrt2, b = gamma * h / 2;
  const Interval first{time.from, time.from + gamma * h, time.parts}, second{first.to, time.to, time.parts};
  Stage trapezoid{1 / (b * b), 1 / b, sum(sum(start.x, 2 * b, start.v), b * b, start.a),
                  sum(scaled(-1 / b, start.x), -1, start.v)};
  FoundForces at_start{start.elements, {}, {}};
  const auto anchors = contact_ ? contact_->anchors() : std::vector<ContactAnchor>{};
  State middle;
  middle.x = sum(start.x, gamma * h, start.v);
  const Solved to_middle = solve(trapezoid, start, first, most_iterations, middle.x);
  if (!to_middle.converged) return std::nullopt;
  middle.v = sum(trapezoid.q, trapezoid.p, middle.x);

  const double c1 = 1 / (gamma * (2 - gamma)), c0 = c1 - 1;
  const Vectors place = sum(scaled(c1, middle.x), -c0, start.x);
  const Vectors speed = sum(scaled(c1, middle.v), -c0, start.v);
  Stage bdf2{1 / (b * b), 1 / b, sum(place, b, speed), scaled(-1 / b, place)};
  State end;
  end.x = sum(middle.x, (1 - gamma) * h, middle.v);
  const Solved to_end = solve(bdf2, middle, second, most_iterations, end.x);
  if (!to_end.converged) return std::nullopt;
  end.v = sum(bdf2.q, bdf2.p, end.x);
  end.a = scaled(bdf2.s, sum(end.x, -1, bdf2.y));
  end.elements = to_end.forces.elements;
  at_start.body = contact_before(start, anchors, to_middle.loads);
  at_start.cloth = to_middle.forces.cloth;
  StepImpulse impulse(cloth_.particles, motion_.loads().air_drag);
  impulse.add(c1 * b, at_start, to_middle.loads, start.v);
  impulse.add(c1 * b, to_middle.forces, to_middle.loads, middle.v);
  impulse.add(b, to_end.forces, to_end.loads, end.v);
  if (contact_) {
    const Vectors surface = scaled(1 / h, sum(to_middle.body_way, 1, to_end.body_way));
    impulse.go_along(surface, sum(scaled(0.5, sum(start.v, 1, end.v)), -1, surface));
  }
  book(start, end, impulse, h);
  return end;
}

/// By the scheme, else by backward Euler, else in halves.
ImplicitStep::State ImplicitStep::advance(const State& start, Interval time) {
  const auto anchors = contact_ ? contact_->anchors() : std::vector<ContactAnchor>{};
  const auto of_pairs = pairs_ ? pairs_->anchors() : std::vector<PairAnchor>{};
  const auto go_back = [&] {
    if (pairs_) pairs_->set_anchors(of_pairs, start.x, &motion_.pool());
    if (!contact_) return;
    contact_->set_anchors(anchors);
    contact_->move_body(time.from, time.from, {});
  };
  try {
    if (scheme_ == Integrator::tr_bdf2 && !start.a.empty()) {
      if (auto end = tr_bdf2(start, time)) return *std::move(end);
      go_back();
    }
    if (auto end = euler(start, time)) return *std::move(end);
    go_back();
    const double middle = 0.5 * (time.from + time.to);
    const State half = advance(start, {time.from, middle, 2 * time.parts});
    return advance(half, {middle, time.to, 2 * time.parts});
  } catch (...) {
    go_back();
    throw;
  }
}

void ImplicitStep::step(double dt) {
  require("implicit step", "dt", std::min(dt, 1e300), dt > 0, "> 0");
  prepare(dt);
  State start = read();
  know_elements(start);
  const SelfContactMemory known = pair_memory();
  open_ = false;
  try {
    if (pairs_) pairs_->widen(start.x);
    State end = advance(start, {motion_.from(), motion_.from() + dt, 1});
    if (contact_) lead_out(motion_.body()->recovery_speed * dt, end);
    write(end);
    begins_ = false;
  } catch (...) {
    if (pairs_) forget_step(known);
    throw;
  }
  motion_.work().open_steps += open_;
  ++motion_.work().steps;
}

/// What began in the gap is moved, not pushed: it gets no speed.
void ImplicitStep::lead_out(double by, State& state) {
  Vectors ways = contact_->lead_out(by);
  if (std::all_of(ways.begin(), ways.end(), [](const Vec3& way) { return way.isZero(0); })) return;
  Vectors x = sum(state.x, 1, ways);
  if (pairs_) approach(state.x, x);
  state.x = std::move(x);
  state.elements = search_->elements_at(state.x);
}

/// Contact of the cloth with itself as before the step.
void ImplicitStep::forget_step(const SelfContactMemory& before) {
  known_ = before;
  make_pairs();
  make_search();
}

void ImplicitStep::make_search() {
  search_ = std::make_unique<StepSearch>(cloth_, motion_, contact_.get(), pairs_.get(), others_);
  couple_again();
}

/// As the memory says that it was.
void ImplicitStep::couple_again() {
  SelfContactMemory placed = by_place(known_, motion_.cloth().particle);
  search_->couple(std::move(placed.coupled), std::move(placed.ordered_for));
}

void ImplicitStep::recall(const StepMemory& memory) {
  const std::vector<int>& particle = motion_.cloth().particle;
  for (const int i : particle) {
    if (!memory.acceleration.empty()) a_.push_back(memory.acceleration[std::size_t(i)]);
    if (!memory.anchors.empty()) anchors_.push_back(memory.anchors[std::size_t(i)]);
  }
  stiffness_ = memory.contact_stiffness;
  known_ = memory.self;
  fresh_ = memory.fresh;
  recalled_ = memory;
}

StepMemory ImplicitStep::memory() const {
  if (begins_) return recalled_;  // its first step was given up: whoever goes on begins, too
  const std::vector<int>& particle = motion_.cloth().particle;
  StepMemory memory;
  memory.contact_stiffness = stiffness_;
  memory.self = pair_memory();
  memory.fresh = fresh_;
  memory.acceleration.resize(a_.size());
  const auto anchors = contact_ ? contact_->anchors() : anchors_;
  memory.anchors.resize(anchors.size());
  for (std::size_t i = 0; i < particle.size(); ++i) {
    if (!a_.empty()) memory.acceleration[std::size_t(particle[i])] = a_[i];
    if (!anchors.empty()) memory.anchors[std::size_t(particle[i])] = anchors[i];
  }
  return memory;
}

}  // namespace furrow::physics
