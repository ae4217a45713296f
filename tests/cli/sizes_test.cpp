// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of one garment: what a user is told of their ease is what they were cut to.
#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/mesh.h"
#include "io/mesh/mesh_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

json report_of_run(const std::string& arguments) {
  const Run run = run_furrow(arguments + " --json");
  INFO(arguments << "\n" << run.err);
  REQUIRE(run.exit_code == 0);
  return json::parse(run.out);
}

/// Whether a face that keeps a corner would turn by more than 60 degrees if the corner of h's target moved.
bool turns(const geometry::Mesh& mesh, geometry::Halfedge h, const geometry::Point& to) {
  const geometry::Vertex other = mesh.source(h), v = mesh.target(h);
  for (const geometry::Halfedge around : mesh.halfedges_around_target(h)) {
    if (mesh.is_border(around)) continue;
    const geometry::Vertex a = mesh.source(around), b = mesh.target(mesh.next(around));
    if (a == other || b == other) continue;
    const auto before = CGAL::cross_product(mesh.point(v) - mesh.point(a), mesh.point(b) - mesh.point(a)),
               after = CGAL::cross_product(to - mesh.point(a), mesh.point(b) - mesh.point(a));
    if (!(before * after > 0.5 * std::sqrt(before.squared_length() * after.squared_length()))) return true;
  }
  return false;
}

/// The mesh with edges shorter than `least` collapsed, where that leaves its borders and its shape.
geometry::Mesh coarser(geometry::Mesh mesh, double least) {
  for (bool any = true; any;) {
    any = false;
    const std::vector<geometry::Edge> edges(mesh.edges().begin(), mesh.edges().end());
    for (const geometry::Edge e : edges) {
      if (mesh.is_removed(e)) continue;
      const geometry::Halfedge h = mesh.halfedge(e);
      const geometry::Vertex a = mesh.source(h), b = mesh.target(h);
      if (CGAL::squared_distance(mesh.point(a), mesh.point(b)) >= least * least) continue;
      const bool a_ends = mesh.is_border(a), b_ends = mesh.is_border(b);
      if (a_ends && b_ends && !mesh.is_border(e)) continue;
      const geometry::Point to =
          a_ends == b_ends ? CGAL::midpoint(mesh.point(a), mesh.point(b)) : mesh.point(a_ends ? a : b);
      if (!CGAL::Euler::does_satisfy_link_condition(e, mesh) || turns(mesh, h, to) ||
          turns(mesh, mesh.opposite(h), to))
        continue;
      mesh.point(CGAL::Euler::collapse_edge(e, mesh)) = to;
      any = true;
    }
  }
  mesh.collect_garbage();
  return mesh;
}

/// Girth of a mesh at a level where nothing but its trunk lies [m].
double girth_at(const geometry::Mesh& mesh, double level) {
  double girth = 0;
  for (const geometry::Face f : mesh.faces()) {
    std::vector<geometry::Point> cut;
    for (const geometry::Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const geometry::Point &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
      if ((p.y() < level) != (q.y() < level)) cut.push_back(p + (level - p.y()) / (q.y() - p.y()) * (q - p));
    }
    if (cut.size() == 2) girth += std::sqrt(CGAL::squared_distance(cut[0], cut[1]));
  }
  return girth;
}

/// The height in the pattern of the cloth that is worn at a level: the first vertices of the worn mesh are
/// those of the pattern.
double pattern_height(const geometry::Mesh& worn, const geometry::Mesh& pattern, double level) {
  double sum = 0;
  int count = 0;
  for (const geometry::Vertex v : pattern.vertices())
    if (std::abs(worn.point(v).y() - level) < 0.02) sum += pattern.point(v).y() - worn.point(v).y(), ++count;
  REQUIRE(count > 20);
  return level + sum / count;
}

}  // namespace

TEST_CASE("drape: a size stays the size that it was cut, refined or not, at chest and waist", "[release]") {
  ScratchDirectory scratch;
  const std::string shirt = scratch / "shirt.obj", cache = scratch / "cache",
                    mannequin = (source_dir() / "meshes/mannequin.obj").string(),
                    body = " --body " + mannequin + " ";
  io::MeshFile coarse = io::read_mesh(source_dir() / "meshes/shirt.obj");
  coarse.mesh = coarser(coarse.mesh, 0.0165);  // so that it takes seconds
  REQUIRE(coarse.mesh->is_valid());
  REQUIRE(coarse.mesh->number_of_vertices() < 2500);
  io::write_mesh(shirt, coarse);
  REQUIRE(run_furrow("sdf " + mannequin + " --cache " + cache + " -q").exit_code == 0);
  double ease[2][2][3] = {}, cut_girth[2][3] = {}, chest = 0;
  for (int size = 0; size < 3; ++size) {  // 5 % narrower, as it is, 5 % wider
    io::MeshFile made = coarse;
    const double width = 0.95 + 0.05 * size;
    for (auto v : made.mesh->vertices()) {
      const auto p = made.mesh->point(v);
      made.mesh->point(v) = {width * p.x(), p.y(), width * p.z()};
    }
    const std::string cut = scratch / ("cut" + std::to_string(size) + ".obj"), sized = scratch / "sized.ply";
    io::write_mesh(cut, made);
    REQUIRE(run_furrow("fit " + shirt + " --rest-shape " + cut + body + "-o " + sized + " -q").exit_code ==
            0);
    for (int refined = 0; refined < 2; ++refined) {
      const json r = report_of_run("drape " + sized + body + "--cache " + cache + " --subdivide " +
                                   std::to_string(refined) + " -o " + (scratch / "worn.ply"));
      for (int section = 0; section < 2; ++section) {
        const json& e = r["fit"]["ease"][std::size_t(section)];
        REQUIRE(e["section"] == (section == 0 ? "chest" : "waist"));
        ease[section][refined][size] = e["ease"].get<double>();
        if (section == 0 && size == 1 && refined == 0) chest = e["rest_girth"].get<double>();
        if (section == 1) {  // each size hangs at another height, and the shirt flares
          const geometry::Mesh worn = io::read_mesh(scratch / "worn.ply").mesh;
          cut_girth[refined][size] =
              girth_at(made.mesh, pattern_height(worn, made.mesh, e["height"].get<double>()));
        }
      }
    }
  }
  for (int refined = 0; refined < 2; ++refined) {
    INFO((refined ? "refined" : "as it is"));
    for (int larger = 1; larger < 3; ++larger) {
      const auto step = [&](const double(&e)[3]) { return e[larger] - e[larger - 1]; };
      CHECK(step(ease[0][refined]) == Approx(0.05 * chest).margin(0.003));
      CHECK(step(ease[1][refined]) == Approx(step(cut_girth[refined])).margin(0.001));
    }
  }
  for (int section = 0; section < 2; ++section)
    for (int size = 0; size < 3; ++size)
      CHECK(ease[section][1][size] == Approx(ease[section][0][size]).margin(0.006));
}
