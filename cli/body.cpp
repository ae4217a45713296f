// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/body/body.h"

#include <fmt/format.h>

#include <iostream>

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/shipped.h"
#include "cli/subcommands.h"
#include "geometry/figure/repair_body.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct BodyArguments : CommonArguments {
  std::string in;
  BodyJob job;
};

std::string measures_words(const geometry::BodyMeasures& m) {
  return fmt::format("height {:.1f} cm, chest {:.1f}, waist {:.1f}, hip {:.1f}", 100 * m.height,
                     100 * m.chest, 100 * m.waist, 100 * m.hip);
}

int body(BodyArguments& a) {
  a.out = a.job.output.string();
  const std::filesystem::path in =
      a.in.empty() ? shipped("meshes/mannequin.obj") : std::filesystem::path(a.in);
  if (in.empty()) throw UsageError("our mannequin is not installed here; name a body: furrow body BODY");
  const bool asks = a.job.measures.any();
  if (asks && a.out.empty())
    throw UsageError("nothing to write: name --output for the body with these measurements");
  if (!asks && !a.out.empty())
    throw UsageError("no measurement is asked for: name --height, --chest, --waist or --hip, in metres");
  Terminal terminal(a);
  a.job.mesh = in;
  a.job.frame = a;
  const BodyReport report = jobs::shape_body(a.job, terminal);
  if (a.out == "-") write_mesh(report.mesh, in_frame(a, report.frame));
  Json json = to_json(report);
  std::vector<std::string> lines{(asks ? "was: " : "") + measures_words(report.shape.before)};
  if (asks) lines.push_back("now: " + measures_words(report.shape.reached));
  if (!a.out.empty()) json["written"] = a.out;
  print_report(json, a, {lines, {a.out}, {}});
  if (!asks || report.succeeds()) return exit_ok;
  if (report.new_crossings > 0)
    std::cerr
        << "error: " << report.new_crossings
        << " pairs of faces cross that did not before; ask for measurements nearer to the body's, or take a "
           "body whose arms hang farther from it\n";
  else
    std::cerr << fmt::format(
        "error: the body is {:.1f} cm off what was asked for; such measurements do not go together on this "
        "body\n",
        100 * report.shape.farthest);
  return exit_not_converged;
}

void add_body(CLI::App& sub, BodyArguments& a) {
  sub.add_option("body", a.in, "standing body to read (default: our mannequin)");
  add_card(sub, card(a.job));
}

const Subcommand body_subcommand(
    180, "body",
    "Give a body a person's measurements, or tell those that it has\n\n"
    "  furrow body --height 1.68 --chest 0.92 --waist 0.74 --hip 0.98 -o anna.obj\n"
    "  furrow body scan.obj --waist 0.80 -o wider.obj\n"
    "  furrow body scan.obj",
    add_body, body);

}  // namespace
}  // namespace furrow::cli
