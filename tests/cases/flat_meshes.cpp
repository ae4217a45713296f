// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/flat_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"

namespace furrow::cases {
namespace {

using physics::Cloth;
using physics::Vec3;
using Triangles = std::vector<std::array<int, 3>>;

/// Uniform in [-1, 1), the same on every machine.
struct Noise {
  std::mt19937_64 random;
  explicit Noise(std::uint64_t seed) : random(seed) {}
  double operator()() { return double(random() >> 11) * 0x1p-52 - 1; }
};

/// Twice the signed area of a triangle of the plane.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double cotangent(const Vec3& apex, const Vec3& a, const Vec3& b) {
  return (a - apex).dot(b - apex) / turn(apex, a, b);
}

/// Flips edges whose opposite angles exceed 180 degrees in sum until there are none (Lawson).
void make_delaunay(const std::vector<Vec3>& x, Triangles& triangles) {
  for (bool flipped = true; std::exchange(flipped, false);) {
    std::map<std::pair<int, int>, int> owner;  // of each directed edge
    for (int t = 0; t < int(triangles.size()); ++t) {
      for (int c = 0; c < 3; ++c) owner[{triangles[t][c], triangles[t][(c + 1) % 3]}] = t;
    }
    std::vector<char> touched(triangles.size(), 0);
    for (const auto& [edge, t] : owner) {
      const auto [a, b] = edge;
      const auto other = owner.find({b, a});
      if (a > b || other == owner.end() || touched[t] || touched[other->second]) continue;
      const auto apex = [&, a = a, b = b](int triangle) {
        for (const int v : triangles[triangle]) {
          if (v != a && v != b) return v;
        }
        return -1;
      };
      const int c = apex(t), d = apex(other->second);
      if (cotangent(x[c], x[a], x[b]) + cotangent(x[d], x[b], x[a]) > -1e-9) continue;
      triangles[t] = {a, d, c};
      triangles[other->second] = {b, c, d};
      touched[t] = touched[other->second] = 1;
      flipped = true;
    }
  }
}

Cloth finished(std::vector<Vec3> x, Triangles triangles, double density) {
  Cloth cloth;
  cloth.particles.v.assign(x.size(), Vec3::Zero());
  cloth.particles.mass.assign(x.size(), 0);
  for (const auto& t : triangles) {
    const double area = turn(x[t[0]], x[t[1]], x[t[2]]) / 2;
    if (!(area > 0)) throw std::logic_error("flat mesh: a triangle is turned over");
    for (const int v : t) cloth.particles.mass[v] += density * area / 3;
  }
  for (const double m : cloth.particles.mass) cloth.particles.inv_mass.push_back(1 / m);
  for (const EdgeApexes& e : edges_of(triangles)) {
    cloth.structural.push_back({e.a, e.b, (x[e.b] - x[e.a]).norm(), 0});
  }
  cloth.particles.x = std::move(x);
  cloth.triangles = std::move(triangles);
  return cloth;
}

void check(bool good, const char* what, double value);

/// Splits the triangle that a point lies in into three; nothing happens where it lies too near a corner.
void insert_point(const Vec3& p, double nearest, std::vector<Vec3>& x, Triangles& triangles) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    if (turn(x[a], x[b], p) <= 0 || turn(x[b], x[c], p) <= 0 || turn(x[c], x[a], p) <= 0) continue;
    for (const int v : {a, b, c})
      if ((x[v] - p).norm() < nearest) return;
    const int i = int(x.size());
    x.push_back(p);
    triangles[t] = {a, b, i};
    triangles.push_back({b, c, i});
    triangles.push_back({c, a, i});
    return;
  }
}

/// The corners of columns x rows rectangles.
std::vector<Vec3> lattice(double width, double height, int columns, int rows) {
  check(columns >= 1, "columns", columns);
  check(rows >= 1, "rows", rows);
  std::vector<Vec3> x;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) x.emplace_back(width * c / columns, height * r / rows, 0);
  return x;
}

/// Their triangles; rising(r, c): whether the diagonal does.
template <class Rising>
Triangles cut_quads(int columns, int rows, const Rising& rising) {
  Triangles triangles;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int a = r * (columns + 1) + c, b = a + 1, d = a + columns + 1, e = d + 1;
      const bool up = rising(r, c);
      triangles.push_back(up ? std::array{a, b, e} : std::array{a, b, d});
      triangles.push_back(up ? std::array{a, e, d} : std::array{b, e, d});
    }
  }
  return triangles;
}

void check(bool good, const char* what, double value) {
  if (!good) throw std::invalid_argument(std::string("flat mesh: ") + what + " = " + std::to_string(value));
}

/// Joins two rows of points by triangles: always by the shorter new edge.
void zip(const std::vector<Vec3>& x, int low, int low_end, int high, int high_end, Triangles& triangles) {
  while (low + 1 < low_end || high + 1 < high_end) {
    const bool may_low = low + 1 < low_end, may_high = high + 1 < high_end;
    const bool on_low =
        may_low && (!may_high || (x[low + 1] - x[high]).norm() < (x[high + 1] - x[low]).norm());
    triangles.push_back({low, on_low ? low + 1 : high + 1, high});
    ++(on_low ? low : high);
  }
}

/// Joins two closed rings of points, both counter-clockwise, the outer one behind the inner one in the array.
void zip_rings(const std::vector<Vec3>& x, int inner, int outer, Triangles& triangles) {
  const int n = outer - inner, m = int(x.size()) - outer;
  int nearest = 0;
  for (int j = 1; j < m; ++j)
    if ((x[outer + j] - x[inner]).norm() < (x[outer + nearest] - x[inner]).norm()) nearest = j;
  for (int i = 0, j = 0; i < n || j < m;) {
    const int a = inner + i % n, next_a = inner + (i + 1) % n;
    const int b = outer + (nearest + j) % m, next_b = outer + (nearest + j + 1) % m;
    const bool on_inner = i < n && (j == m || (x[next_a] - x[b]).norm() < (x[next_b] - x[a]).norm());
    triangles.push_back({a, b, on_inner ? next_a : next_b});
    ++(on_inner ? i : j);
  }
}

}  // namespace

std::vector<EdgeApexes> edges_of(const Triangles& triangles) {
  std::map<std::pair<int, int>, EdgeApexes> edges;
  for (const auto& t : triangles) {
    for (int c = 0; c < 3; ++c) {
      const int a = t[c], b = t[(c + 1) % 3];
      EdgeApexes& e = edges.try_emplace(std::minmax(a, b), EdgeApexes{std::min(a, b), std::max(a, b), -1, -1})
                          .first->second;
      (a < b ? e.left : e.right) = t[(c + 2) % 3];
    }
  }
  std::vector<EdgeApexes> result;
  for (const auto& [key, e] : edges) result.push_back(e);
  return result;
}

int equilateral_rows(double width, double height, int columns) {
  check(width > 0 && height > 0 && columns >= 1, "width * height * columns", width * height * columns);
  return std::max(1, int(std::lround(height / (std::sqrt(0.75) * width / columns))));
}

Cloth triangular_sheet(double width, double height, int columns, int rows, double density, double jitter,
                       std::uint64_t seed) {
  check(columns >= 1, "columns", columns);
  check(rows >= 1, "rows", rows);
  check(jitter >= 0 && jitter <= 0.3, "jitter", jitter);
  Noise unit(seed);
  const double h = width / columns;
  std::vector<Vec3> x, even;  // with and without jitter
  std::vector<int> start;
  for (int r = 0; r <= rows; ++r) {
    start.push_back(int(x.size()));
    const int inner = r % 2 ? columns : columns - 1;
    for (int c = 0; c < inner + 2; ++c) {
      double u = r % 2 ? (c - 0.5) * h : c * h, v = height * r / rows;
      u = c == 0 ? 0 : c == inner + 1 ? width : u;
      even.emplace_back(u, v, 0);
      if (c > 0 && c <= inner && r > 0 && r < rows) u += jitter * h * unit(), v += jitter * h * unit();
      x.emplace_back(u, v, 0);
    }
  }
  start.push_back(int(x.size()));
  Triangles triangles;
  for (int r = 0; r < rows; ++r) zip(even, start[r], start[r + 1], start[r + 1], start[r + 2], triangles);
  make_delaunay(x, triangles);
  return finished(std::move(x), std::move(triangles), density);
}

Cloth hexagon(double half_diagonal, int rings, double density, double jitter, std::uint64_t seed) {
  check(rings >= 1, "rings", rings);
  check(jitter >= 0 && jitter <= 0.3, "jitter", jitter);
  Noise unit(seed);
  const double h = half_diagonal / rings;
  std::vector<Vec3> x, even;
  std::vector<int> start;
  for (int r = -rings; r <= rings; ++r) {
    start.push_back(int(x.size()));
    const int edges = 2 * rings - std::abs(r);
    for (int c = 0; c <= edges; ++c) {
      const bool border = std::abs(r) == rings || c == 0 || c == edges;
      even.emplace_back((c - 0.5 * edges) * h, r * h * std::sqrt(0.75), 0);
      x.push_back(even.back());
      if (!border) x.back() += jitter * h * Vec3(unit(), unit(), 0);
    }
  }
  start.push_back(int(x.size()));
  Triangles triangles;
  for (int r = 0; r < 2 * rings; ++r)
    zip(even, start[r], start[r + 1], start[r + 1], start[r + 2], triangles);
  make_delaunay(x, triangles);
  return finished(std::move(x), std::move(triangles), density);
}

Cloth disc(double radius, int rings, double density) {
  check(radius > 0, "radius", radius);
  check(rings >= 1, "rings", rings);
  std::vector<Vec3> x{Vec3::Zero()};
  Triangles triangles;
  int inner = 0;
  for (int k = 1; k <= rings; ++k) {
    const int n = int(std::lround(2 * std::numbers::pi * k)), outer = int(x.size());
    const double turned = std::fmod(k * std::numbers::phi, 1);  // of the distance between two of a ring
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * (i + turned) / n;
      x.push_back(radius * k / rings * Vec3(std::cos(angle), std::sin(angle), 0));
    }
    if (k > 1) zip_rings(x, inner, outer, triangles);
    for (int i = 0; k == 1 && i < n; ++i) triangles.push_back({0, outer + i, outer + (i + 1) % n});
    inner = outer;
  }
  return finished(std::move(x), std::move(triangles), density);
}

Cloth right_sheet(double width, double height, int columns, int rows, double density, bool alternating) {
  check(columns >= 1, "columns", columns);
  check(rows >= 1, "rows", rows);
  std::vector<Vec3> x;
  Triangles triangles;
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) x.emplace_back(width * c / columns, height * r / rows, 0);
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int a = r * (columns + 1) + c, b = a + 1, d = a + columns + 1, e = d + 1;
      const bool other = alternating && (r + c) % 2;
      triangles.push_back(other ? std::array{a, b, d} : std::array{a, b, e});
      triangles.push_back(other ? std::array{b, e, d} : std::array{a, e, d});
    }
  }
  return finished(std::move(x), std::move(triangles), density);
}

Cloth row_sheet(double width, double height, int columns, int rows, double density) {
  std::vector<Vec3> x = lattice(width, height, columns, rows);
  return finished(std::move(x), cut_quads(columns, rows, [](int r, int) { return r % 2 == 0; }), density);
}

Cloth jittered_right_sheet(double width, double height, int columns, int rows, double density,
                           std::uint64_t seed) {
  std::vector<Vec3> x = lattice(width, height, columns, rows);
  const Triangles triangles = cut_quads(columns, rows, [](int, int) { return true; });
  const double dx = width / columns, dy = height / rows;
  Noise unit(seed);
  for (int r = 1; r < rows; ++r) {
    for (int c = 1; c < columns; ++c) {
      const int i = r * (columns + 1) + c;
      const Vec3 before = x[i];
      x[i] += 0.3 * Vec3(dx * unit(), dy * unit(), 0);
      for (const auto& t : triangles)
        if ((t[0] == i || t[1] == i || t[2] == i) && turn(x[t[0]], x[t[1]], x[t[2]]) < 0.1 * dx * dy)
          x[i] = before;
    }
  }
  return finished(std::move(x), triangles, density);
}

Cloth blue_noise_sheet(double width, double height, int columns, int rows, double density,
                       std::uint64_t seed) {
  check(columns >= 2, "columns", columns);
  check(rows >= 2, "rows", rows);
  std::vector<Vec3> x;
  for (int c = 0; c < columns; ++c) x.emplace_back(width * c / columns, 0, 0);
  for (int r = 0; r < rows; ++r) x.emplace_back(width, height * r / rows, 0);
  for (int c = 0; c < columns; ++c) x.emplace_back(width - width * c / columns, height, 0);
  for (int r = 0; r < rows; ++r) x.emplace_back(0, height - height * r / rows, 0);
  const int border = int(x.size());
  x.emplace_back(0.5 * width, 0.5 * height, 0);
  Triangles triangles;
  for (int i = 0; i < border; ++i) triangles.push_back({i, (i + 1) % border, border});
  Noise unit(seed);
  const double apart = 0.75 * std::sqrt(width / columns * height / rows), edge = 0.5 * apart;
  for (int tries = 0; tries < 60 * columns * rows; ++tries) {
    const Vec3 p(0.5 * width * (1 + unit()), 0.5 * height * (1 + unit()), 0);
    if (p.x() < edge || p.x() > width - edge || p.y() < edge || p.y() > height - edge) continue;
    bool far = true;
    for (const Vec3& q : x) far = far && (p - q).norm() > apart;
    if (far) insert_point(p, 0, x, triangles);
  }
  make_delaunay(x, triangles);
  return finished(std::move(x), std::move(triangles), density);
}

Cloth lined_sheet(double width, double height, int columns, int rows, double density) {
  std::vector<Vec3> x = lattice(width, height, columns, rows);
  Triangles triangles = cut_quads(columns, rows, [](int, int) { return true; });
  const double h = std::min(width / columns, height / rows);
  const Vec3 middle(0.5 * width, 0.5 * height, 0), along(std::cos(0.37), std::sin(0.37), 0);
  for (double s = -0.35 * std::min(width, height); s < 0.35 * std::min(width, height); s += 0.2 * h)
    insert_point(middle + s * along + 0.031 * h * Vec3(1, 2, 0), 0.05 * h, x, triangles);
  make_delaunay(x, triangles);
  return finished(std::move(x), std::move(triangles), density);
}

const char* name_of(SheetKind kind) {
  constexpr const char* names[] = {"one diagonal", "by row",           "union jack", "equilateral",
                                   "jittered",     "cut and jittered", "blue noise", "inserted line"};
  return names[int(kind)];
}

Cloth sheet_of(SheetKind kind, double width, double height, int columns, double density) {
  const int rows = std::max(1, int(std::lround(height / width * columns)));
  switch (kind) {
    case SheetKind::one_diagonal:
      return right_sheet(width, height, columns, rows, density);
    case SheetKind::by_row:
      return row_sheet(width, height, columns, rows, density);
    case SheetKind::union_jack:
      return right_sheet(width, height, columns, rows, density, true);
    case SheetKind::equilateral:
      return triangular_sheet(width, height, columns, equilateral_rows(width, height, columns), density);
    case SheetKind::jittered:
      return triangular_sheet(width, height, columns, equilateral_rows(width, height, columns), density, 0.3);
    case SheetKind::cut_jittered:
      return jittered_right_sheet(width, height, columns, rows, density);
    case SheetKind::blue_noise:
      return blue_noise_sheet(width, height, columns, rows, density);
    case SheetKind::lined:
      return lined_sheet(width, height, columns, rows, density);
  }
  throw std::invalid_argument("flat mesh: no such kind");
}

void add_flat_membrane(Cloth& cloth, double young_times_thickness, double poisson) {
  const physics::PlaneLame lame = physics::plane_stress(young_times_thickness, poisson);
  const auto& x = cloth.particles.x;
  for (const auto& t : cloth.triangles) {
    physics::MembraneTriangle m{t, {}, lame.lambda, lame.mu};
    for (int i = 0; i < 3; ++i) m.rest_lengths[i] = (x[t[(i + 2) % 3]] - x[t[(i + 1) % 3]]).norm();
    cloth.membrane.push_back(m);
  }
}

void add_flat_hinges(Cloth& cloth, double rigidity, const std::vector<char>& at_clamp) {
  const auto& x = cloth.particles.x;
  for (const EdgeApexes& e : edges_of(cloth.triangles)) {
    if (e.left < 0 || e.right < 0) continue;
    const double a1 = turn(x[e.a], x[e.b], x[e.left]) / 2, a2 = turn(x[e.b], x[e.a], x[e.right]) / 2;
    const double factor = !at_clamp.empty() && at_clamp[e.a] && at_clamp[e.b] ? 2 : 1;
    const double k = physics::hinge_stiffness(rigidity, (x[e.b] - x[e.a]).norm(), a1, a2, factor);
    cloth.hinges.push_back({{e.a, e.b, e.left, e.right}, 0, k});
  }
}

}  // namespace furrow::cases
