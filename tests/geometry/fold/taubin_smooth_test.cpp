// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/taubin_smooth.h"

#include <rapidcheck.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "geometry/fold/smoothing_rows.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/two_ring.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;
using std::numbers::pi;

namespace {

const std::vector<Vertex> whole_mesh_options;

double distance(const Point& p, const Point& q) { return std::sqrt(CGAL::squared_distance(p, q)); }
double max_distance(const Mesh& a, const Mesh& b) {
  double most = 0;
  for (Vertex v : a.vertices()) most = std::max(most, distance(a.point(v), b.point(v)));
  return most;
}
template <class Map>
Mesh mapped(Mesh mesh, const Map& map) {
  for (Vertex v : mesh.vertices()) mesh.point(v) = map(mesh.point(v));
  return mesh;
}
Mesh bumpy_sheet() {
  Mesh mesh = jittered(12, 12, 0.3, 5);
  lift(mesh, [](double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y) + 0.05 * x * y; });
  return mesh;
}
TaubinOptions cotangent() {
  TaubinOptions options;
  options.weights = SmoothingWeights::cotangent;
  return options;
}
/// Largest and smallest real part of the spectrum of K = I - W over the moving vertices.
std::pair<double, double> spectrum(const Mesh& mesh, const TaubinOptions& options) {
  const SmoothingRows rows = gather_smoothing_rows(mesh, whole_mesh_options, options);
  const auto n = static_cast<Eigen::Index>(rows.vertices.size());
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t r = 0; r < rows.active.size(); ++r) {
    k(rows.active[r], rows.active[r]) = 1;
    for (int j = rows.first[r]; j < rows.first[r + 1]; ++j)
      k(rows.active[r], rows.neighbour[static_cast<std::size_t>(j)]) -=
          rows.weight[static_cast<std::size_t>(j)];
  }
  const Eigen::VectorXd real = k.eigenvalues().real();
  return {real.minCoeff(), real.maxCoeff()};
}

}  // namespace

TEST_CASE("taubin_smooth: a wave on the six-valent torus is multiplied by f(k)^N") {
  const int n = 24, m = 18, wave_u = GENERATE(0, 1, 5, 12), wave_v = GENERATE(1, 4, 9),
            pairs = GENERATE(1, 10, 50);
  const auto [lambda, mu] = GENERATE(table<double, double>({{0.33, -0.34}, {0.6307, -0.6732}}));
  Mesh mesh = torus_lattice(n, m);
  const auto wave = [&](Vertex v) {
    const int i = static_cast<int>(v.idx()) % n, j = static_cast<int>(v.idx()) / n;
    return std::cos(2 * pi * (static_cast<double>(wave_u) * i / n + static_cast<double>(wave_v) * j / m));
  };
  for (Vertex v : mesh.vertices()) mesh.point(v) = {wave(v), -2 * wave(v), 5};
  const double a = 2 * pi * wave_u / n, b = 2 * pi * wave_v / m;
  const double k = 1 - (std::cos(a) + std::cos(b) + std::cos(a + b)) / 3;
  const double gain = std::pow((1 - lambda * k) * (1 - mu * k), pairs);
  taubin_smooth(mesh, whole_mesh_options, {.iterations = pairs, .lambda = lambda, .mu = mu});
  double error = 0;
  for (Vertex v : mesh.vertices())
    error = std::max(error, distance(mesh.point(v), {gain * wave(v), -2 * gain * wave(v), 5}));
  CHECK(error < 1e-12);
}

TEST_CASE("taubin_smooth: smoothing and an affine map may change places (uniform weights)") {
  CHECK(rc::check("affine equivariance", [] {
    const auto entry = rc::gen::map(rc::gen::inRange(-2000, 2001), [](int i) { return i * 1e-3; });
    const auto a = *rc::gen::container<std::vector<double>>(12, entry);
    const auto affine = [&](const Point& p) {
      return Point(a[0] * p.x() + a[1] * p.y() + a[2] * p.z() + a[9],
                   a[3] * p.x() + a[4] * p.y() + a[5] * p.z() + a[10],
                   a[6] * p.x() + a[7] * p.y() + a[8] * p.z() + a[11]);
    };
    static const Mesh sheet = bumpy_sheet();
    Mesh smoothed = sheet, mapped_first = mapped(sheet, affine);
    taubin_smooth(smoothed, whole_mesh_options);
    taubin_smooth(mapped_first, whole_mesh_options);
    RC_ASSERT(max_distance(mapped(smoothed, affine), mapped_first) < 1e-12);
  }));
}

TEST_CASE("taubin_smooth: rigid motions change places with cotangent smoothing, affine maps do not") {
  const Mesh sheet = bumpy_sheet();
  const auto turn = [](const Point& p) {
    return Point(0.36 * p.x() + 0.48 * p.y() - 0.8 * p.z() + 0.7, -0.8 * p.x() + 0.6 * p.y() - 2,
                 0.48 * p.x() + 0.64 * p.y() + 0.6 * p.z() + 0.1);
  };
  const auto stretch = [](const Point& p) { return Point(3 * p.x(), p.y(), p.z()); };
  const auto gap = [&](const auto& map) {
    Mesh smoothed = sheet, mapped_first = mapped(sheet, map);
    taubin_smooth(smoothed, whole_mesh_options, cotangent());
    taubin_smooth(mapped_first, whole_mesh_options, cotangent());
    return max_distance(mapped(smoothed, map), mapped_first);
  };
  CHECK(gap(turn) < 1e-12);
  CHECK(gap(stretch) > 1e-4);
}

TEST_CASE("taubin_smooth: it keeps a plane, and with cotangents every vertex inside it") {
  const Mesh flat = mapped(jittered(20, 20, 0.2, 3), [](const Point& p) {
    return Point(0.6 * p.x(), p.y(), 0.8 * p.x());  // isometric to the sheet of size 1
  });
  for (auto weights : {SmoothingWeights::uniform, SmoothingWeights::cotangent})
    for (auto border : {BorderRule::free, BorderRule::keep}) {
      Mesh mesh = flat;
      taubin_smooth(mesh, whole_mesh_options, {.iterations = 50, .weights = weights, .border = border});
      double out = 0, along = 0;
      for (Vertex v : mesh.vertices()) {
        out = std::max(out, std::abs(0.8 * mesh.point(v).x() - 0.6 * mesh.point(v).z()));
        if (!mesh.is_border(v)) along = std::max(along, distance(mesh.point(v), flat.point(v)));
      }
      CHECK(out < 1e-12);
      CHECK(along > 1e-3);  // borders contract: this is the whole mesh
    }
  // Only vertices well inside are smoothed here: cotangents reproduce linear functions exactly.
  std::vector<Vertex> inner;
  for (Vertex v : flat.vertices())
    if (!flat.is_border(v)) inner.push_back(v);
  Mesh mesh = flat;
  taubin_smooth(mesh, inner, {.iterations = 50, .weights = SmoothingWeights::cotangent});
  CHECK(max_distance(mesh, flat) < 1e-12);
}

TEST_CASE("taubin_smooth: vertices outside the region keep their bits, constants too") {
  Mesh mesh = bumpy_sheet();
  const Mesh before = mesh;
  const std::vector<Vertex> seeds = {Vertex(40), Vertex(90)};
  const std::vector<Vertex> region = two_ring(mesh, seeds);
  const SmoothReport report = taubin_smooth(mesh, region);
  CHECK(report.smoothed_vertices == region.size());
  CHECK(report.kept_vertices == 0);
  for (Vertex v : mesh.vertices()) {
    const bool inside = std::binary_search(region.begin(), region.end(), v);
    CHECK((mesh.point(v) == before.point(v)) != inside);
  }
  Mesh constant = mapped(before, [](const Point&) { return Point(0.1, -7, 1e-3); });
  taubin_smooth(constant, whole_mesh_options);
  for (Vertex v : constant.vertices()) CHECK(distance(constant.point(v), {0.1, -7, 1e-3}) < 1e-14);
}

TEST_CASE("taubin_smooth: it does not depend on the order of the vertices") {
  const Mesh mesh = bumpy_sheet();
  std::vector<int> order(mesh.number_of_vertices());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::mt19937 engine(1);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[engine() % i]);
  std::vector<Point> points(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    points[static_cast<std::size_t>(order[i])] = mesh.point(Vertex(static_cast<Vertex::size_type>(i)));
  std::vector<std::array<int, 3>> faces;
  for (Face f : mesh.faces()) {
    std::array<int, 3> corners;
    std::size_t i = 0;
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) corners[i++] = order[v.idx()];
    faces.push_back(corners);
  }
  std::reverse(faces.begin(), faces.end());
  for (const TaubinOptions& options : {TaubinOptions{}, cotangent()}) {
    Mesh plain = mesh, permuted = mesh_of(points, faces);
    taubin_smooth(plain, whole_mesh_options, options);
    taubin_smooth(permuted, whole_mesh_options, options);
    for (Vertex v : plain.vertices())
      CHECK(distance(plain.point(v), permuted.point(Vertex(static_cast<Vertex::size_type>(order[v.idx()])))) <
            1e-13);
  }
}

TEST_CASE("taubin_smooth: lines that are kept smooth among themselves, their ends stay") {
  Mesh mesh = equilateral_sheet(1, 1, 0.1);
  auto line = ensure_map(mesh, attribute::line);
  std::vector<Vertex> ridge;
  for (Vertex v : mesh.vertices())
    if (std::abs(mesh.point(v).y() - 0.5) < 0.01 && std::abs(mesh.point(v).x()) < 0.31) ridge.push_back(v);
  REQUIRE(ridge.size() == 7);
  for (Vertex v : ridge) {
    line[v] = 2;
    mesh.point(v) = mesh.point(v) + Vector(0, 0, 0.02);
  }
  const Vertex lone(5);
  line[lone] = 1;
  const Mesh before = mesh;
  const std::vector<Vertex> region = two_ring(mesh, ridge);
  Mesh kept = mesh;
  const SmoothReport report = taubin_smooth(kept, region, {.lines = LineRule::keep});
  CHECK(report.kept_vertices == 2);
  for (Vertex v : ridge)
    CHECK(kept.point(v).z() == Approx(0.02).epsilon(1e-12));  // a straight even line is a fixed point
  CHECK(kept.point(ridge.front()) == before.point(ridge.front()));
  CHECK(kept.point(ridge.back()) == before.point(ridge.back()));
  taubin_smooth(mesh, region);
  CHECK(mesh.point(ridge[3]).z() < 0.019);
  Mesh whole = before;
  CHECK(taubin_smooth(whole, whole_mesh_options, {.lines = LineRule::keep}).kept_vertices == 3);
  CHECK(whole.point(lone) == before.point(lone));
}

TEST_CASE("taubin_smooth: a kept border smooths as a curve, a free one with its inside") {
  Mesh mesh = cylinder(0.3, 1, 24, 10);
  for (Vertex v : mesh.vertices())
    if (!mesh.is_border(v)) mesh.point(v) = mesh.point(v) + Vector(0, 0, 0.1);
  Mesh kept = mesh, free = mesh;
  taubin_smooth(kept, whole_mesh_options, {.border = BorderRule::keep});
  taubin_smooth(free, whole_mesh_options);
  const double k = 1 - std::cos(2 * pi / 24);  // a circle of 24 points is a wave of its own
  const double gain = std::pow((1 - 0.33 * k) * (1 + 0.34 * k), 10);
  for (Vertex v : kept.vertices()) {
    if (!kept.is_border(v)) continue;
    const Point p = mesh.point(v);
    CHECK(distance(kept.point(v), {gain * p.x(), p.y(), gain * p.z()}) < 1e-12);
    CHECK(free.point(v).z() > p.z() + 0.005);
  }
  auto line = ensure_map(mesh, attribute::line);
  line[Vertex(0)] = line[Vertex(24)] = line[Vertex(48)] = 0;  // a line up from the border: its corner stays
  CHECK(taubin_smooth(mesh, whole_mesh_options, {.lines = LineRule::keep, .border = BorderRule::keep})
            .kept_vertices == 2);
}

TEST_CASE(
    "taubin_smooth: the spectrum that it relies on ends at 2 for uniform weights and at 3 for cotangents",
    "[long]") {
  CHECK(rc::check("spectrum", [] {
    const auto seed = *rc::gen::inRange(0u, 100000u);
    const double squash = *rc::gen::element(1., 3., 20., 300.);
    Mesh mesh = jittered(4, 4, 0.49, seed, 1, 1 / squash);
    auto line = ensure_map(mesh, attribute::line);
    for (Vertex v : mesh.vertices()) line[v] = *rc::gen::element(-1, -1, -1, 0);
    TaubinOptions options;
    options.lines = *rc::gen::element(LineRule::free, LineRule::keep);
    options.border = *rc::gen::element(BorderRule::free, BorderRule::keep);
    for (auto [weights, bound] :
         {std::pair(SmoothingWeights::uniform, 2.), std::pair(SmoothingWeights::cotangent, 3.)}) {
      options.weights = weights;
      const auto [lowest, highest] = spectrum(mesh, options);
      RC_ASSERT(lowest > -1e-7);
      RC_ASSERT(highest < bound + 1e-7);
    }
  }));
}

TEST_CASE("taubin_smooth: it bears degenerate faces, lone vertices and a mesh without faces") {
  Mesh mesh = grid(3, 3);
  mesh.point(Vertex(5)) = mesh.point(Vertex(6));
  mesh.point(Vertex(9)) = mesh.point(Vertex(10));
  const Vertex lone = mesh.add_vertex(Point(9, 9, 9));
  for (const TaubinOptions& options : {TaubinOptions{}, cotangent()}) {
    Mesh smoothed = mesh;
    CHECK(taubin_smooth(smoothed, whole_mesh_options, options).kept_vertices == 1);
    for (Vertex v : smoothed.vertices()) CHECK(std::isfinite(smoothed.point(v).x()));
    CHECK(smoothed.point(lone) == mesh.point(lone));
  }
  Mesh empty;
  CHECK(taubin_smooth(empty, whole_mesh_options).smoothed_vertices == 0);
}

TEST_CASE("stability_limit: it and the reported gain are right for the usual pairs") {
  CHECK(stability_limit(0.33, -0.34) == Approx(4.27).margin(0.005));
  CHECK(stability_limit(0.6307, -0.6732) == Approx(2.22).margin(0.005));
  CHECK(stability_limit(0.5, -0.53) == Approx(2.80).margin(0.005));
  const double k = stability_limit(0.7, -0.75);  // defined by f(k) = -1
  CHECK((1 - 0.7 * k) * (1 + 0.75 * k) == Approx(-1).epsilon(1e-14));
  Mesh mesh = grid(2, 2);
  CHECK(taubin_smooth(mesh, whole_mesh_options, {.iterations = 50}).pass_band_gain ==
        Approx(1.011).margin(0.0005));
}

TEST_CASE("taubin_smooth: it refuses what is unstable or out of range, the mesh untouched") {
  Mesh mesh = bumpy_sheet();
  const Mesh before = mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<TaubinOptions> bad = {
      {.iterations = -1},
      {.iterations = 1000000},
      {.lambda = 0},
      {.lambda = nan},
      {.mu = nan},
      {.mu = -0.33},
      {.mu = 0.1},
      {.lambda = 0.8, .mu = -0.85},
      {.lambda = 2, .mu = -2.1},
      {.lambda = 0.6307, .mu = -0.6732, .weights = SmoothingWeights::cotangent}};
  for (const TaubinOptions& options : bad)
    CHECK_THROWS_AS(taubin_smooth(mesh, whole_mesh_options, options), std::invalid_argument);
  CHECK_THROWS_WITH(taubin_smooth(mesh, whole_mesh_options, bad.back()),
                    Catch::Contains("0.6307") && Catch::Contains("k_stab"));
  CHECK_THROWS_AS(taubin_smooth(mesh, std::vector{Vertex(9999)}), std::invalid_argument);
  CHECK(max_distance(mesh, before) == 0);
  CHECK_NOTHROW(taubin_smooth(mesh, whole_mesh_options, {.lambda = 0.6307, .mu = -0.6732}));
  mesh.point(Vertex(3)) = {nan, 0, 0};
  CHECK_THROWS_AS(taubin_smooth(mesh, whole_mesh_options), ContentError);
}
