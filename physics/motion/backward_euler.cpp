// SPDX-License-Identifier: MIT
#include "physics/motion/backward_euler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/base/require.h"
#include "physics/cloth/elements.h"
#include "physics/packed/dashpots.h"

namespace furrow::physics {
namespace {

constexpr double least_l = 1e-140;  // m; shorter springs have no direction
constexpr int most_halvings = 10;
constexpr double rounding = 1e-14;  // of an energy

Vec3 vec3(const Vec4& v) { return {v.x, v.y, v.z}; }

std::vector<Vec3> positions(const PackedCloth& cloth) {
  std::vector<Vec3> x;
  for (const Vec4& p : cloth.x) x.push_back(vec3(p));
  return x;
}

BlockMatrix make_system(const PackedCloth& cloth) {
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < cloth.springs(); ++i) pairs.push_back({cloth.a[i], cloth.b[i]});
  add_stiffness(cloth.shell, positions(cloth), Stiffness::positive_part, [&](int i, int j, const Mat3&) {
    pairs.push_back({i, j});
  });
  return BlockMatrix(cloth.inv_mass, pairs);
}

/// k n n^T + k (1 - L/l) (I - n n^T) without its second part where that is negative.
Mat3 positive_stiffness(double k, double kL, const Vec3& d) {
  const double l = d.norm();
  if (l < least_l) return Mat3::Zero();
  const double transverse = std::max(k - kL / l, 0.0);
  const Vec3 n = d / l;
  return transverse * Mat3::Identity() + ((k - transverse) * n) * n.transpose();
}

}  // namespace

BackwardEuler::BackwardEuler(Motion& motion, const BackwardEulerOptions& options)
    : motion_(motion),
      options_(options),
      dashpots_(dashpots(motion.cloth(), motion.loads().spring_damping)),
      system_(make_system(motion.cloth())) {
  const int iterations = options.newton_iterations;
  require("backward Euler", "newton_iterations", iterations, iterations >= 1, ">= 1");
  const double tolerance = options.newton_tolerance;
  require("backward Euler", "newton_tolerance", std::min(tolerance, 1e300), tolerance >= 0, ">= 0");
  const PackedCloth& cloth = motion.cloth();
  dashpots_.resize(cloth.a.size(), 0.0);
  find_places();
}

/// Of an element's blocks (i, j) and (j, i), which are each other's mirror images, one goes to the matrix.
void BackwardEuler::find_places() {
  const PackedCloth& cloth = motion_.cloth();
  for (int i = 0; i < cloth.particles(); ++i) diagonal_.push_back(system_.place(i, i));
  for (int i = 0; i < cloth.springs(); ++i) off_diagonal_.push_back(system_.place(cloth.a[i], cloth.b[i]));
  add_stiffness(cloth.shell, positions(cloth), Stiffness::positive_part,
                [&](int i, int j, const Mat3&) { shell_.push_back(i >= j ? system_.place(i, j) : Place{}); });
}

void BackwardEuler::find_directions() {
  const PackedCloth& cloth = motion_.cloth();
  direction_.clear();
  for (int i = 0; i < cloth.springs(); ++i) {
    const Vec3 d = vec3(cloth.x[cloth.b[i]]) - vec3(cloth.x[cloth.a[i]]);
    const double l = d.norm();
    direction_.push_back(l < least_l ? Vec3::Zero() : Vec3(d / l));
  }
}

/// S (v_a - v_b) on the right and S in the matrix: of the first iteration S = dt^2 K + dt D, as f at x + dt v
/// is f(x) - dt K v; afterwards the force is that of the positions reached, and S = dt D on the right.
void BackwardEuler::add_springs(double dt, bool first) {
  const PackedCloth& cloth = motion_.cloth();
  for (int i = 0; i < cloth.springs(); ++i) {
    const int a = cloth.a[i], b = cloth.b[i];
    const Vec3& n = direction_[std::size_t(i)];
    const Mat3 damping = (dt * dashpots_[std::size_t(i)] * n) * n.transpose();
    const Mat3 whole =
        damping + dt * dt * positive_stiffness(cloth.k[i], cloth.kL[i], vec3(cloth.x[b]) - vec3(cloth.x[a]));
    const Vec3 resistance = (first ? whole : damping) * (vec3(cloth.v[a]) - vec3(cloth.v[b]));
    change_[std::size_t(a)] -= resistance;
    change_[std::size_t(b)] += resistance;
    system_.add(diagonal_[std::size_t(a)], whole);
    system_.add(diagonal_[std::size_t(b)], whole);
    system_.add(off_diagonal_[std::size_t(i)], -whole);
  }
}

/// The same of membrane and hinges, which have no dashpots of their own.
void BackwardEuler::add_shell(double dt, bool first) {
  const PackedCloth& cloth = motion_.cloth();
  if (shell_.empty()) return;
  std::size_t next = 0;
  add_stiffness(cloth.shell, positions(cloth), Stiffness::positive_part, [&](int i, int j, const Mat3& k) {
    if (next == shell_.size())
      throw std::invalid_argument("backward Euler: an energy hands out more blocks of stiffness than before");
    const Mat3 block = dt * dt * k;
    if (first) change_[std::size_t(i)] -= block * vec3(cloth.v[std::size_t(j)]);
    system_.add(shell_[next++], block);
  });
}

/// M (1 + c dt) + dt D + dt^2 K  and  -(M (v - v_0) + dt D v - dt (f + M g + c M (air - v))).
void BackwardEuler::assemble(double dt, bool first) {
  const WorkClock::Within assembly(motion_.clock(), WorkPart::assembly);
  const PackedCloth& cloth = motion_.cloth();
  const Loads& loads = motion_.loads();
  system_.set_zero();
  change_.assign(cloth.x.size(), Vec3::Zero());
  for (std::size_t i = 0; i < cloth.x.size(); ++i) {
    if (cloth.inv_mass[i] == 0) continue;
    const double m = 1 / cloth.inv_mass[i];
    const Vec3 v = vec3(cloth.v[i]), air = motion_.wind() ? vec3(air_[i]) : Vec3::Zero();
    change_[i] = dt * vec3(cloth.force[i]) +
                 m * (dt * (loads.gravity + loads.air_drag * (air - v)) - (v - vec3(v_[i])));
    system_.add(diagonal_[i], m * (1 + dt * loads.air_drag) * Mat3::Identity());
  }
  add_springs(dt, first);
  add_shell(dt, first);
}

bool BackwardEuler::solve() {
  const WorkClock::Within factorisation(motion_.clock(), WorkPart::factorisation);
  if (!analysed_) factors_.analyse(system_.lower());
  analysed_ = true;
  throw_if_cancelled("backward Euler");
  WorkCounts& work = motion_.work();
  ++work.factorisations;
  if (!factors_.factorise(system_.lower(), 0, &motion_.pool())) return false;
  ++work.linear_solves;
  const WorkClock::Within solve(motion_.clock(), WorkPart::solve);
  Eigen::VectorXd solution = system_.gather(change_);
  factors_.solve(solution, &motion_.pool());
  system_.scatter(solution, change_);
  return true;
}

/// v += share change; returns the largest component of that.
double BackwardEuler::advance(double share, double dt) {
  PackedCloth& cloth = motion_.cloth();
  double most = 0;
  for (std::size_t i = 0; i < cloth.v.size(); ++i) {
    const Vec3 step = share * change_[i];
    Vec4& v = cloth.v[i];
    v = {v.x + step.x(), v.y + step.y(), v.z + step.z(), 0};
    most = std::max(most, step.lpNorm<Eigen::Infinity>());
    cloth.x[i] = {x_[i].x + dt * v.x, x_[i].y + dt * v.y, x_[i].z + dt * v.z, 0};
  }
  return most;
}

/// What backward Euler's v1 minimises, as far as it depends on v [J].
double BackwardEuler::energy(double dt) const {
  const WorkClock::Within elements(motion_.clock(), WorkPart::elements);
  const Motion& motion = motion_;
  const PackedCloth& cloth = motion.cloth();
  const Loads& loads = motion.loads();
  const bool has_shell = !shell_.empty() || !cloth.shell.energies.empty();
  double sum = has_shell ? potential_energy(cloth.shell, positions(cloth)) : 0;
  for (std::size_t i = 0; i < cloth.v.size(); ++i) {
    if (cloth.inv_mass[i] == 0) continue;
    const Vec3 v = vec3(cloth.v[i]), air = motion.wind() ? vec3(air_[i]) : Vec3::Zero();
    const double inertia = (v - vec3(v_[i])).squaredNorm() / 2, drag = (v - air).squaredNorm() / 2;
    sum += (inertia + dt * (loads.air_drag * drag - v.dot(loads.gravity))) / cloth.inv_mass[i];
    sum -= dt * v.dot(vec3(load_[i]));
  }
  for (int i = 0; i < cloth.springs(); ++i) {
    const int a = cloth.a[i], b = cloth.b[i];
    const double l = (vec3(cloth.x[b]) - vec3(cloth.x[a])).norm();
    const double rate = direction_[std::size_t(i)].dot(vec3(cloth.v[b]) - vec3(cloth.v[a]));
    const double tension = cloth.k[i] * l - cloth.kL[i];
    if (cloth.k[i] > 0) sum += tension * tension / (2 * cloth.k[i]);
    sum += dt * dashpots_[std::size_t(i)] * rate * rate / 2;
  }
  return sum;
}

/// Newton's method from where the first iteration led.
void BackwardEuler::improve(double dt) {
  double reached = energy(dt);
  for (int i = 1; i < options_.newton_iterations; ++i) {
    motion_.update_forces(motion_.from());
    assemble(dt, false);
    ++motion_.work().iterations;
    if (!solve()) break;
    double moved = advance(1, dt), now = energy(dt);
    for (int h = 0, share = 1; h < most_halvings && !(now <= reached + rounding * std::abs(reached)); ++h) {
      share *= 2;
      moved = advance(-1.0 / share, dt);
      now = energy(dt);
    }
    reached = now;
    if (moved <= options_.newton_tolerance) break;
  }
}

void BackwardEuler::step(double dt) {
  require("backward Euler", "dt", std::min(dt, 1e300), dt > 0, "> 0");
  try {
    take_step(dt);
  } catch (const Cancelled&) {
    motion_.cloth().x = x_;
    motion_.cloth().v = v_;
    throw;
  }
}

void BackwardEuler::take_step(double dt) {
  PackedCloth& cloth = motion_.cloth();
  x_ = cloth.x;
  v_ = cloth.v;
  if (options_.newton_iterations > 1) {
    load_ = cloth.force;
    motion_.update_compensation(motion_.from());
    load_.swap(cloth.force);
  }
  if (motion_.wind()) air_at(cloth, *motion_.wind(), motion_.to(), air_, motion_.pool());
  find_directions();
  assemble(dt, true);
  ++motion_.work().iterations;
  if (solve()) {
    const double moved = advance(1, dt);
    if (options_.newton_iterations > 1 && moved > options_.newton_tolerance) improve(dt);
  } else {  // numbers beyond all bounds: let the run be seen to have diverged
    advance(std::numeric_limits<double>::quiet_NaN(), dt);
  }
  cloth.x = x_;
  motion_.drift(dt);
  motion_.update_forces();
  ++motion_.work().steps;
}

}  // namespace furrow::physics
