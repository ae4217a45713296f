// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/subdivide.h"

#include <memory>

#include "cli/common.h"
#include "cli/max_weights.h"
#include "cli/subcommands.h"
#include "geometry/insert/insert_along_stroke.h"
#include "geometry/insert/insert_in_faces.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/report/wrinkle_reports.h"

namespace furrow::cli {
namespace {

struct SubdivideArguments : CommonArguments {
  std::string in, strokes, rule = "safe";
  bool all = false;
  int loop = 0, sqrt3 = 0, linear = 0;
  std::optional<int> max_weights;
  geometry::InsertionOptions options;
};

/// Springs follow the new edges; masses are lumped anew by whoever needs them.
Json conclude(geometry::Mesh& mesh, const geometry::InsertionReport& report) {
  if (geometry::find_map(mesh, geometry::attribute::bending_rest_length))
    geometry::rebuild_bending_springs(mesh, report.changed_faces);
  if (auto mass = geometry::find_map(mesh, geometry::attribute::mass)) mesh.remove_property_map(*mass);
  return to_json(report, mesh);
}

Json insert_strokes(io::MeshFile& file, const SubdivideArguments& a) {
  geometry::Mesh& mesh = file.mesh;
  geometry::InsertionReport sum;
  int id = next_line(mesh);
  const auto drawn = io::read_drawn_strokes(a.strokes, geometry::Stroke{}.height, read_options(a));
  const io::ResolvedStrokes resolved = io::resolve_strokes(drawn, file, a.options.max_distance);
  for (const std::string& w : resolved.warnings) warn(w, a);
  for (const geometry::Stroke& stroke : resolved.strokes)
    sum += geometry::insert_along_stroke(mesh, stroke, id++, a.options).report;
  for (const std::string& w : sum.warnings) warn(w, a);
  return conclude(mesh, sum);
}

Json insert_everywhere(geometry::Mesh& mesh, const SubdivideArguments& a) {
  std::vector<geometry::FacePoint> centroids;
  for (geometry::Face f : mesh.faces()) centroids.push_back({f, {1. / 3, 1. / 3, 1. / 3}});
  return conclude(mesh, geometry::insert_in_faces(mesh, centroids, a.options));
}

void subdivide(SubdivideArguments a) {
  if (!a.strokes.empty() + a.all + (a.loop > 0) + (a.sqrt3 > 0) + (a.linear > 0) != 1)
    throw UsageError("subdivide takes one of --strokes, --all, --loop, --sqrt3 and --linear");
  a.options.rule = a.rule == "paper" ? geometry::InsertionRule::paper : geometry::InsertionRule::safe;
  check_output(a.out);
  refuse_same(a.out, a.strokes);
  take_noted_frame(a, {a.in});
  io::MeshFile file = read_mesh(a.in, a);
  Json report = Json::object();
  if (!a.strokes.empty()) report = insert_strokes(file, a);
  if (a.all) report = insert_everywhere(file.mesh, a);
  if (a.loop > 0) geometry::loop_subdivide(file.mesh, a.loop);
  if (a.sqrt3 > 0) geometry::sqrt3_subdivide(file.mesh, a.sqrt3);
  if (a.linear > 0) geometry::midpoint_subdivide(file.mesh, a.linear);
  if (a.max_weights) geometry::normalize_skin_weights(file.mesh, *a.max_weights);
  write_mesh(file, a);
  report["vertices"] = file.mesh.number_of_vertices();
  report["faces"] = file.mesh.number_of_faces();
  report["written"] = a.out;
  print_report(report, a);
}

}  // namespace

void add_subdivide(CLI::App& app) {
  auto a = std::make_shared<SubdivideArguments>();
  CLI::App* sub =
      app.add_subcommand("subdivide",
                         "Refine a mesh along strokes or everywhere; strokes leave its shape as it is\n\n"
                         "  furrow subdivide shirt.obj --loop 2 -o fine.obj\n"
                         "  furrow subdivide shirt.obj --strokes lines.json -o lined.ply");
  sub->add_option("mesh", a->in, "mesh to read")->required();
  sub->add_option("-o,--output", a->out, "mesh to write: obj, ply, off or stl; - is OBJ to standard output")
      ->required();
  sub->add_option("--strokes", a->strokes, "insert lines: JSON, or the l elements of an OBJ file");
  sub->add_flag("--all", a->all, "insert a vertex in every face and flip every edge");
  sub->add_option("--loop", a->loop, "steps of Loop subdivision")->check(CLI::Range(0, 6));
  sub->add_option("--sqrt3", a->sqrt3, "steps of sqrt(3) subdivision")->check(CLI::Range(0, 6));
  sub->add_option("--linear", a->linear, "steps of cutting every triangle into four; the surface stays")
      ->check(CLI::Range(0, 6));
  add_max_weights(*sub, a->max_weights);
  sub->add_option("--rule", a->rule, "safe or paper, for --strokes and --all")
      ->check(CLI::IsMember({"safe", "paper"}))
      ->capture_default_str();
  sub->add_option("--max-distance", a->options.max_distance, "how far a stroke may lie from the surface [m]")
      ->capture_default_str();
  add_common_options(*sub, *a);
  sub->callback([a] { subdivide(*a); });
}

}  // namespace furrow::cli
