// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/base/lanes_geometry.h"
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

FURROW_VECTOR_CLONES
void stretch(const FourTriangles* triangles, const Vec4* x, Vec4* slot, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const FourTriangles& t = triangles[i];
    const Vectors x0 = gathered(x, t.corner[0]), x1 = gathered(x, t.corner[1]), x2 = gathered(x, t.corner[2]);
    const Vectors e[3] = {x2 - x1, x0 - x2, x1 - x0};
    Lanes d[3];
    for (int k = 0; k < 3; ++k) {
      dot(e[k], e[k], d[k]);
      d[k] -= at(t.length2[k]);
    }
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
void draw(const FourTensions* tensions, const Vec4* x, Vec4* slot, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const FourTensions& t = tensions[i];
    const Vectors d = gathered(x, t.end[1]) - gathered(x, t.end[0]);
    Lanes l2, l;
    dot(d, d, l2);
    const Lanes zero{};
    square_root(l2, l);
    const Lanes e = (l - at(t.rest_length)) / at(t.rest_length);
    const Lanes ce = e > zero ? at(t.stretch) * e : -(at(t.compress) * e);
    const Vectors pull = scaled(ce * e / (l > zero ? l : zero + 1), d);
    scattered(pull, slot + 8 * i, 2);
    scattered(scaled(zero - 1, pull), slot + 8 * i + 1, 2);
  }
}

struct Bend {
  Vectors gradient[4];
  Lanes angle;
};

/// See dihedral.cpp: the same formulas.
FURROW_INLINE void bend_of(const FourHinges& h, const Vec4* x, Bend& b) {
  const Vectors x0 = gathered(x, h.vertex[0]), x1 = gathered(x, h.vertex[1]);
  const Vectors e = x1 - x0, f = gathered(x, h.vertex[2]) - x0, g = gathered(x, h.vertex[3]) - x1;
  const Vectors na = cross(e, f), nb = cross(g, e);
  Lanes l2, a2, b2, fe, ge, l, sine, cosine;
  dot(e, e, l2), dot(na, na, a2), dot(nb, nb, b2), dot(f, e, fe), dot(g, e, ge);
  square_root(l2, l);
  dot(cross(na, nb), e, sine), dot(na, nb, cosine);
  const Lanes zero{}, one = zero + 1;
  const auto exists = (l2 * a2 > zero + 1e-280) & (l2 * b2 > zero + 1e-280);
  const Lanes inv = one / (exists ? l2 : one), foot_a = fe * inv, foot_b = -(ge * inv);
  const Vectors tip_a = scaled(exists ? -l / (exists ? a2 : one) : zero, na),
                tip_b = scaled(exists ? -l / (exists ? b2 : one) : zero, nb);
  arc_tangent(exists ? sine * (l * inv) : zero, exists ? cosine : zero, b.angle);
  b.gradient[0] = scaled(foot_a - one, tip_a) - scaled(foot_b, tip_b);
  b.gradient[1] = scaled(foot_b - one, tip_b) - scaled(foot_a, tip_a);
  b.gradient[2] = tip_a, b.gradient[3] = tip_b;
}

FURROW_INLINE void moment_of(const FourHinges& h, bool cosine, const Lanes& angle, Lanes& moment) {
  constexpr double pi = std::numbers::pi;
  const Lanes zero{}, raw = angle - at(h.rest_angle);
  const Lanes phi = raw > zero + pi ? raw - 2 * pi : (raw <= zero - pi ? raw + 2 * pi : raw);
  moment = at(h.stiffness) * phi;
  if (!cosine) return;
  Lanes s;
  for (int j = 0; j < 4; ++j) s[j] = std::sin(0.5 * phi[j]);
  const Lanes size = 2 * at(h.stiffness) * (s * s);
  moment = phi < zero ? -size : size;
}

FURROW_VECTOR_CLONES
void fold(const FourHinges* hinges, bool cosine, const Vec4* x, Vec4* slot, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    Bend b;
    bend_of(hinges[i], x, b);
    Lanes moment;
    moment_of(hinges[i], cosine, b.angle, moment);
    for (int k = 0; k < 4; ++k) scattered(scaled(-moment, b.gradient[k]), slot + 16 * i + k, 4);
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

void add_element_forces(PackedElements& p, const std::vector<Vec4>& x, std::vector<Vec4>& force,
                        ThreadPool& pool) {
  if (p.slot.empty()) return;
  const int triangles = int(p.triangles.size()), tensions = int(p.tensions.size()),
            hinges = int(p.hinges.size());
  Vec4* tension_slot = p.slot.data() + 12 * p.triangles.size();
  Vec4* hinge_slot = tension_slot + 8 * p.tensions.size();
  const bool cosine = p.law == HingeLaw::cosine;
  pool.run(triangles,
           [&](int begin, int end) { stretch(p.triangles.data(), x.data(), p.slot.data(), begin, end); });
  pool.run(tensions,
           [&](int begin, int end) { draw(p.tensions.data(), x.data(), tension_slot, begin, end); });
  pool.run(hinges,
           [&](int begin, int end) { fold(p.hinges.data(), cosine, x.data(), hinge_slot, begin, end); });
  pool.run(int(force.size()), [&](int begin, int end) {
    gather(p.gather_begin.data(), p.gather.data(), p.slot.data(), force.data(), begin, end);
  });
}

}  // namespace furrow::physics
