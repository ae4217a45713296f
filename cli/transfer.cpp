// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/transfer.h"

#include <iostream>
#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct TransferArguments : CommonArguments {
  std::string original, wrinkled, rest, body;
  geometry::TransferOptions options;
};

void transfer(const TransferArguments& a) {
  using Path = std::filesystem::path;
  TransferJob job{Path(a.original), Path(a.wrinkled), {}, {}, a, a.options, a.out};
  if (!a.body.empty()) job.body = Path(a.body);
  if (!a.rest.empty()) job.rest = Path(a.rest);
  Terminal terminal(a);
  const TransferReport report = jobs::transfer(job, terminal);
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

}  // namespace

void add_transfer(CLI::App& app) {
  auto a = std::make_shared<TransferArguments>();
  CLI::App* sub = app.add_subcommand(
      "transfer",
      "Bring the shape of a wrinkled mesh back to the mesh it was made of\n\n"
      "The original's texture coordinates, groups and attributes stay as they are. From OBJ to OBJ all but\n"
      "the coordinates of its vertices is copied as it stands, polygons too; otherwise faces are written as\n"
      "triangles.\n\n"
      "  furrow transfer shirt.obj worn.ply -o shirt-worn.obj");
  sub->add_option("original", a->original, "mesh whose vertices are to move")->required();
  sub->add_option("wrinkled", a->wrinkled, "mesh of wrinkle or simulate; PLY knows where its vertices lay")
      ->required();
  sub->add_option("-o,--output", a->out,
                  "mesh to write: obj, ply, off, stl or glb; - is OBJ to standard output")
      ->required();
  sub->add_option("--rest-shape", a->rest,
                  "the wrinkled mesh's vertices before lines and motion, if it is no PLY");
  sub->add_option("--body", a->body,
                  "body that it is worn on, in the same frame: where it comes through the mesh is reported");
  sub->add_option("--max-distance", a->options.max_distance,
                  "how far an original vertex may lie from the wrinkled mesh's rest surface [m]")
      ->capture_default_str();
  add_common_options(*sub, *a);
  sub->callback([a] { transfer(*a); });
}

}  // namespace furrow::cli
