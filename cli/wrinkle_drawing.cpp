// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/wrinkle_drawing.h"

#include "cli/help.h"
#include "cli/max_weights.h"
#include "cli/recorded_options.h"
#include "geometry/mesh/errors.h"

namespace furrow::cli {

void take_recorded_options(WrinkleArguments& a, const std::string& recorded) {
  CLI::App flags;
  add_drawing_options(flags, a);
  add_smoothing_options(flags, a.smoothing);
  try {
    parse_recorded(flags, recorded, *a.typed);
  } catch (const CLI::ParseError& e) {
    throw geometry::ContentError(a.in + ": the options in its record cannot be read: " + e.what());
  }
}

geometry::WrinkleOptions to_options(const WrinkleArguments& a) {
  using namespace geometry;
  WrinkleOptions o = a.options;
  o.smoothing = to_options(a.smoothing);
  o.insertion.rule = a.rule == "paper"  ? InsertionRule::paper
                     : a.rule == "safe" ? InsertionRule::safe
                                        : InsertionRule::fold;
  o.detail = a.detail == "coarse" ? Detail::coarse : a.detail == "fine" ? Detail::fine : Detail::normal;
  o.rest = a.rest == "flat" ? RestRule::flat : a.rest == "copied" ? RestRule::copied : RestRule::drawn;
  o.region = a.region == "whole-mesh" ? SmoothingRegion::whole_mesh : SmoothingRegion::two_ring;
  return o;
}

void add_drawing_options(CLI::App& sub, WrinkleArguments& a) {
  begin_group(sub, group::lines);
  sub.add_option("--height", a.height, "height of strokes that name none [m]; > 0 ridge, < 0 valley")
      ->capture_default_str();
  sub.add_option("--width", a.width,
                 "width of the fold of strokes that name none [m], > 0 (default: some five heights; with "
                 "--rule safe or "
                 "paper as wide as smoothing makes it)")
      ->check(CLI::PositiveNumber);
  sub.add_option(
         "--rule", a.rule,
         "fold: smooth folds on a mesh refined around them; safe: the paper's chain of vertices, flips "
         "that would spoil the mesh are refused; paper: the paper's plain rule")
      ->check(CLI::IsMember({"fold", "safe", "paper"}))
      ->capture_default_str();
  sub.add_option(
         "--rest", a.rest,
         "drawn: a line adds cloth, rest angles stay; copied: they turn, too; flat: the rest stays "
         "as it was; "
         "keep: the drawn shape bears its weight (needs --fabric or hinges; docs/keep.md), the default "
         "with --settle")
      ->check(CLI::IsMember({"drawn", "flat", "copied", "keep"}))
      ->capture_default_str();
  begin_group(sub, group::lines, Audience::few);
  sub.add_option("--max-distance", a.options.insertion.max_distance,
                 "how far a stroke may lie from the surface [m]")
      ->capture_default_str();
  sub.add_option("--region", a.region, "what is smoothed: two-ring (around the lines) or whole-mesh")
      ->check(CLI::IsMember({"two-ring", "whole-mesh"}))
      ->capture_default_str();
  sub.add_option("--detail", a.detail, "rule fold: how fine the mesh around folds becomes")
      ->check(CLI::IsMember({"coarse", "normal", "fine"}))
      ->capture_default_str();
  sub.add_option("--fold-iterations", a.options.fold_iterations,
                 "rule fold: pairs of smoothing steps after the folds are raised")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  sub.add_flag(
      "--flat-base", a.options.flat_base,
      "rule fold: new vertices stay on the facets of the garment, not on a curved surface over them");
  sub.add_option("--density", a.density, "mass of the cloth [kg/m^2]; default that of the file, else 0.15");
  add_max_weights(sub, a.max_weights);
}

}  // namespace furrow::cli
