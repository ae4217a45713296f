// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/bake.h"

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct BakeArguments : CommonArguments {
  std::string low, high;
  BakeJob job;
};

Lines bake_lines(const Json& report) {
  Lines lines{"maps of " + std::to_string(count_of(report, "size")) + " x " +
              std::to_string(count_of(report, "size")) + " texels, " +
              std::to_string(count_of(report, "covered_texels")) + " covered; displacement at most " +
              length(report, "largest_displacement")};
  for (const auto& [key, words] : {std::pair("unmatched_texels", "texels found no wrinkled mesh"),
                                   {"overlapping_texels", "texels lie in two charts"}})
    if (const long long n = count_of(report, key))
      lines.push_back("look at: " + std::to_string(n) + " " + words);
  if (const Json& check = table_of(report, "check"); !check.empty()) {
    const Json& to_high = table_of(check, "to_high");
    lines.push_back("check: the map's surface lies " + length(to_high, "median") + " (median) to " +
                    length(to_high, "max") + " from the wrinkled mesh");
  }
  return lines;
}

int bake(BakeArguments& a) {
  BakeJob& job = a.job;
  a.out = job.prefix;
  if (a.out == "-") throw UsageError("-o: maps need a prefix for their names");
  job.low = std::filesystem::path(a.low);
  job.high = std::filesystem::path(a.high);
  job.frame = a;
  catch_interrupts();
  Terminal terminal(a);
  const BakeReport report = jobs::bake(job, terminal);
  if (!report.ran) {
    warn("interrupted; nothing is written", a);
    return exit_interrupted;
  }
  if (report.check && job.applied == "-") write_mesh("-", report.check->applied, a);
  if (report.cancelled)  // what follows the maps is only a measurement
    warn("interrupted; the maps are written, the check is not complete", a);
  const Json json = to_json(report);
  print_report(json, a, {bake_lines(json), json["written"].get<std::vector<std::string>>()});
  return report.cancelled ? exit_interrupted : exit_ok;
}

void add_bake(CLI::App& sub, BakeArguments& a) {
  sub.add_option("low", a.low, "mesh that the maps are for; its texture charts must not overlap")->required();
  sub.add_option("high", a.high, "wrinkled mesh with the same charts, in the same pose")->required();
  add_card(sub, card(a.job));
  sub.get_option("--output")->required();
}

const Subcommand bake_subcommand(
    170, "bake",
    "Bake a wrinkled mesh into textures of the mesh it was made of\n\n"
    "Writes PREFIX_normal.png, PREFIX_displacement.png (16 bits, tangent space) and PREFIX_maps.json.\n\n"
    "  furrow bake shirt.obj worn.ply -o shirt --texels 2048",
    add_bake, bake);

}  // namespace
}  // namespace furrow::cli
