// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/hold_lines.h"

#include <algorithm>

#include "bridge/keeping/keep_verdicts.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {
namespace {

/// Raises the press of lines that give way, and of all soft ones where nothing carries the garment, or where
/// lines that were pressed let others go; whether there were any.
bool press_loose(const TriedPlan& tried, bool first, const KeepOptions& o, std::vector<double>& presses) {
  const LineFlags loose = loose_lines(tried);
  const bool any = std::any_of(loose.begin(), loose.end(), [](char flag) { return flag != 0; });
  const bool all = hangs_wrong(tried.outcome) || (any && !first);
  bool raised = false;
  for (std::size_t i = 0; i < loose.size(); ++i) {
    double& press = presses[std::size_t(tried.plan.lines[i].id)];
    const auto next = next_press(press, o);
    if (!next || !(loose[i] || (all && press < o.presses.front()))) continue;
    press = *next;
    raised = true;
  }
  return raised;
}

}  // namespace

std::optional<double> next_press(double press, const KeepOptions& o) {
  const auto next = std::upper_bound(o.presses.begin(), o.presses.end(), press);
  return next == o.presses.end() ? std::nullopt : std::optional(*next);
}

HeldLines hold_lines(const geometry::Mesh& mesh, const PressedCloth& make, const KeepOptions& options) {
  KeepOptions o = options;
  require_legal(o);
  physics::StiffnessWork work;
  o.bounds.gravity = o.run.gravity;
  o.bounds.work = &work;
  HeldLines held{make(o.line_presses), {}, o.line_presses};
  LineMeter meter(mesh, {}, o.line_widths, o.flat_lines);
  const KeepPlan plan{helped_lines(mesh, held.cloth.particles, meter, o)};
  for (const HelpedLine& line : plan.lines)
    held.presses.resize(std::max(held.presses.size(), std::size_t(line.id) + 1), 1);
  for (bool first = true;; first = false) {
    TriedPlan tried{
        plan, {.cloth = std::move(held.cloth), .shape = {}, .rest_press = 1, .kept = {}, .kept_gust = {}}};
    tried.outcome.shape = keep_shape(tried.outcome.cloth, {}, o.bounds, o.largest_turn, false);
    const bool again = press_loose(tried, first, o, held.presses);
    held.cloth = again ? make(held.presses) : std::move(tried.outcome.cloth);
    held.shape = std::move(tried.outcome.shape);
    if (!again) return held;
  }
}

}  // namespace furrow::bridge
