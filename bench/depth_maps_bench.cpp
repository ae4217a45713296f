// SPDX-License-Identifier: GPL-3.0-or-later
// depth_maps_bench [-o TABLE.csv] [--loop N] [--write FOLDER]: the distance field and depth maps as colliders
// of the mannequin (after N rounds of Loop subdivision), with its arms out and with them before its belly.
// One thread, CPU time, the best of 5; gnuplot bench/depth_maps.gp  draws the table. --write: the two bodies
// as OBJ files, to look at.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/bench_bodies.h"
#include "bench/machine_probes.h"
#include "physics/body/compare_colliders.h"
#include "physics/body/depth_map_collider.h"
#include "physics/body/distance_field.h"
#include "tests/cases/posed_body.h"

namespace furrow::bench {
namespace {

using namespace furrow::physics;

struct Row {
  std::string pose, collider;
  int triangles;
  double build_ms, rebuild_ms, query_ns, megabytes;
  ColliderComparison c;
};

template <class Work>
double best_seconds(const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 5; ++run) {
    const double start = cpu_seconds();
    work();
    best = std::min(best, cpu_seconds() - start);
  }
  return best;
}

/// Points beside the surface, from 1 cm inside to 2 cm outside, in the order of the triangles: neighbours
/// follow each other, as the vertices of a cloth do.
std::vector<Vec3> near_points(const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  const int a_triangle = int(200'000 / mesh.triangles.size()) + 1;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &x = mesh.vertices[std::size_t(a)], u = mesh.vertices[std::size_t(b)] - x,
               v = mesh.vertices[std::size_t(c)] - x, n = u.cross(v).normalized();
    for (int k = 0; k < a_triangle; ++k)
      points.push_back(x + (u + v) / 3 + (-0.01 + 0.03 * (k + 0.5) / a_triangle) * n);
  }
  return points;
}

double query_nanoseconds(const Collider& collider, const std::vector<Vec3>& points) {
  double sum = 0;
  const double seconds = best_seconds([&] {
    for (const Vec3& x : points) sum += collider.at(x).value;
  });
  if (!(std::abs(sum) < 1e9)) throw std::runtime_error("a query gave no number");
  return 1e9 * seconds / double(points.size());
}

Row measure_field(const TriangleMesh& mesh, const ExactDistance& exact, const std::vector<Vec3>& points) {
  std::unique_ptr<DistanceField> field;
  const double seconds =
      best_seconds([&] { field = std::make_unique<DistanceField>(DistanceField::build(mesh)); });
  return {"",
          "distance field",
          int(mesh.triangles.size()),
          1e3 * seconds,
          1e3 * seconds,
          query_nanoseconds(*field, points),
          1e-6 * double(field->memory()),
          compare_colliders(*field, exact, mesh)};
}

Row measure_maps(const TriangleMesh& mesh, const ExactDistance& exact, const std::vector<Vec3>& points,
                 const DepthMapOptions& options, const std::string& name) {
  std::unique_ptr<DepthMapCollider> maps;
  const double build = best_seconds([&] { maps = std::make_unique<DepthMapCollider>(mesh, options); });
  const double rebuild = best_seconds([&] { maps->rebuild(mesh.vertices); });
  return {"",
          name,
          int(mesh.triangles.size()),
          1e3 * build,
          1e3 * rebuild,
          query_nanoseconds(*maps, points),
          1e-6 * double(maps->memory()),
          compare_colliders(*maps, exact, mesh)};
}

std::vector<Row> measure(const std::string& pose, const TriangleMesh& mesh) {
  const ExactDistance exact(mesh);
  const std::vector<Vec3> points = near_points(mesh);
  std::vector<Row> rows = {measure_field(mesh, exact, points)};
  for (const auto& [maps, count] :
       {std::pair{DepthMaps::front_back, "2"}, {DepthMaps::front_back_top, "3"}, {DepthMaps::six, "6"}})
    for (const int size : {512, 1024}) {
      DepthMapOptions options;
      options.maps = maps;
      options.size = size;
      rows.push_back(measure_maps(mesh, exact, points, options,
                                  std::string(count) + " maps of " + std::to_string(size)));
    }
  for (Row& row : rows) row.pose = pose;
  return rows;
}

void print(const std::vector<Row>& rows) {
  std::printf("%-14s %-15s %9s %9s %6s %6s  %-14s %-22s %s\n", "pose", "collider", "build ms", "rebuild",
              "ns", "MB", "wrong in/out %", "depth error mm 50/95/99", "value error mm 50/95/99");
  for (const Row& r : rows)
    std::printf("%-14s %-15s %9.1f %9.1f %6.0f %6.1f  %6.2f %6.2f  %6.2f %6.2f %6.2f   %6.2f %6.2f %6.2f%s\n",
                r.pose.c_str(), r.collider.c_str(), r.build_ms, r.rebuild_ms, r.query_ns, r.megabytes,
                100 * r.c.false_inside_share(), 100 * r.c.false_outside_share(), 1e3 * r.c.push_out.median,
                1e3 * r.c.push_out.p95, 1e3 * r.c.push_out.p99, 1e3 * r.c.near.median, 1e3 * r.c.near.p95,
                1e3 * r.c.near.p99, r.c.disagrees() ? "  disagrees" : "");
}

void write_csv(const std::string& path, const std::vector<Row>& rows) {
  std::ofstream out(path);
  out << "pose,collider,triangles,build_ms,rebuild_ms,query_ns,megabytes,false_inside_percent,"
         "false_outside_percent,depth_error_median_mm,depth_error_p95_mm,depth_error_p99_mm,"
         "value_error_median_mm,value_error_p95_mm,value_error_p99_mm,overestimate_p99_mm,angle_median_deg,"
         "disagrees\n"
      << std::setprecision(4);
  for (const Row& r : rows)
    out << r.pose << ',' << r.collider << ',' << r.triangles << ',' << r.build_ms << ',' << r.rebuild_ms
        << ',' << r.query_ns << ',' << r.megabytes << ',' << 100 * r.c.false_inside_share() << ','
        << 100 * r.c.false_outside_share() << ',' << 1e3 * r.c.push_out.median << ','
        << 1e3 * r.c.push_out.p95 << ',' << 1e3 * r.c.push_out.p99 << ',' << 1e3 * r.c.near.median << ','
        << 1e3 * r.c.near.p95 << ',' << 1e3 * r.c.near.p99 << ',' << 1e3 * r.c.overestimate.p99 << ','
        << r.c.angle.median * 57.29577951308232 << ',' << r.c.disagrees() << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

void write_obj(const std::string& path, const TriangleMesh& mesh) {
  std::ofstream out(path);
  out << std::setprecision(9);
  for (const Vec3& x : mesh.vertices) out << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  for (const auto& [a, b, c] : mesh.triangles) out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

void run(int argc, char** argv) {
  std::string table, folder;
  int rounds = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (i + 1 == argc) throw std::runtime_error(word + ": unknown, or a value is missing");
    if (word == "-o")
      table = argv[++i];
    else if (word == "--loop")
      rounds = std::atoi(argv[++i]);
    else if (word == "--write")
      folder = argv[++i];
    else
      throw std::runtime_error(word + ": unknown");
  }
  TriangleMesh figure = read_obj(FURROW_MESHES "/mannequin.obj");
  for (int round = 0; round < rounds; ++round) figure = loop_once(figure);
  const cases::ArmPose out = cases::a_pose(40);
  const TriangleMesh a_pose = cases::posed(figure, cases::mannequin_arm(), out, out),
                     in_front = cases::arms_in_front(figure);
  if (!folder.empty()) {
    write_obj(folder + "/a_pose.obj", a_pose);
    write_obj(folder + "/arms_in_front.obj", in_front);
  }
  std::vector<Row> rows = measure("A", a_pose);
  for (Row& row : measure("arms in front", in_front)) rows.push_back(std::move(row));
  print(rows);
  if (!table.empty()) write_csv(table, rows);
}

}  // namespace
}  // namespace furrow::bench

int main(int argc, char** argv) try { furrow::bench::run(argc, argv); } catch (const std::exception& e) {
  std::cerr << "depth_maps_bench: " << e.what() << '\n';
  return 1;
}
