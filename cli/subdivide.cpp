// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/subdivide.h"

#include <memory>

#include "cli/common.h"
#include "cli/max_weights.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct SubdivideArguments : CommonArguments {
  std::string in, strokes, rule = "safe";
  bool all = false;
  int loop = 0, sqrt3 = 0, linear = 0;
  std::optional<int> max_weights;
  geometry::InsertionOptions options;
};

SubdivideJob job_of(const SubdivideArguments& a) {
  if (!a.strokes.empty() + a.all + (a.loop > 0) + (a.sqrt3 > 0) + (a.linear > 0) != 1)
    throw UsageError("subdivide takes one of --strokes, --all, --subdivide, --sqrt3 and --linear");
  SubdivideJob job{std::filesystem::path(a.in)};
  job.refinement = !a.strokes.empty() ? Refinement::strokes
                   : a.all            ? Refinement::everywhere
                   : a.loop > 0       ? Refinement::loop
                   : a.sqrt3 > 0      ? Refinement::sqrt3
                                      : Refinement::linear;
  job.steps = a.loop + a.sqrt3 + a.linear;  // one of them
  job.strokes = std::filesystem::path(a.strokes);
  job.frame = a;
  job.options = a.options;
  job.options.rule = a.rule == "paper" ? geometry::InsertionRule::paper : geometry::InsertionRule::safe;
  job.max_weights = a.max_weights;
  job.output = a.out;
  return job;
}

void subdivide(const SubdivideArguments& a) {
  const SubdivideJob job = job_of(a);
  Terminal terminal(a);
  const SubdivideReport report = jobs::subdivide(job, terminal);
  if (a.out == "-") write_mesh(report.mesh, in_frame(a, report.frame));
  Json json = to_json(report);
  json["written"] = a.out;
  print_report(json, a,
               {subdivide_lines(json),
                {a.out},
                a.out == "-" || !a.strokes.empty()
                    ? std::vector<std::string>{}
                    : std::vector<std::string>{"furrow", "wrinkle", a.out, "LINES", "-o", "wrinkled.ply"}});
}

}  // namespace

void add_subdivide(CLI::App& app) {
  auto a = std::make_shared<SubdivideArguments>();
  CLI::App* sub =
      app.add_subcommand("subdivide",
                         "Refine a mesh along strokes or everywhere; strokes leave its shape as it is\n\n"
                         "  furrow subdivide shirt.obj --subdivide 2 -o fine.obj\n"
                         "  furrow subdivide shirt.obj --strokes lines.json -o lined.ply");
  sub->add_option("mesh", a->in, "mesh to read")->required();
  sub->add_option("-o,--output", a->out,
                  "mesh to write: obj, ply, off, stl or glb; - is OBJ to standard output")
      ->required();
  sub->add_option("--strokes", a->strokes, "insert lines: JSON, or the l elements of an OBJ file");
  sub->add_flag("--all", a->all, "insert a vertex in every face and flip every edge");
  sub->add_option("--subdivide", a->loop, "so many steps of Loop subdivision")->check(CLI::Range(0, 6));
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
