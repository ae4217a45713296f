// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "physics/base/lanes_geometry.h"
#include "physics/cloth/dihedral_lanes.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/packed/packed_elements.h"

namespace furrow::physics {
namespace {

using FourTriangles = PackedElements::FourTriangles;
using FourTensions = PackedElements::FourTensions;
using FourHinges = PackedElements::FourHinges;

/// Twice the tension times the edge: the force on the end it points away from.
FURROW_INLINE Vectors pull(const double (&h)[6][4], int i, const Lanes (&d)[3], const Vectors& edge) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const Lanes t = at(h[i]) * d[i] + at(h[3 + k]) * d[j] + at(h[3 + j]) * d[k];
  return scaled(2 * t, edge);
}

/// d^T H d / 2 of each.
FURROW_INLINE void stretch_energy(const double (&h)[6][4], const Lanes (&d)[3], double* energy) {
  Lanes sum{};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum += d[i] * (at(h[i]) * d[i] + at(h[3 + k]) * d[j] + at(h[3 + j]) * d[k]);
  }
  *(UnalignedLanes*)energy = 0.5 * sum;
}

FURROW_VECTOR_CLONES
void stretch(const FourTriangles* triangles, const Vec4* x, Vec4* slot, double* energy, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const FourTriangles& t = triangles[i];
    const Vectors x0 = gathered(x, t.corner[0]), x1 = gathered(x, t.corner[1]), x2 = gathered(x, t.corner[2]);
    const Vectors e[3] = {x2 - x1, x0 - x2, x1 - x0};
    Lanes d[3];
    for (int k = 0; k < 3; ++k) {
      dot(e[k], e[k], d[k]);
      d[k] -= at(t.length2[k]);
    }
    if (energy) stretch_energy(t.quadratic, d, energy + 4 * i);
    const Vectors f0 = pull(t.quadratic, 0, d, e[0]), f1 = pull(t.quadratic, 1, d, e[1]),
                  f2 = pull(t.quadratic, 2, d, e[2]);
    Vec4* to = slot + 12 * i;
    scattered(f2 - f1, to, 3);
    scattered(f0 - f2, to + 1, 3);
    scattered(f1 - f0, to + 2, 3);
  }
}

/// See tension_forces.h. Where the length is 0 the direction is, too.
FURROW_VECTOR_CLONES
void draw(const FourTensions* tensions, const Vec4* x, Vec4* slot, double* energy, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const FourTensions& t = tensions[i];
    const Vectors d = gathered(x, t.end[1]) - gathered(x, t.end[0]);
    Lanes l2, l;
    dot(d, d, l2);
    const Lanes zero{};
    square_root(l2, l);
    const Lanes e = (l - at(t.rest_length)) / at(t.rest_length);
    const Lanes ce = e > zero ? at(t.stretch) * e : -(at(t.compress) * e);
    if (energy) *(UnalignedLanes*)(energy + 4 * i) = ce * e * e * at(t.rest_length) / 3;
    const Vectors pull = scaled(ce * e / (l > zero ? l : zero + 1), d);
    scattered(pull, slot + 8 * i, 2);
    scattered(scaled(zero - 1, pull), slot + 8 * i + 1, 2);
  }
}

/// The gradients at the edge's ends balance those at the tips.
FURROW_INLINE void end_gradients(const FourBends& b, Vectors& first, Vectors& second) {
  const Lanes zero{}, one = zero + 1;
  first = scaled(b.foot_a - one, b.tip_a) - scaled(b.foot_b, b.tip_b);
  second = scaled(b.foot_b - one, b.tip_b) - scaled(b.foot_a, b.tip_a);
}

FURROW_INLINE void moment_of(const FourHinges& h, bool cosine, const Lanes& angle, Lanes& moment) {
  const Lanes zero{};
  Lanes phi;
  bend_of(angle, at(h.rest_angle), phi);
  moment = at(h.stiffness) * phi;
  if (!cosine) return;
  Lanes s;
  for (int j = 0; j < 4; ++j) s[j] = std::sin(0.5 * phi[j]);
  const Lanes size = 2 * at(h.stiffness) * (s * s);
  moment = phi < zero ? -size : size;
}

FURROW_VECTOR_CLONES
void fold(const FourHinges* hinges, bool cosine, const Vec4* x, Vec4* slot, double* energy, int begin,
          int end) {
  for (int i = begin; i < end; ++i) {
    FourBends b;
    bends_of(hinges[i].vertex, x, b);
    Lanes moment;
    moment_of(hinges[i], cosine, b.angle, moment);
    if (energy)
      for (int j = 0; j < 4; ++j)
        energy[4 * i + j] = hinge_moment(cosine ? HingeLaw::cosine : HingeLaw::linear, hinges[i].stiffness[j],
                                         bend(b.angle[j], hinges[i].rest_angle[j]))
                                .energy;
    Vectors first, second;
    end_gradients(b, first, second);
    scattered(scaled(-moment, first), slot + 16 * i, 4);
    scattered(scaled(-moment, second), slot + 16 * i + 1, 4);
    scattered(scaled(-moment, b.tip_a), slot + 16 * i + 2, 4);
    scattered(scaled(-moment, b.tip_b), slot + 16 * i + 3, 4);
  }
}

FURROW_VECTOR_CLONES
void gather(const int* first, const int* slots, const Vec4* slot, Vec4* force, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    Lanes sum = *(const Lanes*)(force + i);
    for (int s = first[i]; s < first[i + 1]; ++s) sum += *(const Lanes*)(slot + slots[s]);
    *(Lanes*)(force + i) = sum;
  }
}

}  // namespace

namespace {

void add_forces(PackedElements& p, const std::vector<Vec4>& x, std::vector<Vec4>& force, ThreadPool& pool,
                double* energy) {
  const int triangles = int(p.triangles.size()), tensions = int(p.tensions.size()),
            hinges = int(p.hinges.size());
  Vec4* tension_slot = p.slot.data() + 12 * p.triangles.size();
  Vec4* hinge_slot = tension_slot + 8 * p.tensions.size();
  double* drawn = energy ? energy + 4 * p.triangles.size() : nullptr;
  double* folded = energy ? drawn + 4 * p.tensions.size() : nullptr;
  const bool cosine = p.law == HingeLaw::cosine;
  pool.run(triangles, [&](int begin, int end) {
    stretch(p.triangles.data(), x.data(), p.slot.data(), energy, begin, end);
  });
  pool.run(tensions,
           [&](int begin, int end) { draw(p.tensions.data(), x.data(), tension_slot, drawn, begin, end); });
  pool.run(hinges, [&](int begin, int end) {
    fold(p.hinges.data(), cosine, x.data(), hinge_slot, folded, begin, end);
  });
  pool.run(int(force.size()), [&](int begin, int end) {
    gather(p.gather_begin.data(), p.gather.data(), p.slot.data(), force.data(), begin, end);
  });
}

}  // namespace

void add_element_forces(PackedElements& p, const std::vector<Vec4>& x, std::vector<Vec4>& force,
                        ThreadPool& pool) {
  if (!p.slot.empty()) add_forces(p, x, force, pool, nullptr);
}

double add_element_forces_and_energy(PackedElements& p, const std::vector<Vec4>& x, std::vector<Vec4>& force,
                                     ThreadPool& pool) {
  if (p.slot.empty()) return 0;
  p.energy.resize(4 * (p.triangles.size() + p.tensions.size() + p.hinges.size()));
  add_forces(p, x, force, pool, p.energy.data());
  const double* energy = p.energy.data();
  double sum = 0;
  const auto add = [&](int count, std::size_t fours) {
    for (int i = 0; i < count; ++i) sum += energy[i];
    energy += 4 * fours;
  };
  add(p.triangle_count, p.triangles.size());
  add(p.tension_count, p.tensions.size());
  add(p.hinge_count, p.hinges.size());
  return sum;
}

}  // namespace furrow::physics
