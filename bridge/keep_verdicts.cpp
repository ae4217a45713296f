// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keep_verdicts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "geometry/mesh/measures.h"

namespace furrow::bridge {
namespace {

constexpr double share_of_mode = 0.1;  // of an unstable motion's energy that makes it a line's
constexpr double out_of_balance = 1e-6;
// Of what a line may lose or win: where the shape is not stable, and after gusts.
constexpr double reserve = 0.4, reserve_in_gusts = 0.5;

bool holds(const KeepOutcome& outcome, std::size_t line, double least) {
  return std::abs(outcome.kept[line] - 1) <= may_lose(outcome, least) &&
         std::abs(outcome.kept_gust[line] - 1) <= may_lose_in_gusts(outcome, least);
}

}  // namespace

std::vector<double> loose_shares(const TriedPlan& found) {
  const physics::Certificate& certificate = found.outcome.shape.certificate;
  if (certificate.stable()) return std::vector<double>(found.plan.lines.size() + 1, 0.0);
  return shares_of(found.plan.lines, found.outcome.cloth.particles, certificate.mode);
}

LineFlags loose_lines(const TriedPlan& found) {
  const std::vector<double> shares = loose_shares(found);
  LineFlags loose(found.plan.lines.size());
  for (std::size_t i = 0; i < loose.size(); ++i) loose[i] = shares[i] > share_of_mode;
  return loose;
}

bool rest_is_loose(const TriedPlan& found) { return loose_shares(found).back() > share_of_mode; }

bool hangs_wrong(const KeepOutcome& outcome) {
  return outcome.shape.rest.residual > out_of_balance && !outcome.shape.rest.imbalance.empty();
}

bool is_bound(const HelpedLine& line, const KeepOutcome& outcome) {
  return outcome.shape.rest.residual > out_of_balance && on_bounds(line, outcome.shape.rest, outcome.cloth);
}

double may_lose(const KeepOutcome& outcome, double least) {
  return (outcome.shape.certificate.stable() ? 1 : reserve) * (1 - least);
}

double may_lose_in_gusts(const KeepOutcome& outcome, double least) {
  return std::min(may_lose(outcome, least), reserve_in_gusts * (1 - least));
}

LineFlags good_lines(const TriedPlan& found, double least) {
  const LineFlags loose = loose_lines(found);
  LineFlags good(loose.size(), 0);
  if (hangs_wrong(found.outcome)) return good;
  for (std::size_t i = 0; i < good.size(); ++i)
    good[i] = holds(found.outcome, i, least) && !is_bound(found.plan.lines[i], found.outcome) && !loose[i];
  return good;
}

bool may_be_judged(const TriedPlan& found, std::size_t line) {
  return !hangs_wrong(found.outcome) && !is_bound(found.plan.lines[line], found.outcome) &&
         !loose_lines(found)[line];
}

namespace {

/// "2.5 %".
std::string share_text(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
  return text;
}

/// How far a line came from its height in the worse of the two runs [-]; NaN: not run.
double farthest_off(const KeepOutcome& outcome, std::size_t line) {
  const double calm = std::abs(outcome.kept[line] - 1), gusts = std::abs(outcome.kept_gust[line] - 1);
  return calm > gusts ? calm : gusts;  // not a number: that of the gusts
}

/// Not held for sure: it kept its height here, and nothing but chance speaks against it.
bool nearly_held(const TriedPlan& found, std::size_t line, const KeepOptions& o) {
  return may_be_judged(found, line) && std::isfinite(found.outcome.kept[line]) &&
         farthest_off(found.outcome, line) <= 1 - o.kept;
}

/// It kept its height, and after gusts of the strength that was asked for, but not after stronger ones.
bool stands_named_gusts(const TriedPlan& found, std::size_t line, const KeepOptions& o) {
  const KeepOutcome& outcome = found.outcome;
  return may_be_judged(found, line) && !outcome.kept_named.empty() &&
         std::abs(outcome.kept[line] - 1) <= 1 - o.kept &&
         std::abs(outcome.kept_named[line] - 1) <= 1 - o.kept;
}

/// "at 81 % of its height"; nothing is left to measure where a share is not finite.
std::string left_at(double share) {
  if (!std::isfinite(share)) return "with no height to measure";
  return "at " + std::to_string(std::lround(100 * share)) + " % of its height";
}

std::string why_not(bool interrupted, const TriedPlan& found, std::size_t line, const KeepOptions& o) {
  if (interrupted) return "interrupted";
  if (hangs_wrong(found.outcome)) return "nothing holds the garment in balance as it lies; see imbalance";
  if (is_bound(found.plan.lines[line], found.outcome))
    return "the bounds on strain and angle leave no balance";
  if (loose_lines(found)[line])
    return "the fold can give way without effort: the cloth bends too easily for it";
  if (nearly_held(found, line, o))
    return "it came within " + share_text(farthest_off(found.outcome, line)) +
           " of its height in this trial, but another may end farther off; a line is held for sure within " +
           share_text(may_lose(found.outcome, o.kept)) + ", and after gusts within " +
           share_text(may_lose_in_gusts(found.outcome, o.kept));
  if (stands_named_gusts(found, line, o))
    return "it stood gusts of the strength that was asked for, but stronger ones, which make up for what the "
           "steps damp, left it " +
           left_at(found.outcome.kept_gust[line]);
  return "the fold turns into another shape";
}

/// Of a height as drawn, what is left: a line that lies across one which the plan lowers is lowered with it.
double lowered_to(double height, const HelpedLine& line, const KeepPlan& plan) {
  const bool any =
      std::any_of(plan.lines.begin(), plan.lines.end(), [](const auto& l) { return l.height < 1; });
  return any ? height / line.drawn : 1;
}

}  // namespace

std::vector<KeptLine> verdicts(const TriedPlan& found, const std::vector<double>& heights,
                               const KeepOptions& o, bool interrupted) {
  const LineFlags good = good_lines(found, o.kept);
  std::vector<KeptLine> kept;
  for (std::size_t i = 0; i < good.size(); ++i) {
    const HelpedLine& line = found.plan.lines[i];
    KeptLine& v = kept.emplace_back();
    v.line = line.id;
    v.press = line.press * press_of(line, o);
    v.struts = struts_of(line, o);
    v.lowered = lowered_to(heights[i], line, found.plan);
    v.height = v.lowered * line.drawn;
    v.kept = found.outcome.kept[i];
    v.kept_gust = found.outcome.kept_gust[i];
    if (!good[i]) {
      v.reason = why_not(interrupted, found, i, o);
      if (!interrupted && (nearly_held(found, i, o) || stands_named_gusts(found, i, o)))
        v.verdict = Verdict::may_hold;
      continue;
    }
    v.verdict = line.height < 1 || std::abs(v.lowered - 1) > 1 - o.kept ? Verdict::lowered
                : v.struts > 0                                          ? Verdict::strutted
                : line.step > 0                                         ? Verdict::pressed
                                                                        : Verdict::held;
  }
  return kept;
}

KeptLine unmeasured_line(int id) {
  KeptLine line;
  line.line = id;
  line.height = line.kept = line.kept_gust = NAN;
  line.reason =
      "its height cannot be measured: its fold leaves too little cloth around it, or runs along a border";
  return line;
}

KeptLine too_low_line(const LineMeter::TooLow& low) {
  KeptLine line;
  line.line = low.line;
  line.height = low.height;
  line.kept = line.kept_gust = NAN;
  line.reason = "its height of " + geometry::length_text(std::abs(low.height)) + " is less than " +
                geometry::length_text(low.least) +
                ", the least that can be tried on this mesh; draw it higher";
  return line;
}

}  // namespace furrow::bridge
