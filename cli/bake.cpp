// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/bake.h"

#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct BakeArguments : CommonArguments {
  std::string low, high, applied;
  int check = -1;
  geometry::BakeOptions options;
};

BakeJob job_of(const BakeArguments& a) {
  if (a.out == "-") throw UsageError("-o: maps need a prefix for their names");
  using Path = std::filesystem::path;
  BakeJob job{Path(a.low), Path(a.high), a, a.options, a.out, {}, a.applied};
  if (a.check >= 0) job.check = a.check;
  return job;
}

int bake(const BakeArguments& a) {
  const BakeJob job = job_of(a);
  catch_interrupts();
  Terminal terminal(a);
  const BakeReport report = jobs::bake(job, terminal);
  if (!report.ran) {
    warn("interrupted; nothing is written", a);
    return exit_interrupted;
  }
  if (report.check && a.applied == "-") write_mesh("-", report.check->applied, a);
  if (report.cancelled)  // what follows the maps is only a measurement
    warn("interrupted; the maps are written, the check is not complete", a);
  const Json json = to_json(report);
  print_report(json, a, {bake_lines(json), json["written"].get<std::vector<std::string>>()});
  return report.cancelled ? exit_interrupted : exit_ok;
}

}  // namespace

void add_bake(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<BakeArguments>();
  CLI::App* sub = app.add_subcommand(
      "bake",
      "Bake a wrinkled mesh into textures of the mesh it was made of\n\n"
      "Writes PREFIX_normal.png, PREFIX_displacement.png (16 bits, tangent space) and PREFIX_maps.json.\n\n"
      "  furrow bake shirt.obj worn.ply -o shirt --texels 2048");
  sub->add_option("low", a->low, "mesh that the maps are for; its texture charts must not overlap")
      ->required();
  sub->add_option("high", a->high, "wrinkled mesh with the same charts, in the same pose")->required();
  sub->add_option("-o,--output", a->out, "what the names of the files begin with")->required();
  sub->add_option("--texels", a->options.size, "width and height of the maps [texels]")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  sub->add_option("--padding", a->options.padding, "how far the charts go on beyond their borders [texels]")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->add_option("--check", a->check,
                  "apply the written map to the low mesh cut so many times into four, and report the "
                  "distances between the result and the high mesh [m]")
      ->check(CLI::Range(0, 6));
  sub->add_option("--applied", a->applied, "mesh to write the result of --check to");
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = bake(*a); });
}

}  // namespace furrow::cli
