// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/keep_verdicts.h"

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
constexpr double reserve = 0.4;

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
  return outcome.blown ? reserve * (1 - least) : may_lose(outcome, least);
}

LineFlags lines_at_rest(const TriedPlan& found, double least) {
  const LineFlags loose = loose_lines(found);
  LineFlags good(loose.size(), 0);
  if (hangs_wrong(found.outcome)) return good;
  for (std::size_t i = 0; i < good.size(); ++i)
    good[i] = std::abs(found.outcome.kept[i] - 1) <= may_lose(found.outcome, least) &&
              !is_bound(found.plan.lines[i], found.outcome) && !loose[i];
  return good;
}

LineFlags good_lines(const TriedPlan& found, double least) {
  LineFlags good = lines_at_rest(found, least);
  for (std::size_t i = 0; i < good.size(); ++i)
    good[i] = good[i] && std::abs(found.outcome.kept_gust[i] - 1) <= may_lose_in_gusts(found.outcome, least);
  return good;
}

namespace {

/// "2.55 %".
std::string share_text(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

/// How far a line came from its height in the worse of the two runs [-]; NaN: not run.
double farthest_off(const KeepOutcome& outcome, std::size_t line) {
  const double calm = std::abs(outcome.kept[line] - 1), gusts = std::abs(outcome.kept_gust[line] - 1);
  return calm > gusts ? calm : gusts;  // not a number: that of the gusts
}

/// Whether nothing but its trials speaks against a line, and it kept its height where nothing blows.
bool stands(const TriedPlan& found, std::size_t line, double least) {
  return !hangs_wrong(found.outcome) && !is_bound(found.plan.lines[line], found.outcome) &&
         !loose_lines(found)[line] && std::abs(found.outcome.kept[line] - 1) <= 1 - least;
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
  if (!stands(found, line, o.kept)) return "the fold turns into another shape";
  if (!(farthest_off(found.outcome, line) <= 1 - o.kept))
    return "it stands where nothing blows, but gusts left it " + left_at(found.outcome.kept_gust[line]) +
           "; more press on the line, a stiffer fabric, or a wider fold may hold it";
  return "it came within " + share_text(farthest_off(found.outcome, line)) +
         " of its height in this trial, but another may end farther off; a line is held for sure within " +
         share_text(may_lose(found.outcome, o.kept)) + ", and after gusts within " +
         share_text(may_lose_in_gusts(found.outcome, o.kept));
}

/// What a line is balanced at [m]: one that lies across another which the plan lowers is lowered with it.
double balanced_height(double height, const HelpedLine& line, const KeepPlan& plan) {
  const bool any =
      std::any_of(plan.lines.begin(), plan.lines.end(), [](const auto& l) { return l.height < 1; });
  return any ? height : line.drawn;
}

/// [m]; drawn: where it is not known.
double asked_height(int line, double drawn, const KeepOptions& o) {
  const double asked = std::size_t(line) < o.line_heights.size() ? o.line_heights[line] : NAN;
  return std::isfinite(asked) && asked != 0 ? asked : drawn;
}

Verdict verdict_of(const HelpedLine& line, const KeepOptions& o) {
  return struts_of(line, o) > 0 ? Verdict::strutted : line.step > 0 ? Verdict::pressed : Verdict::held;
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
    v.height = balanced_height(heights[i], line, found.plan);
    v.lowered = v.height / asked_height(line.id, line.drawn, o);
    v.kept = found.outcome.kept[i];
    v.kept_gust = found.outcome.kept_gust[i];
    const bool as_asked = v.lowered >= o.kept;
    if (good[i]) {
      v.verdict = as_asked ? verdict_of(line, o) : Verdict::lowered;
      continue;
    }
    v.reason = why_not(interrupted, found, i, o);
    if (interrupted) {
      v.verdict = Verdict::not_known;
      continue;
    }
    if (stands(found, i, o.kept)) v.verdict = Verdict::may_hold;
    if (!as_asked) v.reason = share_text(v.lowered) + " of the height asked is left, and " + v.reason;
  }
  return kept;
}

KeptLine unmeasured_line(int id) {
  KeptLine line;
  line.line = id;
  line.height = line.lowered = line.kept = line.kept_gust = NAN;
  line.reason =
      "its height cannot be measured: its fold leaves too little cloth around it, or runs along a border";
  return line;
}

KeptLine too_low_line(const LineMeter::TooLow& low, const KeepOptions& o) {
  KeptLine line;
  line.line = low.line;
  line.height = low.height;
  line.lowered = low.height / asked_height(low.line, low.height, o);
  line.kept = line.kept_gust = NAN;
  line.reason = "its height of " + geometry::length_text(std::abs(low.height)) + " is less than " +
                geometry::length_text(low.least) +
                ", the least that can be tried on this mesh; draw it higher";
  return line;
}

}  // namespace furrow::bridge
