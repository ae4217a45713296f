// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "cli/common.h"
#include "cli/smoothing_options.h"
#include "cli/subcommands.h"
#include "geometry/mesh/property_names.h"

namespace furrow::cli {
namespace {

struct SmoothArguments : CommonArguments {
  std::string in;
  SmoothingArguments smoothing;
};

void smooth(SmoothArguments a) {
  check_output(a.out);
  take_noted_frame(a, {a.in});
  io::MeshFile file = read_mesh(a.in, a);
  geometry::taubin_smooth(file.mesh, {}, to_options(a.smoothing));
  write_mesh(file, a);
  print_report({{"vertices", file.mesh.number_of_vertices()},
                {"iterations", a.smoothing.iterations},
                {"written", a.out}},
               a);
}

}  // namespace

void add_smooth(CLI::App& app) {
  auto a = std::make_shared<SmoothArguments>();
  CLI::App* sub = app.add_subcommand("smooth",
                                     "Smooth a whole mesh without shrinking it (Taubin)\n\n  furrow smooth "
                                     "scan.ply -o smooth.ply --iterations 20");
  sub->add_option("mesh", a->in, "mesh to read")->required();
  sub->add_option("-o,--output", a->out, "mesh to write: obj, ply, off or stl; - is OBJ to standard output")
      ->required();
  add_smoothing_options(*sub, a->smoothing);
  add_common_options(*sub, *a);
  sub->callback([a] { smooth(*a); });
}

}  // namespace furrow::cli
