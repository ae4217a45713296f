// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/transfer.h"

#include <iostream>

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct TransferArguments : CommonArguments {
  std::string original, wrinkled;
  TransferJob job;
};

Lines transfer_lines(const Json& report) {
  Lines lines{std::to_string(count_of(report, "vertices")) + " vertices moved to the wrinkled shape, " +
              std::to_string(count_of(report, "unchanged")) + " of them unchanged"};
  if (const long long n = count_of(report, "interpolated"))
    lines.push_back(std::to_string(n) + " of them by the nearest place, at most " +
                    length(report, "max_distance") + " away");
  add_crossings(lines, report);
  return lines;
}

void transfer(TransferArguments& a) {
  a.job.original = std::filesystem::path(a.original);
  a.job.wrinkled = std::filesystem::path(a.wrinkled);
  a.job.frame = a;
  a.out = a.job.output.string();
  Terminal terminal(a);
  const TransferReport report = jobs::transfer(a.job, terminal);
  if (a.out == "-" && report.obj_text) {
    std::cout << *report.obj_text;
    flush_output();
  } else if (a.out == "-") {
    write_mesh(report.result, in_frame(a, report.frame));
  }
  Json json = to_json(report);
  json["written"] = a.out;
  print_report(json, a, {transfer_lines(json), {a.out}});
}

void add_transfer(CLI::App& sub, TransferArguments& a) {
  sub.add_option("original", a.original, "mesh whose vertices are to move")->required();
  sub.add_option("wrinkled", a.wrinkled, "mesh of wrinkle or simulate; PLY knows where its vertices lay")
      ->required();
  add_card(sub, card(a.job));
  sub.get_option("--output")->required();
}

const Subcommand transfer_subcommand(
    160, "transfer",
    "Bring the shape of a wrinkled mesh back to the mesh it was made of\n\n"
    "The original's texture coordinates, groups and attributes stay as they are. From OBJ to OBJ all but\n"
    "the coordinates of its vertices is copied as it stands, polygons too; otherwise faces are written as\n"
    "triangles.\n\n"
    "  furrow transfer shirt.obj worn.ply -o shirt-worn.obj",
    add_transfer, transfer);

}  // namespace
}  // namespace furrow::cli
