// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/info.h"

#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/base/gate.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct InfoArguments : CommonArguments {
  std::string mesh;
};

void info(const InfoArguments& a) {
  Terminal terminal(a);
  const io::MeshFile file =
      jobs::read_mesh(std::filesystem::path(a.mesh), {a, terminal}, jobs::Chains::taken);
  const std::string odd = odd_size(file.mesh, "mesh", a);
  if (!odd.empty()) warn(a.mesh + ": " + odd, a);
  const Json json = jobs::info(file);
  std::vector<std::string> lines = info_lines(json);
  if (!odd.empty() && lines.back() == "no faults found") lines.back() = "look at: its size";
  print_report(json, a,
               {lines,
                {},
                odd.empty() ? std::vector<std::string>{}
                            : std::vector<std::string>{"furrow", "info", a.mesh, "--unit", "UNIT"}});
}

}  // namespace

void add_info(CLI::App& app) {
  auto a = std::make_shared<InfoArguments>();
  CLI::App* sub = app.add_subcommand("info", "Say what a mesh is: counts, topology, lengths, areas, faults");
  sub->add_option("mesh", a->mesh,
                  "mesh to read: " + io::mesh_formats(true) + "; - is OBJ from standard input")
      ->required();
  add_common_options(*sub, *a);
  sub->callback([a] { info(*a); });
}

}  // namespace furrow::cli
