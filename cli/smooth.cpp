// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/smooth.h"

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct SmoothArguments : CommonArguments {
  std::string in;
  SmoothJob job;
};

Lines smooth_lines(const Json& report) {
  return {"smoothed " + std::to_string(count_of(report, "vertices")) + " vertices in " +
          counted(count_of(report, "iterations"), "pair") + " of steps"};
}

void smooth(SmoothArguments& a) {
  a.job.mesh = std::filesystem::path(a.in);
  a.job.frame = a;
  a.out = a.job.output.string();
  Terminal terminal(a);
  const SmoothReport report = jobs::smooth(a.job, terminal);
  if (a.out == "-") write_mesh(report.mesh, in_frame(a, report.frame));
  Json json = to_json(report);
  json["written"] = a.out;
  print_report(json, a, {smooth_lines(json), {a.out}});
}

void add_smooth(CLI::App& sub, SmoothArguments& a) {
  sub.add_option("mesh", a.in, "mesh to read")->required();
  add_card(sub, card(a.job));
  sub.get_option("--output")->required();
}

const Subcommand smooth_subcommand(40, "smooth",
                                   "Smooth a whole mesh without shrinking it (Taubin)\n\n  furrow smooth "
                                   "scan.ply -o smooth.ply --iterations 20",
                                   add_smooth, smooth);

}  // namespace
}  // namespace furrow::cli
