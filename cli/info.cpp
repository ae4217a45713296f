// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/info.h"

#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/check/gate.h"
#include "jobs/read_inputs.h"

namespace furrow::cli {
namespace {

struct InfoArguments : CommonArguments {
  std::string mesh;
};

/// A line needs edges of about a centimetre.
std::string next_of(const Json& report, const std::string& mesh) {
  const double edge = report.value("mean_edge_length", 0.0);
  if (!(edge > 0.015)) return "";
  return "furrow subdivide " + mesh + " --subdivide " + (edge > 0.03 ? "2" : "1") +
         " -o fine.ply, as lines need edges of about 10 mm";
}

void info(const InfoArguments& a) {
  const io::MeshFile file = read_mesh(a.mesh, a);
  if (const std::string hint = odd_size(file.mesh, "mesh", a); !hint.empty()) warn(a.mesh + ": " + hint, a);
  const Json json = jobs::info(file);
  print_report(json, a, {info_lines(json), {}, next_of(json, a.mesh)});
}

}  // namespace

void add_info(CLI::App& app) {
  auto a = std::make_shared<InfoArguments>();
  CLI::App* sub = app.add_subcommand("info", "Say what a mesh is: counts, topology, lengths, areas, faults");
  sub->add_option("mesh", a->mesh,
                  "mesh to read: obj, ply, off, stl, gltf, glb; - is OBJ from standard input")
      ->required();
  add_common_options(*sub, *a);
  sub->callback([a] { info(*a); });
}

}  // namespace furrow::cli
