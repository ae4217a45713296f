// SPDX-License-Identifier: GPL-3.0-or-later
// What smoothing takes away with the noise: Laplace and Taubin's filter, uniform and cotangent weights.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "bench/accuracy_table.h"
#include "bench/bench_bodies.h"
#include "bench/charts/charts.h"
#include "bench/machine_probes.h"
#include "geometry/fold/smoothing_rows.h"
#include "geometry/mesh/measures.h"
#include "geometry/rest/rest_metric.h"
#include "physics/body/exact_distance.h"

namespace furrow::bench {
namespace {

using geometry::Mesh;
using geometry::SmoothingWeights;
using geometry::Vertex;
using physics::TriangleMesh;
using physics::Vec3;

Vec3 place(const Mesh& mesh, Vertex v) {
  const geometry::Point& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

/// A body, the same body with noise along its normals, and the distance of a point from the surface without
/// noise.
struct Body {
  std::string name;
  TriangleMesh clean;
  std::vector<Vec3> normals;
  Mesh noisy, noisy_with_rest;  ///< rest lengths: those without noise
  double edge, volume;
  std::function<double(const Vec3&)> distance;
};

Mesh half_edges(const TriangleMesh& soup) {
  Mesh mesh;
  for (const Vec3& x : soup.vertices) mesh.add_vertex({x[0], x[1], x[2]});
  for (const auto& [a, b, c] : soup.triangles) mesh.add_face(Vertex(a), Vertex(b), Vertex(c));
  return mesh;
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const auto& x = mesh.vertices;
    const Vec3 n = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    for (int v : t) normals[v] += n;
  }
  for (Vec3& n : normals) n.normalize();
  return normals;
}

Body with_noise(const std::string& name, const TriangleMesh& clean, double noise) {
  Body body{name, clean, vertex_normals(clean), half_edges(clean), half_edges(clean), 0, 0, {}};
  geometry::ensure_rest_lengths(body.noisy_with_rest);
  const geometry::MeshInfo info = geometry::measure(body.noisy);
  body.edge = info.mean_edge_length, body.volume = *info.volume;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> height(-noise * body.edge, noise * body.edge);
  for (Vertex v : body.noisy.vertices()) {
    const Vec3 x = clean.vertices[v.idx()] + height(random) * body.normals[v.idx()];
    body.noisy.point(v) = body.noisy_with_rest.point(v) = {x[0], x[1], x[2]};
  }
  return body;
}

/// A ball whose triangles are twice as long in one direction as in the other near the equator, twice as large
/// at the poles.
TriangleMesh uneven_ball() {
  TriangleMesh mesh = geodesic_ball(40, 1);
  for (Vec3& x : mesh.vertices) x = 0.25 * Vec3(x[0], x[1], 0.5 * x[2]).normalized();
  return mesh;
}

std::vector<Body> bodies() {
  std::vector<Body> list{with_noise("ball", uneven_ball(), 0.3),
                         with_noise("mannequin", read_obj(FURROW_MESHES "/mannequin.obj"), 0.3)};
  list[0].distance = [](const Vec3& x) { return x.norm() - 0.25; };
  list[1].distance = [exact = physics::ExactDistance(list[1].clean)](const Vec3& x) {
    return exact.at(x).value;
  };
  return list;
}

struct Weights {
  const char* name;
  SmoothingWeights kind;
  bool of_rest_lengths;
};
constexpr Weights all_weights[] = {{"uniform", SmoothingWeights::uniform, false},
                                   {"cotangent", SmoothingWeights::cotangent, false},
                                   {"cotangent_of_rest", SmoothingWeights::cotangent, true}};

struct Filter {
  const char* name;
  double lambda, mu;  ///< mu 0: Laplace
};
constexpr Filter filters[] = {{"laplace", 0.33, 0}, {"taubin", 0.33, -0.34}, {"strong_taubin", 0.63, -0.67}};

/// x += lambda (W x - x), `passes` times, as taubin_smooth does its steps.
template <bool is_uniform>
void laplace_smooth(Mesh& mesh, int passes, double lambda) {
  geometry::TaubinOptions options;
  options.weights = is_uniform ? SmoothingWeights::uniform : SmoothingWeights::cotangent;
  const geometry::SmoothingRows rows = geometry::gather_smoothing_rows(mesh, {}, options);
  std::vector<Eigen::Array4d> x, y;
  for (Vertex v : rows.vertices) x.emplace_back(place(mesh, v)[0], place(mesh, v)[1], place(mesh, v)[2], 0);
  y = x;
  for (int n = 0; n < passes; ++n, x.swap(y)) {
    for (std::size_t r = 0; r < rows.active.size(); ++r) {
      Eigen::Array4d mean = Eigen::Array4d::Zero();
      for (int j = rows.first[r]; j < rows.first[r + 1]; ++j) {
        const Eigen::Array4d& next = x[rows.neighbour[j]];
        mean += is_uniform ? next : Eigen::Array4d(rows.weight[j] * next);
      }
      if (is_uniform) mean *= rows.inverse_count[r];
      const int i = rows.active[r];
      y[i] = x[i] + lambda * (mean - x[i]);
    }
  }
  for (int i : rows.active) mesh.point(rows.vertices[i]) = {x[i][0], x[i][1], x[i][2]};
}

void smooth(Mesh& mesh, const Filter& filter, SmoothingWeights weights, int passes) {
  if (filter.mu == 0) {
    return weights == SmoothingWeights::uniform ? laplace_smooth<true>(mesh, passes, filter.lambda)
                                                : laplace_smooth<false>(mesh, passes, filter.lambda);
  }
  geometry::TaubinOptions options;
  options.iterations = passes / 2, options.lambda = filter.lambda, options.mu = filter.mu;
  options.weights = weights;
  geometry::taubin_smooth(mesh, {}, options);
}

struct Score {
  double noise, drift, volume;  ///< RMS distance [m], RMS way along the surface [m], change [-]
};

Score score(const Body& body, const Mesh& mesh) {
  double noise = 0, drift = 0;
  for (Vertex v : mesh.vertices()) {
    const Vec3 way = place(mesh, v) - body.clean.vertices[v.idx()], &n = body.normals[v.idx()];
    const double d = body.distance(place(mesh, v));
    noise += d * d, drift += (way - n.dot(way) * n).squaredNorm();
  }
  const double count = double(mesh.number_of_vertices());
  return {std::sqrt(noise / count), std::sqrt(drift / count),
          *geometry::measure(mesh).volume / body.volume - 1};
}

void chart(const Body& body, int repeats, Table& table) {
  const double start = score(body, body.noisy).noise;
  for (const Weights& weights : all_weights) {
    const Mesh& from = weights.of_rest_lengths ? body.noisy_with_rest : body.noisy;
    for (const Filter& filter : filters) {
      // Beyond 0.33 the waves that cotangents see are not bounded.
      if (weights.kind == SmoothingWeights::cotangent && filter.lambda > 0.33) continue;
      for (const int passes : {2, 4, 10, 20, 40, 100, 200, 400, 1000}) {
        double seconds = std::numeric_limits<double>::infinity();
        Mesh mesh;
        for (int i = 0; i < repeats; ++i) {
          mesh = from;
          const double begin = cpu_seconds();
          smooth(mesh, filter, weights.kind, passes);
          seconds = std::min(seconds, cpu_seconds() - begin);
        }
        const Score s = score(body, mesh);
        table.row(body.name, weights.name, filter.name, passes, seconds, 100 * s.noise / start,
                  100 * s.volume, 100 * s.drift / body.edge);
      }
    }
  }
}

}  // namespace

void chart_smoothing(const std::string& folder, Effort effort) {
  Table table(
      folder + "/smoothing.csv",
      "Noise of +-0.3 mean edges along the normals, smoothed. noise_left: RMS distance of the vertices"
      " from the surface without noise, over that before. volume: against that without noise. drift: "
      "RMS way along the surface from where the vertex was, over the mean edge. CPU seconds of one "
      "thread, the shortest of several runs. cotangent: of the noisy lengths; cotangent_of_rest: of "
      "those without noise. laplace, taubin: lambda 0.33, mu -0.34; strong_taubin: 0.63, -0.67.",
      "body,weights,filter,passes,time[CPU s],noise_left[%],volume[%],drift[%]");
  for (const Body& body : bodies()) chart(body, effort == Effort::quick ? 3 : 9, table);
}

}  // namespace furrow::bench
