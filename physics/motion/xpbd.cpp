// SPDX-License-Identifier: MIT
#include "physics/motion/xpbd.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/base/lanes.h"
#include "physics/packed/dashpots.h"

namespace furrow::physics {
namespace {

constexpr double least_l2 = 1e-280;  // m^2; shorter springs have no direction

struct Sweep {
  const Vec4* x;
  Vec4* v;
  const int *a, *b;
  const double *k, *kL, *c, *inv_mass, *inv_sum;
  double* impulse;
  double h;
};

FURROW_INLINE Lanes& lanes(Vec4& v) { return *(Lanes*)&v; }
FURROW_INLINE const Lanes& lanes(const Vec4& v) { return *(const Lanes*)&v; }

/// Gives the ends of spring i the impulse p along d.
FURROW_INLINE void push(const Sweep& s, int i, double p, const Lanes& d) {
  Lanes pa, pb;
  spread(p * s.inv_mass[s.a[i]], pa);
  spread(p * s.inv_mass[s.b[i]], pb);
  lanes(s.v[s.a[i]]) -= pa * d;
  lanes(s.v[s.b[i]]) += pb * d;
}

/// Solves spring i with p its impulse so far, w the sum of its ends' inverse masses, C = l - L:
///   dp = -(h k C + p + h c (v_b - v_a) . n) / (1 + h (h k + c) w).
FURROW_INLINE void solve_one(const Sweep& s, int i) {
  const double h = s.h;
  Lanes hh;
  spread(h, hh);
  const Lanes u = lanes(s.v[s.b[i]]) - lanes(s.v[s.a[i]]);
  const Lanes d = (lanes(s.x[s.b[i]]) - lanes(s.x[s.a[i]])) + hh * u, p2 = d * d, du = d * u;
  const double l = std::sqrt(std::max((p2[0] + p2[1]) + p2[2], least_l2)), inv = 1 / l;
  const double dv = (du[0] + du[1]) + du[2], p = s.impulse[i];
  const double dp = -(h * (s.k[i] * l - s.kL[i]) + p + h * (s.c[i] * (dv * inv))) /
                    (1 + h * ((h * s.k[i] + s.c[i]) * s.inv_sum[i]));
  s.impulse[i] = p + dp;
  push(s, i, dp * inv, d);
}

/// Springs of one group share no particle, so four go at once.
FURROW_VECTOR_CLONES
void solve_group(const Sweep* sweep, int begin, int end) {
  const Sweep s = *sweep;
  Lanes hh;
  spread(s.h, hh);
  int i = begin;
  for (; i + 4 <= end; i += 4) {
    Lanes d[4], l2, dv;
    Lanes u[4];
    for (int j = 0; j < 4; ++j) {
      u[j] = lanes(s.v[s.b[i + j]]) - lanes(s.v[s.a[i + j]]);
      d[j] = (lanes(s.x[s.b[i + j]]) - lanes(s.x[s.a[i + j]])) + hh * u[j];
    }
    sum_xyz(d[0] * d[0], d[1] * d[1], d[2] * d[2], d[3] * d[3], l2);
    sum_xyz(d[0] * u[0], d[1] * u[1], d[2] * u[2], d[3] * u[3], dv);
    Lanes root;
    for (int j = 0; j < 4; ++j) root[j] = std::sqrt(std::max(l2[j], least_l2));
    const Lanes one = {1, 1, 1, 1}, inv = one / root, c = at(s.c + i), k = at(s.k + i), w = at(s.inv_sum + i);
    const Lanes p = at(s.impulse + i);
    const Lanes dp =
        -(hh * (k * root - at(s.kL + i)) + p + hh * (c * (dv * inv))) / (one + hh * ((hh * k + c) * w));
    *(UnalignedLanes*)(s.impulse + i) = p + dp;
    const Lanes along = dp * inv;
    for (int j = 0; j < 4; ++j) push(s, i + j, along[j], d[j]);
  }
  for (; i < end; ++i) solve_one(s, i);
}

void solve_groups(const Sweep& sweep, const std::vector<int>& begin, int first, int last, bool forward) {
  for (int n = first; n < last; ++n) {
    const auto g = std::size_t(forward ? n : first + last - 1 - n);
    solve_group(&sweep, begin[g], begin[g + 1]);
  }
}

void require_springs_only(const Cloth& shell) {
  std::size_t elements = 0;
  for_each_kind(shell, [&](const auto& kind, auto...) { elements += kind.size(); });
  if (elements == 0 && shell.energies.empty()) return;
  const std::size_t known = shell.membrane.size() + shell.tension.size() + shell.hinges.size();
  throw std::invalid_argument(
      "xpbd knows springs only: not " + std::to_string(shell.membrane.size()) + " membrane triangles, " +
      std::to_string(shell.tension.size()) + " tensions and " + std::to_string(shell.hinges.size()) +
      " hinges" + (elements > known ? ", nor " + std::to_string(elements - known) + " of other kinds" : "") +
      (shell.energies.empty() ? "" : ", nor " + std::to_string(shell.energies.size()) + " energies") +
      "; choose springs for both, or another integrator");
}

}  // namespace

Xpbd::Xpbd(Motion& motion, const XpbdOptions& options) : motion_(motion), options_(options) {
  if (options.iterations < 1) {
    throw std::invalid_argument("xpbd: iterations = " + std::to_string(options.iterations) + " is not >= 1");
  }
  const PackedCloth& cloth = motion.cloth();
  require_springs_only(cloth.shell);
  dashpots_ = dashpots(cloth, motion.loads().spring_damping);
  dashpots_.resize(cloth.a.size(), 0.0);
  for (std::size_t i = 0; i < cloth.a.size(); ++i)
    inv_mass_.push_back(cloth.inv_mass[cloth.a[i]] + cloth.inv_mass[cloth.b[i]]);
}

/// The springs of blocks at once, what lies between them after (or, in reverse, before) them.
void Xpbd::sweep(double dt, bool forward) {
  const WorkClock::Within solve(motion_.clock(), WorkPart::solve);
  PackedCloth& cloth = motion_.cloth();
  const Sweep sweep{cloth.x.data(),
                    cloth.v.data(),
                    cloth.a.data(),
                    cloth.b.data(),
                    cloth.k.data(),
                    cloth.kL.data(),
                    dashpots_.data(),
                    cloth.inv_mass.data(),
                    inv_mass_.data(),
                    impulse_.data(),
                    dt};
  const std::vector<int>&group = cloth.sweep.group_begin, &block = cloth.sweep.block_begin;
  const auto solve_between = [&] { solve_groups(sweep, group, block.back(), cloth.sweep.groups(), forward); };
  if (!forward) solve_between();
  motion_.pool().run(cloth.sweep.blocks(), [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      solve_groups(sweep, group, block[std::size_t(i)], block[std::size_t(i) + 1], forward);
  });
  if (forward) solve_between();
}

void Xpbd::step(double dt) {
  if (!(dt > 0)) throw std::invalid_argument("xpbd: dt = " + std::to_string(dt) + " is not > 0");
  motion_.update_compensation(motion_.from());
  motion_.drag_and_kick(dt);
  impulse_.assign(dashpots_.size(), 0.0);
  for (int i = 0; i < options_.iterations; ++i) {
    ++motion_.work().iterations;
    sweep(dt, i % 2 == 0);
  }
  motion_.drift(dt);
  ++motion_.work().steps;
}

}  // namespace furrow::physics
