// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry/insert/insertion_meshes.h"

#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <numbers>

#include "geometry/insert/connect_line.h"
#include "geometry/rest/rest_state.h"

namespace furrow::tests {

using namespace geometry;

namespace {

/// SplitMix64: the same numbers everywhere.
struct Random {
  std::uint64_t state;
  double operator()() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double within(double low, double high) { return low + (high - low) * (*this)(); }
};

using Diagonal = std::function<bool(int, int)>;  // true: from the lower left to the upper right

Mesh grid(int columns, int rows, const std::function<Point(int, int)>& place, const Diagonal& rising) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) mesh.add_vertex(place(i, j));
  }
  const auto at = [&](int i, int j) { return Vertex(static_cast<std::uint32_t>(j * (columns + 1) + i)); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vertex a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (rising(i, j)) {
        mesh.add_face(a, b, c), mesh.add_face(a, c, d);
      } else {
        mesh.add_face(a, b, d), mesh.add_face(b, c, d);
      }
    }
  }
  return mesh;
}

Mesh wrapped(int around, int rows, bool wrap_rows, const std::function<Point(int, int)>& place) {
  Mesh mesh;
  const int lines = wrap_rows ? rows : rows + 1;
  for (int j = 0; j < lines; ++j) {
    for (int i = 0; i < around; ++i) mesh.add_vertex(place(i, j));
  }
  const auto at = [&](int i, int j) {
    return Vertex(static_cast<std::uint32_t>((j % lines) * around + i % around));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < around; ++i) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

void jitter_inner(Mesh& mesh, double distance, std::uint64_t seed) {
  Random random{seed};
  for (Vertex v : mesh.vertices()) {
    const Vector move(random.within(-distance, distance), random.within(-distance, distance), 0);
    if (!mesh.is_border(v)) mesh.point(v) = mesh.point(v) + move;
  }
}

}  // namespace

Mesh regular_sheet(int columns, double jitter, std::uint64_t seed) {
  const double edge = 1.0 / columns, height = edge * std::numbers::sqrt3 / 2;
  const int rows = static_cast<int>(std::lround(1 / height));
  Mesh mesh = grid(
      columns, rows, [&](int i, int j) { return Point(edge * (i + (j % 2) * 0.5), height * j, 0); },
      [](int, int j) { return j % 2 != 0; });
  jitter_inner(mesh, jitter * edge, seed);
  return mesh;
}

Mesh union_jack_sheet(int columns) {
  const double edge = 1.0 / columns;
  return grid(
      columns, columns, [&](int i, int j) { return Point(edge * i, edge * j, 0); },
      [](int i, int j) { return (i + j) % 2 == 0; });
}

Mesh cylinder(int around) {
  const double edge = 1.0 / around, radius = 0.5 / std::numbers::pi;
  const int rows = static_cast<int>(std::lround(1 / (edge * std::numbers::sqrt3 / 2)));
  return wrapped(around, rows, false, [&](int i, int j) {
    // Rows lean by half an edge each, so that the triangles are nearly equilateral.
    const double angle = 2 * std::numbers::pi * (i - 0.5 * j) * edge;
    return Point(radius * std::sin(angle), static_cast<double>(j) / rows, radius * std::cos(angle));
  });
}

Mesh torus(int around, int across) {
  return wrapped(around, across, true, [&](int i, int j) {
    const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
    return Point((1 + 0.4 * std::cos(v)) * std::cos(u), (1 + 0.4 * std::cos(v)) * std::sin(u),
                 0.4 * std::sin(v));
  });
}

Mesh icosahedron() {
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  return mesh;
}

Mesh random_sheet(std::uint64_t seed, double least_angle_deg) {
  Random random{seed};
  const int columns = 5 + static_cast<int>(random() * 5), rows = 5 + static_cast<int>(random() * 5);
  const double wave = random.within(0, 0.15), phase = random.within(0, 6);
  double jitter = random.within(0, 0.45);
  const std::uint64_t diagonals = seed ^ 0x5bd1e995;
  while (true) {
    Random moves{seed + 17}, sides{diagonals};
    std::vector<bool> rising;
    for (int k = 0; k < columns * rows; ++k) rising.push_back(sides() < 0.5);
    Mesh mesh = grid(
        columns, rows,
        [&](int i, int j) {
          const double x = (i + moves.within(-jitter, jitter)) / columns,
                       y = (j + moves.within(-jitter, jitter)) / rows;
          return Point(x, y, wave * std::sin(4 * x + phase) * std::cos(3 * y));
        },
        [&](int i, int j) { return rising[static_cast<std::size_t>(j * columns + i)]; });
    if (audit_rest_metric(mesh).min_angle_deg >= least_angle_deg) return mesh;
    jitter *= 0.8;
  }
}

std::vector<MeshCase> mesh_zoo() {
  const auto flat = [](double s, double t) { return Point(s, t, 0); };
  const double radius = 0.5 / std::numbers::pi;
  const auto round = [radius](double s, double t) {
    const double angle = 2 * std::numbers::pi * s;
    return Point(radius * std::sin(angle), t, radius * std::cos(angle));
  };
  std::vector<MeshCase> zoo;
  zoo.push_back({"regular", regular_sheet(20), flat});
  zoo.push_back({"union-jack", union_jack_sheet(20), flat});
  zoo.push_back({"jittered", regular_sheet(20, 0.25, 3), flat});
  zoo.push_back({"irregular", irregular_sheet(20), flat});
  zoo.push_back({"cylinder", cylinder(20), round, false, true});
  return zoo;
}

Vertex nearest_vertex(const Mesh& mesh, const Point& p) {
  Vertex best = *mesh.vertices().begin();
  for (Vertex v : mesh.vertices()) {
    if (CGAL::squared_distance(mesh.point(v), p) < CGAL::squared_distance(mesh.point(best), p)) best = v;
  }
  return best;
}

Stroke stroke_through(const MeshCase& on, const std::vector<std::array<double, 2>>& square_points) {
  Stroke stroke;
  for (const auto& [s, t] : square_points) stroke.points.push_back(on.place(s, t));
  return stroke;
}

namespace {

std::vector<std::array<double, 2>> sampled(double s0, double t0, double s1, double t1, int pieces,
                                           double bend = 0) {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i <= pieces; ++i) {
    const double u = static_cast<double>(i) / pieces, aside = bend * std::sin(2 * std::numbers::pi * u);
    points.push_back({s0 + u * (s1 - s0) - aside * (t1 - t0), t0 + u * (t1 - t0) + aside * (s1 - s0)});
  }
  return points;
}

Stroke through_vertices(const MeshCase& on) {
  Stroke stroke;
  for (const auto& [s, t] : sampled(0.2, 0.25, 0.75, 0.8, 8)) {
    stroke.points.push_back(on.mesh.point(nearest_vertex(on.mesh, on.place(s, t))));
  }
  return stroke;
}

Stroke along_edges(const MeshCase& on) {
  Mesh mesh = on.mesh;
  const auto rest = ensure_rest_lengths(mesh);
  const Vertex from = nearest_vertex(mesh, on.place(0.2, 0.3)), to = nearest_vertex(mesh, on.place(0.8, 0.6));
  Stroke stroke;
  stroke.points.push_back(mesh.point(from));
  for (Vertex v : shortest_edge_path(mesh, rest, from, to)) stroke.points.push_back(mesh.point(v));
  stroke.points.push_back(mesh.point(to));
  return stroke;
}

Stroke loop(const MeshCase& on) {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < 40; ++i) {
    const double u = i / 40.0, angle = 2 * std::numbers::pi * u;
    if (on.ring) {
      points.push_back({u, 0.5 + 0.03 * std::sin(angle)});
    } else {
      points.push_back({0.5 + 0.22 * std::cos(angle), 0.5 + 0.22 * std::sin(angle)});
    }
  }
  Stroke stroke = stroke_through(on, points);
  stroke.closed = true;
  return stroke;
}

}  // namespace

std::vector<StrokeCase> strokes_for(const MeshCase& on) {
  const Stroke straight = stroke_through(on, sampled(0.21, 0.23, 0.78, 0.71, on.ring ? 40 : 1));
  const Stroke curved = stroke_through(on, sampled(0.2, 0.3, 0.8, 0.55, 60, 0.2));
  // The border lies at t = 0 and t = 1 on every mesh.
  const Stroke out = stroke_through(on, sampled(0.4, 0.6, 0.55, 1.04, 30));
  const Stroke through = stroke_through(on, sampled(0.6, -0.04, 0.45, 1.04, 50));
  const Stroke other = stroke_through(on, sampled(0.25, 0.75, 0.7, 0.24, on.ring ? 40 : 12));
  const Stroke third = stroke_through(on, sampled(0.5, 0.2, 0.51, 0.8, 25));
  return {{"straight", {straight}},
          {"curved", {curved}},
          {"through vertices", {through_vertices(on)}},
          {"along edges", {along_edges(on)}},
          {"across the border", {out, through}},
          {"crossing", {straight, other, third}},
          {"three times", {curved, curved, curved}},
          {"closed loop", {loop(on)}}};
}

}  // namespace furrow::tests
