// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the inputs of this folder: make_meshes FOLDER writes FOLDER/*.obj and FOLDER/strokes/*.json.
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/generators.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

#include "geometry/mesh/sheet.h"
#include "geometry/refine/subdivide.h"
#include "meshes/garments.h"
#include "meshes/mannequin.h"
#include "meshes/panelled.h"

namespace {

using furrow::geometry::Face;
using furrow::geometry::Mesh;
using furrow::geometry::Point;
using furrow::geometry::Vertex;
using nlohmann::json;

/// Shortest text that reads back as the same double.
std::string text(double x) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x + 0.0).ptr};
}

double rounded(double x) { return std::round(x * 1e6) / 1e6 + 0.0; }  // to a micrometre; -0 becomes 0

void write(const std::filesystem::path& path, const std::string& content) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << content;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string obj(const Mesh& mesh, const std::string& comment) {
  std::string out = "# " + comment + "\n";
  for (Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    out += "v " + text(p.x()) + " " + text(p.y()) + " " + text(p.z()) + "\n";
  }
  for (Face f : mesh.faces()) {
    out += "f";
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) out += " " + std::to_string(v.idx() + 1);
    out += "\n";
  }
  return out;
}

/// To 10 micrometres, which is finer than any tool needs.
void round_positions(Mesh& mesh) {
  const auto to_grid = [](double x) { return std::round(x * 1e5) / 1e5; };
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    mesh.point(v) = {to_grid(p.x()), to_grid(p.y()), to_grid(p.z())};
  }
}

void make_figure(const std::filesystem::path& folder) {
  const auto save = [&](const char* name, Mesh mesh, const char* comment) {
    round_positions(mesh);
    write(folder / name, obj(mesh, std::string(comment) + "; metres, y up, made by make_meshes"));
  };
  save("mannequin.obj", furrow::meshes::make_mannequin(),
       "a woman of 1.70 m who looks along +z, arms away from the body");
  save("shirt.obj", furrow::meshes::make_shirt(), "T-shirt for mannequin.obj");
  save("skirt.obj", furrow::meshes::make_skirt(), "flared skirt for mannequin.obj");
}

/// Garments as they come from elsewhere: in a unit, with an upward axis, with a front and an origin of their
/// own.
void make_strange(const std::filesystem::path& folder) {
  Mesh dress = furrow::meshes::make_dress();
  for (Vertex v : dress.vertices()) {  // to z up, the front towards -y, as Blender has it
    const Point p = dress.point(v);
    dress.point(v) = {rounded(p.x()) * 100, rounded(-p.z()) * 100, rounded(p.y()) * 100};
  }
  round_positions(dress);
  write(folder / "dress_cm.obj",
        obj(dress, "dress for mannequin.obj; centimetres, z up, made by make_meshes"));
  Mesh tunic = furrow::meshes::make_tunic();
  for (Vertex v : tunic.vertices()) {
    const Point p = tunic.point(v);
    tunic.point(v) = {p.z() + 0.4, p.y() - 0.3, 0.25 - p.x()};
  }
  round_positions(tunic);
  write(folder / "tunic.obj", obj(tunic,
                                  "tunic for mannequin.obj, which looks along +x and stands at 0.4 -0.3 0.25;"
                                  " metres, y up, made by make_meshes"));
}

/// Lines without a face.
void make_chain(const std::filesystem::path& path) {
  constexpr int links = 32;
  const double depth = std::sqrt(0.75 * 0.75 - 0.5 * 0.5);
  const auto to_grid = [](double x) { return std::round(x * 1e5) / 1e5; };
  std::string vertices, line = "l";
  for (int i = 0; i <= links; ++i) {
    const double t = double(i) / links;
    vertices +=
        "v " + text(to_grid(t - 0.5)) + " " + text(to_grid(1 - depth * (1 - std::abs(2 * t - 1)))) + " 0\n";
    line += " " + std::to_string(i + 1);
  }
  write(path,
        "# a chain of 32 links, 1.5 m long, drawn as a V between two points 1 m apart; metres, y up, made by "
        "make_meshes\n" +
            vertices + line + "\n");
}

/// The meshes of the scenes with known answers.
void make_validation(const std::filesystem::path& folder) {
  const auto save = [&](const char* name, Mesh mesh, const char* comment) {
    round_positions(mesh);
    write(folder / name, obj(mesh, std::string(comment) + "; metres, y up, made by make_meshes"));
  };
  Mesh patch = furrow::geometry::equilateral_sheet(0.1, 0.1, 0.01);
  for (Vertex v : patch.vertices()) patch.point(v) = {patch.point(v).x(), 0.003, 0.05 - patch.point(v).y()};
  save("patch.obj", patch, "0.1 m x 0.1 m of cloth, flat, 3 mm above y = 0");

  const double row = 0.1 / 16, across = row / std::sqrt(0.75);
  Mesh strip = furrow::geometry::equilateral_sheet(4 * across, 17 * row, across);
  for (Vertex v : strip.vertices()) strip.point(v) = {strip.point(v).y() - row, 0, strip.point(v).x()};
  save("strip.obj", strip,
       "0.1 m along x by four triangles, flat, and one more row behind the clamp at x = 0");

  Mesh slab;
  const Point p[] = {{-0.5, -0.2, -0.5}, {0.5, -0.2, -0.5}, {0.5, 0, -0.5},   {-0.5, 0, -0.5},
                     {-0.5, 0, 0.5},     {-0.5, -0.2, 0.5}, {0.5, -0.2, 0.5}, {0.5, 0, 0.5}};
  CGAL::make_hexahedron(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], slab);
  CGAL::Polygon_mesh_processing::triangulate_faces(slab);
  save("slab.obj", slab, "a block of 1 m x 0.2 m x 1 m, its upper face on y = 0");

  Mesh ball;
  CGAL::make_icosahedron(ball, Point(0, 0, 0), 0.15);
  furrow::geometry::midpoint_subdivide(ball, 4);
  for (Vertex v : ball.vertices()) {
    const auto d = ball.point(v) - CGAL::ORIGIN;
    ball.point(v) = CGAL::ORIGIN + d * (0.15 / std::sqrt(d.squared_length()));
  }
  save("ball.obj", ball, "a ball of radius 0.15 m about the origin");
}

/// Points every `spacing` metres on the way from a to b, both included.
json segment(const Point& a, const Point& b, double spacing) {
  const int n = static_cast<int>(std::ceil(std::sqrt(CGAL::squared_distance(a, b)) / spacing - 1e-9));
  json points = json::array();
  for (int i = 0; i <= n; ++i) {
    const Point p = a + static_cast<double>(i) / n * (b - a);
    points.push_back({rounded(p.x()), rounded(p.y()), rounded(p.z())});
  }
  return points;
}

json ring(const Point& center, double radius, int n) {
  json points = json::array();
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.push_back({rounded(center.x() + radius * std::cos(angle)),
                      rounded(center.y() + radius * std::sin(angle)), rounded(center.z())});
  }
  return points;
}

void write_strokes(const std::filesystem::path& path, const json& strokes) {
  std::string content = "{\"strokes\": [\n";
  for (const json& stroke : strokes) content += stroke.dump() + (&stroke == &strokes.back() ? "\n" : ",\n");
  write(path, content + "]}\n");
}

void make(const std::filesystem::path& folder) {
  write(folder / "sheet.obj",
        obj(furrow::geometry::equilateral_sheet(1, 1, 0.02),
            "1 m x 1 m of cloth, equilateral triangles of edge 20 mm; metres, y up, made by make_meshes"));
  // Ridge and valley: 0.5 m each (legs of 0.3 and 0.4 m), falling from below the corners towards the middle.
  const json strokes = {
      {{"name", "ridge"}, {"height", 0.02}, {"points", segment({-0.36, 0.86, 0}, {-0.06, 0.46, 0}, 0.005)}},
      {{"name", "valley"}, {"height", -0.02}, {"points", segment({0.36, 0.86, 0}, {0.06, 0.46, 0}, 0.005)}},
      {{"name", "ring"}, {"height", 0.03}, {"closed", true}, {"points", ring({0, 0.22, 0}, 0.12, 150)}}};
  write_strokes(folder / "strokes" / "sheet.json", strokes);
  write(
      folder / "hung_sheet.obj",
      obj(furrow::geometry::equilateral_sheet(0.6, 0.8, 0.017),
          "0.6 m x 0.8 m of cloth, equilateral triangles of edge 17 mm; metres, y up, made by make_meshes"));
  const json three = {{{"name", "horizontal"},
                       {"height", 0.0155},
                       {"points", segment({-0.2, 0.68, 0}, {0.2, 0.68, 0}, 0.005)}},
                      {{"name", "vertical"},
                       {"height", 0.0155},
                       {"points", segment({-0.18, 0.54, 0}, {-0.18, 0.14, 0}, 0.005)}},
                      {{"name", "diagonal"},
                       {"height", 0.0155},
                       {"points", segment({-0.02, 0.18, 0}, {0.22, 0.5, 0}, 0.005)}}};
  write_strokes(folder / "strokes" / "hung_sheet.json", three);
  write(folder / "panelled.obj", furrow::meshes::panelled_obj());
  write_strokes(folder / "strokes" / "panelled.json", furrow::meshes::panelled_strokes());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::invalid_argument("usage: make_meshes FOLDER");
    make(argv[1]);
    make_figure(argv[1]);
    make_strange(argv[1]);
    make_validation(std::filesystem::path(argv[1]) / "validation");
    make_chain(std::filesystem::path(argv[1]) / "chain.obj");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
