// SPDX-License-Identifier: MIT
#include "physics/packed/packed_stiffness.h"

#include <algorithm>

#include "physics/base/lanes_geometry.h"
#include "physics/cloth/dihedral_lanes.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {
namespace {

constexpr int triangle_numbers = 9 * lower_blocks(3), hinge_numbers = 9 * lower_blocks(4);

/// Four blocks, one a lane, by columns.
struct FourBlocks {
  Lanes entry[9];
};

FURROW_INLINE void add_product(const Vectors& row, const Vectors& column, FourBlocks& sum) {
  const Lanes r[3] = {row.x, row.y, row.z}, c[3] = {column.x, column.y, column.z};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) sum.entry[3 * j + i] += r[i] * c[j];
}

FURROW_INLINE void add_multiple(double factor, bool transposed, const FourBlocks& b, FourBlocks& sum) {
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) sum.entry[3 * j + i] += factor * b.entry[transposed ? 3 * i + j : 3 * j + i];
}

/// The lanes [from, to) of a block go to its place in each element's numbers.
FURROW_INLINE void put(const FourBlocks& b, int block, int numbers, int from, int to, double* first) {
  for (int lane = from; lane < to; ++lane) {
    double* entry = first + (lane - from) * numbers + 9 * block;
    for (int i = 0; i < 9; ++i) entry[i] = b.entry[i][lane];
  }
}

/// The triangles' tensions become those of the positive part (membrane.cpp).
FURROW_INLINE void clamp_tension(Lanes (&t)[3]) {
  const Lanes zero{}, one = zero + 1;
  const double root3 = std::sqrt(3.0);
  const Lanes p = t[0] + t[1] + 4 * t[2], q = root3 * (t[1] - t[0]), r = 3 * (t[0] + t[1]);
  const Lanes mean = 0.5 * (p + r), half = 0.5 * (p - r);
  Lanes apart;
  square_root(half * half + q * q, apart);
  const auto whole = mean >= apart, none = mean <= -apart;
  const Lanes low = mean - apart, share = (mean + apart) / (apart > zero ? 2 * apart : one);
  const Lanes p1 = share * (p - low), q1 = share * q, r1 = share * (r - low);
  const Lanes c[3] = {0.5 * (r1 / 3 - q1 / root3), 0.5 * (r1 / 3 + q1 / root3), 0.25 * (p1 - r1 / 3)};
  for (int i = 0; i < 3; ++i) t[i] = whole ? t[i] : (none ? zero : c[i]);
}

/// dd_j / dx of a corner over 2, d_j of the edge j, where it is one of the edge's ends.
FURROW_INLINE Vectors slope(const Vectors (&edge)[3], int corner, int j) {
  const Lanes zero{};
  return corner == (j + 1) % 3 ? scaled(zero - 1, edge[j]) : edge[j];
}

/// Of the corners of edge i, the lower row first (membrane.cpp).
FURROW_INLINE void pair_block(const Lanes (&quadratic)[3][3], const Vectors (&edge)[3], const Lanes& tension,
                              int i, FourBlocks& block) {
  const Lanes zero{};
  const int row = i == 2 ? 1 : 2, column = i == 0 ? 1 : 0;
  for (Lanes& e : block.entry) e = zero;
  for (int k = 0; k < 3; ++k) {
    if (k == column) continue;
    Vectors half{zero, zero, zero};
    for (int j = 0; j < 3; ++j)
      if (j != row) half = half + scaled(4 * quadratic[j][k], slope(edge, row, j));
    add_product(half, slope(edge, column, k), block);
  }
  for (int d = 0; d < 3; ++d) block.entry[4 * d] -= 2 * tension;
}

FURROW_VECTOR_CLONES
void stretch_blocks(const PackedElements::FourTriangles* triangles, const Vec4* x, int begin, int end,
                    double* out) {
  for (int four = begin / 4; 4 * four < end; ++four) {
    const PackedElements::FourTriangles& t = triangles[four];
    const Vectors x0 = gathered(x, t.corner[0]), x1 = gathered(x, t.corner[1]), x2 = gathered(x, t.corner[2]);
    const Vectors e[3] = {x2 - x1, x0 - x2, x1 - x0};
    const Lanes h[3][3] = {{at(t.quadratic[0]), at(t.quadratic[5]), at(t.quadratic[4])},
                           {at(t.quadratic[5]), at(t.quadratic[1]), at(t.quadratic[3])},
                           {at(t.quadratic[4]), at(t.quadratic[3]), at(t.quadratic[2])}};
    Lanes d[3], tension[3];
    for (int k = 0; k < 3; ++k) {
      dot(e[k], e[k], d[k]);
      d[k] -= at(t.length2[k]);
    }
    for (int k = 0; k < 3; ++k) tension[k] = h[k][0] * d[0] + h[k][1] * d[1] + h[k][2] * d[2];
    clamp_tension(tension);
    FourBlocks pair[3];
    for (int i = 0; i < 3; ++i) pair_block(h, e, tension[i], i, pair[i]);
    FourBlocks diagonal[3] = {};
    add_multiple(-1, true, pair[2], diagonal[0]), add_multiple(-1, true, pair[1], diagonal[0]);
    add_multiple(-1, false, pair[2], diagonal[1]), add_multiple(-1, true, pair[0], diagonal[1]);
    add_multiple(-1, false, pair[1], diagonal[2]), add_multiple(-1, false, pair[0], diagonal[2]);
    const int from = std::max(begin - 4 * four, 0), to = std::min(end - 4 * four, 4);
    double* first = out + std::ptrdiff_t(4 * four + from - begin) * triangle_numbers;
    for (int i = 0; i < 3; ++i) put(diagonal[i], lower_block(i, i), triangle_numbers, from, to, first);
    put(pair[2], lower_block(1, 0), triangle_numbers, from, to, first);
    put(pair[1], lower_block(2, 0), triangle_numbers, from, to, first);
    put(pair[0], lower_block(2, 1), triangle_numbers, from, to, first);
  }
}

FURROW_VECTOR_CLONES
void fold_blocks(const PackedElements::FourHinges* hinges, const Vec4* x, int begin, int end, double* out) {
  const Lanes zero{}, one = zero + 1;
  for (int four = begin / 4; 4 * four < end; ++four) {
    FourBends b;
    bends_of(hinges[four].vertex, x, b);
    const Vectors g[4] = {scaled(b.foot_a - one, b.tip_a) - scaled(b.foot_b, b.tip_b),
                          scaled(b.foot_b - one, b.tip_b) - scaled(b.foot_a, b.tip_a), b.tip_a, b.tip_b};
    const int from = std::max(begin - 4 * four, 0), to = std::min(end - 4 * four, 4);
    double* first = out + std::ptrdiff_t(4 * four + from - begin) * hinge_numbers;
    for (int r = 0; r < 4; ++r) {
      const Vectors row = scaled(at(hinges[four].stiffness), g[r]);
      for (int c = 0; c <= r; ++c) {
        FourBlocks block = {};
        add_product(row, g[c], block);
        put(block, lower_block(r, c), hinge_numbers, from, to, first);
      }
    }
  }
}

}  // namespace

void triangle_blocks(const PackedElements& elements, const Vec4* x, int begin, int end, Mat3* blocks) {
  if (begin < end) stretch_blocks(elements.triangles.data(), x, begin, end, blocks->data());
}

void hinge_blocks(const PackedElements& elements, const Vec4* x, int begin, int end, Mat3* blocks) {
  if (begin < end) fold_blocks(elements.hinges.data(), x, begin, end, blocks->data());
}

}  // namespace furrow::physics
