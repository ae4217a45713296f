// SPDX-License-Identifier: GPL-3.0-or-later
// What a sampled field of distances costs and how accurate it is: our adaptive one, a uniform grid, OpenVDB.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

#include "bench/accuracy_table.h"
#include "bench/bench_bodies.h"
#include "bench/charts/charts.h"
#include "bench/charts/sampled_field.h"
#include "bench/machine_probes.h"
#include "physics/body/distance_field.h"

namespace furrow::bench {

namespace {

using physics::DistanceField;
using physics::ExactDistance;
using physics::SignedDistance;
using physics::TriangleMesh;
using physics::Vec3;

class AdaptiveField : public SampledField {
 public:
  AdaptiveField(const TriangleMesh& mesh, double tolerance, const Band& band)
      : field_(DistanceField::build(mesh, options(tolerance, band))) {}
  void at_many(std::span<const Vec3> x, std::span<SignedDistance> result) const override {
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = field_.at(x[i]);
  }
  std::size_t memory() const override { return field_.memory(); }

 private:
  static physics::DistanceFieldOptions options(double tolerance, const Band& band) {
    physics::DistanceFieldOptions o;
    o.tolerance = tolerance;
    o.outer_band = band.outer;
    o.inner_band = band.inner;
    o.max_depth = 12;
    return o;
  }
  DistanceField field_;
};

struct Points {
  std::vector<Vec3> random, ordered;  ///< the same ones; ordered: along a Morton curve
  std::vector<double> exact;          ///< distances of `random`
};

std::vector<Vec3> along_morton_curve(std::vector<Vec3> points, const Vec3& low, double size) {
  const auto key = [&](const Vec3& x) {
    std::uint64_t code = 0;
    for (int bit = 9; bit >= 0; --bit) {
      for (int k = 0; k < 3; ++k) code = 2 * code + (int(1024 * (x[k] - low[k]) / size) >> bit & 1);
    }
    return code;
  };
  std::stable_sort(points.begin(), points.end(),
                   [&](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
  return points;
}

/// Points of the band: on a triangle chosen by area, then along its normal.
Points points_of_band(const TriangleMesh& mesh, const Band& band, int count) {
  const ExactDistance exact(mesh);
  std::vector<double> areas;
  const auto normal = [&](const std::array<int, 3>& t) -> Vec3 {
    const auto& x = mesh.vertices;
    return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
  };
  for (const auto& t : mesh.triangles) areas.push_back(normal(t).norm());
  std::discrete_distribution<std::size_t> pick(areas.begin(), areas.end());
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1), away(-band.inner, band.outer);
  Points points;
  while (int(points.random.size()) < count) {
    const auto& t = mesh.triangles[pick(random)];
    double u = unit(random), v = unit(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    points.random.push_back(a + u * (b - a) + v * (c - a) + away(random) * normal(t).normalized());
    points.exact.push_back(exact.at(points.random.back()).value);
  }
  points.ordered =
      along_morton_curve(points.random, exact.low().array() - band.outer, exact.diagonal() + 2 * band.outer);
  return points;
}

/// The shortest time of `count` runs; long ones run less often.
double best_of(int count, const std::function<void()>& run) {
  double best = std::numeric_limits<double>::infinity(), sum = 0;
  for (int i = 0; i < count && sum < 1; ++i) {
    const double start = cpu_seconds();
    run();
    const double seconds = cpu_seconds() - start;
    best = std::min(best, seconds), sum += seconds;
  }
  return best;
}

struct Errors {
  double largest = NAN, p999 = NAN, mean = NAN;
};

/// Over the points within `reach` of the surface.
Errors errors(const Points& points, const std::vector<SignedDistance>& found, double reach) {
  std::vector<double> e;
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::abs(points.exact[i]) > reach) continue;
    e.push_back(std::abs(found[i].value - points.exact[i]));
    sum += e.back();
  }
  std::sort(e.begin(), e.end());
  return {e.back(), e[std::size_t(0.999 * double(e.size() - 1))], sum / double(e.size())};
}

struct Body {
  std::string name;
  TriangleMesh mesh;
  std::vector<double> tolerances;  ///< over the default
  double tolerance() const { return std::min(1e-3 * bounding_diagonal(mesh), 2e-3); }
};

std::vector<Body> bodies(bool quick) {
  // On a ball a tolerance splits either all cells of the band or none.
  std::vector<Body> list{{"ball", geodesic_ball(quick ? 40 : 71, 0.25), {1, 0.25, 0.0625}},
                         {"mannequin", read_obj(FURROW_MESHES "/mannequin.obj"), {4, 2, 1, 0.5, 0.25}}};
  if (!quick) list[1].tolerances.push_back(0.125);
  return list;
}

class Chart {
 public:
  Chart(const std::string& folder, bool quick)
      : table_(
            folder + "/fields.csv",
            "Sampled fields of signed distance, one thread, best of several runs. setting: tolerance "
            "(max_depth 12), else "
            "edge of a cell. Build: from the triangles. Queries: value and gradient of 300,000 points of "
            "the band (30 mm outside, 20 mm inside) in no order, or along a Morton curve; value_*: the "
            "value alone, where that is offered. Errors: against the exact distance of the mesh, in the "
            "band; near_*: within 5 mm of the surface. openvdb_3_voxels knows no band; its near errors are "
            "within 1.2 voxels at most, where all corners of a cell are known.",
            "body,triangles,field,setting[m],build[CPU s],memory[bytes],query_random[ns],query_ordered[ns]"
            ",value_random[ns],value_ordered[ns],max_error[m],p99.9_error[m],mean_error[m],near_max[m],"
            "near_p99.9[m],near_mean[m],default"),
        repeats_(quick ? 3 : 5) {
    for (int i = 0; i < (quick ? 7 : 9); ++i) cells_.push_back(32e-3 * std::pow(0.5, 0.5 * i));
  }

  void measure(const Body& body) {
    points_ = points_of_band(body.mesh, band_, 300'000);
    for (const double share : body.tolerances) {
      const double tolerance = share * body.tolerance();
      row(body, "adaptive", tolerance, near_,
          [&] { return std::make_unique<AdaptiveField>(body.mesh, tolerance, band_); });
    }
    for (const double cell : cells_) {
      row(body, "uniform", cell, near_, [&] { return uniform_grid(body.mesh, cell, band_); });
    }
    for (const double cell : cells_) {
      row(body, "openvdb", cell, near_, [&] { return openvdb_field(body.mesh, cell, &band_); });
    }
    for (const double cell : cells_) {
      row(body, "openvdb_3_voxels", cell, std::min(near_, 1.2 * cell),
          [&] { return openvdb_field(body.mesh, cell, nullptr); });
    }
  }

 private:
  void row(const Body& body, const std::string& name, double setting, double near,
           const std::function<std::unique_ptr<SampledField>()>& build) {
    std::unique_ptr<SampledField> field;
    const double seconds = best_of(repeats_, [&] { field = build(); });
    if (!field) return;
    std::vector<SignedDistance> found(points_.random.size());
    std::vector<double> values(found.size());
    const auto nanoseconds = [&](const auto& run) {
      return 1e9 * best_of(repeats_ + 2, run) / double(found.size());
    };
    double value_random = NAN, value_ordered = NAN;
    if (field->values(points_.random, values)) {
      value_random = nanoseconds([&] { field->values(points_.random, values); });
      value_ordered = nanoseconds([&] { field->values(points_.ordered, values); });
    }
    const double ordered = nanoseconds([&] { field->at_many(points_.ordered, found); });
    const double random = nanoseconds([&] { field->at_many(points_.random, found); });
    const Errors all = name == "openvdb_3_voxels" ? Errors{} : errors(points_, found, INFINITY);
    const Errors at_surface = errors(points_, found, near);
    table_.row(body.name, body.mesh.triangles.size(), name, setting, seconds, field->memory(), random,
               ordered, value_random, value_ordered, all.largest, all.p999, all.mean, at_surface.largest,
               at_surface.p999, at_surface.mean, name == "adaptive" && setting == body.tolerance());
  }

  const double near_ = 0.005;  ///< where cloth lies [m]
  Table table_;
  int repeats_;
  std::vector<double> cells_;  ///< [m]
  Band band_;
  Points points_;
};

}  // namespace

void chart_fields(const std::string& folder, Effort effort) {
  Chart chart(folder, effort == Effort::quick);
  for (const Body& body : bodies(effort == Effort::quick)) chart.measure(body);
}

}  // namespace furrow::bench
