// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/subdivide.h"

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct SubdivideArguments : CommonArguments {
  std::string in;
  SubdivideJob job;
};

Lines subdivide_lines(const Json& report) {
  Lines lines{"refined to " + std::to_string(count_of(report, "vertices")) + " vertices, " +
              std::to_string(count_of(report, "faces")) + " faces"};
  if (report.contains("inserted"))
    lines.push_back(std::to_string(count_of(report, "inserted")) +
                    " vertices inserted along the strokes; smallest angle " +
                    number(value_of(report, "min_angle_deg")) + " degrees");
  if (const std::size_t n = list_of(report, "line_edges_missing").size())
    lines.push_back("look at: " + counted(n, "edge") + " of the lines could not be made");
  return lines;
}

void subdivide(SubdivideArguments& a) {
  SubdivideJob& job = a.job;
  std::size_t ways = 0;
  for (const char* way : {"--strokes", "--all", "--subdivide", "--sqrt3", "--linear"})
    ways += a.typed->count(way) > 0;
  if (ways != 1 || job.steps == 0)
    throw UsageError("subdivide takes one of --strokes, --all, --subdivide, --sqrt3 and --linear");
  const bool has_strokes = a.typed->count("--strokes");
  if (has_strokes) job.refinement = Refinement::strokes;
  job.mesh = std::filesystem::path(a.in);
  job.frame = a;
  a.out = job.output.string();
  Terminal terminal(a);
  const SubdivideReport report = jobs::subdivide(job, terminal);
  if (a.out == "-") write_mesh(report.mesh, in_frame(a, report.frame));
  Json json = to_json(report);
  json["written"] = a.out;
  print_report(json, a,
               {subdivide_lines(json),
                {a.out},
                a.out == "-" || has_strokes
                    ? std::vector<std::string>{}
                    : std::vector<std::string>{"furrow", "wrinkle", a.out, "LINES", "-o", "wrinkled.ply"}});
}

void add_subdivide(CLI::App& sub, SubdivideArguments& a) {
  sub.add_option("mesh", a.in, "mesh to read")->required();
  add_card(sub, card(a.job));
  sub.get_option("--output")->required();
}

const Subcommand subdivide_subcommand(
    30, "subdivide",
    "Refine a mesh along strokes or everywhere; strokes leave its shape as it is\n\n"
    "  furrow subdivide shirt.obj --subdivide 2 -o fine.obj\n"
    "  furrow subdivide shirt.obj --strokes lines.json -o lined.ply",
    add_subdivide, subdivide);

}  // namespace
}  // namespace furrow::cli
