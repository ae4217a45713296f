// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/card.h"
#include "jobs/base/max_weights.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/mesh/smooth.h"

namespace furrow::jobs {
namespace {

/// What the rest state learns of lines; keep: the drawn shape bears its weight. With settle, that is the
/// default, and what else is asked for falls as it will.
Choice rest_choice(WrinkleJob& job) {
  using geometry::RestRule;
  Choice rule = choice(job.options.rest, {{"drawn", RestRule::drawn},
                                          {"copied", RestRule::copied},
                                          {"flat", RestRule::flat},
                                          {"keep", RestRule::drawn}});
  rule.set = [&job, set = rule.set](std::size_t i) {
    set(i);
    job.keep.reset();
    job.hold = i == 3;
    if (job.hold) job.keep.emplace();
  };
  rule.usual = rule.words[0];
  return rule;
}

Flag settle_flag(WrinkleJob& job) {
  return {[&job](bool is_on) {
    job.settle.reset();
    if (is_on) job.settle.emplace();
  }};
}

void append(std::vector<CardRow>& rows, const std::vector<CardRow>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace

std::vector<CardRow> drawing_card(WrinkleJob& job) {
  using enum Group;
  using enum Audience;
  using namespace geometry;
  WrinkleOptions& o = job.options;
  std::vector<CardRow> rows = {
      {"height", lines, everyone, &job.height, "of strokes that name none [m]; > 0 ridge, < 0 valley"},
      {"width", lines, everyone, &job.width, positive,
       "of the fold of strokes that name none [m] (default: some five heights; by the rules safe and paper "
       "as smoothing makes it)"},
      {"rule", lines, everyone,
       choice(
           o.insertion.rule,
           {{"fold", InsertionRule::fold}, {"safe", InsertionRule::safe}, {"paper", InsertionRule::paper}}),
       "fold: smooth folds on a mesh refined around them; safe: the paper's chain of vertices, without flips "
       "that would spoil the mesh; paper: the paper's plain rule"},
      {"rest", lines, everyone, rest_choice(job),
       "drawn: a line adds cloth, rest angles stay; copied: they turn, too; flat: the rest stays as it was; "
       "keep, the default with `settle`: the drawn shape bears its weight (needs `fabric` or hinges; "
       "docs/keep.md)"},
      {"max_distance", lines, few, &o.insertion.max_distance, positive,
       "how far a stroke may lie from the surface [m]"},
      {"region", lines, few,
       choice(o.region,
              {{"two-ring", SmoothingRegion::two_ring}, {"whole-mesh", SmoothingRegion::whole_mesh}}),
       "what is smoothed; two-ring: around the lines"},
      {"detail", lines, few,
       choice(o.detail, {{"coarse", Detail::coarse}, {"normal", Detail::normal}, {"fine", Detail::fine}}),
       "rule fold: how fine the mesh around folds becomes"},
      {"fold_iterations", lines, few, &o.fold_iterations, between(0, 100000),
       "rule fold: pairs of smoothing steps after the folds are raised"},
      {"flat_base", lines, few, &o.flat_base,
       "rule fold: new vertices stay on the facets of the garment, not on a curved surface over them"},
      {"density", lines, few, &job.density, positive,
       "mass of the cloth [kg/m^2]; default that of the file, else 0.15"},
      max_weights_row(job.max_weights, lines, few),
  };
  append(rows, smoothing_card(o.smoothing, lines, few));
  return rows;
}

std::vector<CardRow> card(WrinkleJob& job) {
  using enum Group;
  using enum Audience;
  std::vector<CardRow> rows = {
      {"state", lines, everyone, &job.state_path,
       "draw into a simulation that was stopped, then without a garment; `output` is a state, too"},
      {"without", lines, everyone, &job.without, "leave out the strokes of these names"},
      {"fade", lines, few, &job.fade, endless,
       "with `state`: how slowly the forces of the new lines set in [s]"},
      {"output", output, everyone, &job.output, "mesh to write; PLY keeps rest lengths, masses and lines"},
      {"inserted", output, few, &job.inserted, "also write the mesh after insertion and before smoothing"},
      {"smoothed", output, few, &job.smoothed, "with `settle`: also write the garment as drawn"},
      {"settle", rest, everyone, settle_flag(job),
       "let what is drawn come to rest on `body`, on pins or on both, in `fabric` (cotton), as `furrow "
       "drape` does, with lines that last: what gives way is pressed (`rest=drawn`: as it falls)"},
      {"subdivide", rest, everyone, OrAuto{&job.subdivide}, between(0, 4),
       "with `settle`: refine the garment so many times (Loop) before, 0 to 4; auto (the default): as the "
       "gap needs"},
      {"budget", rest, everyone, &job.budget, endless,
       "with `settle`: processor time after which the best state so far is the end, which is no success [s]"},
      {"made_for", rest, few, &job.made_for,
       "with `settle`: body that the garment was made for and lies about: brought from there to `body`, as "
       "drape does"},
  };
  append(rows, drawing_card(job));
  return rows;
}

}  // namespace furrow::jobs
