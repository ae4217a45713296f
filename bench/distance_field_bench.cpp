// SPDX-License-Identifier: GPL-3.0-or-later
// distance_field_bench [BODY.obj …] [--relative T] [--loop] [--threads N] : one JSON line a body, CPU seconds
// of this thread. Without a body: the noisy sphere of 100,820 triangles. T: tolerance over the diagonal,
// default 1e-3.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <random>
#include <string>

#include "bench/bench_bodies.h"
#include "bench/cpu_seconds.h"
#include "physics/body/distance_field.h"

namespace {

using furrow::bench::cpu_seconds;
using furrow::physics::DistanceField;
using furrow::physics::ExactDistance;
using furrow::physics::TriangleMesh;
using furrow::physics::Vec3;

/// Points within `reach` of the surface, evenly over the triangles.
std::vector<Vec3> band_points(const TriangleMesh& mesh, int count, double reach) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < count) {
    const auto& [ia, ib, ic] = mesh.triangles[random() % mesh.triangles.size()];
    const Vec3 &a = mesh.vertices[ia], &b = mesh.vertices[ib], &c = mesh.vertices[ic];
    double u = unit(random), v = unit(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    Vec3 offset;
    do
      for (int k = 0; k < 3; ++k) offset[k] = 2 * unit(random) - 1;
    while (offset.squaredNorm() > 1);
    points.push_back(a + u * (b - a) + v * (c - a) + reach * offset);
  }
  return points;
}

/// Along a Morton curve, as the vertices of a well-ordered cloth are.
void sort_spatially(std::vector<Vec3>& points, const Vec3& low, double size) {
  const auto key = [&](const Vec3& x) {
    std::uint64_t code = 0;
    for (int bit = 9; bit >= 0; --bit)
      for (int k = 0; k < 3; ++k)
        code = 2 * code + (static_cast<int>(1024 * (x[k] - low[k]) / size) >> bit & 1);
    return code;
  };
  std::stable_sort(points.begin(), points.end(),
                   [&](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
}

double query_nanoseconds(const furrow::physics::Collider& field, const std::vector<Vec3>& points) {
  std::vector<double> runs;
  double sum = 0;
  for (int r = 0; r < 7; ++r) {
    const double start = cpu_seconds();
    for (const Vec3& x : points) {
      const auto d = field.at(x);
      sum += d.value + d.gradient[0] + d.gradient[1] + d.gradient[2];
    }
    runs.push_back(1e9 * (cpu_seconds() - start) / static_cast<double>(points.size()));
  }
  if (!std::isfinite(sum)) std::cerr << "a query gave no number\n";
  std::sort(runs.begin(), runs.end());
  return runs[3];
}

/// "NAME_max", p99.9, p99 and mean of numbers, as JSON.
std::string spread(const std::string& name, std::vector<double> e) {
  std::sort(e.begin(), e.end());
  const auto at = [&](double q) { return std::to_string(e[static_cast<std::size_t>(q * (e.size() - 1))]); };
  return ", \"" + name + "_max\": " + at(1) + ", \"" + name + "_p999\": " + at(0.999) + ", \"" + name +
         "_p99\": " + at(0.99) + ", \"" + name + "_mean\": " +
         std::to_string(std::accumulate(e.begin(), e.end(), 0.0) / static_cast<double>(e.size()));
}

void measure(const std::string& name, const TriangleMesh& mesh, double relative, int threads) {
  std::vector<double> exact_s, field_s;
  furrow::physics::DistanceFieldOptions options;
  options.threads = threads;
  const ExactDistance exact(mesh);
  options.tolerance = relative * exact.diagonal();
  for (int r = 0; r < 3; ++r) {
    const double start = cpu_seconds();
    const ExactDistance timed(mesh);
    const double between = cpu_seconds();
    const DistanceField field = DistanceField::build(timed, options);
    exact_s.push_back(between - start);
    field_s.push_back(cpu_seconds() - between);
  }
  std::sort(exact_s.begin(), exact_s.end());
  std::sort(field_s.begin(), field_s.end());
  const DistanceField field = DistanceField::build(exact, options);
  std::vector<Vec3> points = band_points(mesh, 1'000'000, options.inner_band);
  const double random_ns = query_nanoseconds(field, points);
  std::vector<double> in_tolerance, in_allow;
  double jump = 0;
  for (std::size_t i = 0; i < 50'000; ++i) {
    const double d = exact.at(points[i]).value, error = std::abs(field.at(points[i]).value - d);
    in_tolerance.push_back(error / field.report().tolerance);
    in_allow.push_back(error / field.allowed_error(d));
    Vec3 x =
        points[i];  // onto the nearest plane of the finest lattice: both sides of any face between leaves
    const double unit = field.size() / 1024;
    x[i % 3] = field.low()[i % 3] + unit * std::round((x[i % 3] - field.low()[i % 3]) / unit);
    Vec3 y = x;
    x[i % 3] -= 1e-12, y[i % 3] += 1e-12;
    jump = std::max(jump, std::abs(field.at(x).value - field.at(y).value));
  }
  sort_spatially(points, field.low(), field.size());
  const double ordered_ns = query_nanoseconds(field, points);
  const auto& report = field.report();
  std::cout << "{\"body\": \"" << name << "\", \"triangles\": " << mesh.triangles.size()
            << ", \"sign_rule\": " << static_cast<int>(report.sign.rule)
            << ", \"tolerance\": " << report.tolerance << ", \"threads\": " << threads
            << ", \"exact_build_cpu_s\": " << exact_s[1] << ", \"field_build_cpu_s\": " << field_s[1]
            << ", \"total_build_cpu_s\": " << exact_s[1] + field_s[1] << ", \"leaves\": " << report.leaves
            << ", \"samples\": " << report.samples << ", \"depth\": " << report.depth
            << ", \"megabytes\": " << 1e-6 * static_cast<double>(field.memory())
            << ", \"ns_random\": " << random_ns << ", \"ns_ordered\": " << ordered_ns
            << spread("error_in_tolerance", in_tolerance) << spread("error_in_allow", in_allow)
            << ", \"jump_over_diagonal\": " << jump / exact.diagonal() << "}" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> bodies;
  double relative = 1e-3;
  bool loop = false;
  int threads = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--relative" && i + 1 < argc)
      relative = std::atof(argv[++i]);
    else if (word == "--threads" && i + 1 < argc)
      threads = std::atoi(argv[++i]);
    else if (word == "--loop")
      loop = true;
    else
      bodies.push_back(word);
  }
  if (bodies.empty()) measure("noisy sphere", furrow::bench::noisy_sphere(71), relative, threads);
  for (const std::string& path : bodies) {
    const TriangleMesh mesh = furrow::bench::read_obj(path);
    measure(path, loop ? furrow::bench::loop_once(mesh) : mesh, relative, threads);
  }
}
