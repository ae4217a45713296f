// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/wrinkle_settings.h"

#include <tuple>
#include <utility>

namespace furrow::io {

using namespace geometry;

void read_wrinkle_options(SettingsTable& table, SceneLines& lines) {
  WrinkleOptions& o = lines.options;
  std::pair rest(o.rest, false);  // and whether the shape is kept
  table.choose<std::pair<RestRule, bool>>("rest", rest,
                                          {{"drawn", {RestRule::drawn, false}},
                                           {"flat", {RestRule::flat, false}},
                                           {"copied", {RestRule::copied, false}},
                                           {"keep", {RestRule::drawn, true}}});
  std::tie(o.rest, lines.keep) = rest;
  table.choose<InsertionRule>("rule", o.insertion.rule,
                              {{"safe", InsertionRule::safe}, {"paper", InsertionRule::paper}});
  table.choose<SmoothingRegion>(
      "region", o.region,
      {{"two-ring", SmoothingRegion::two_ring}, {"whole-mesh", SmoothingRegion::whole_mesh}});
  table.read("max_distance", o.insertion.max_distance, positive("m"));
  table.read("iterations", o.smoothing.iterations, 0, 100000);
  table.read("lambda", o.smoothing.lambda, positive());
  table.read("mu", o.smoothing.mu, {-no_limit, 0});
  table.choose<SmoothingWeights>(
      "weights", o.smoothing.weights,
      {{"uniform", SmoothingWeights::uniform}, {"cotangent", SmoothingWeights::cotangent}});
  bool keep_lines = false, keep_border = false;
  table.read("keep_lines", keep_lines);
  table.read("keep_border", keep_border);
  o.smoothing.lines = keep_lines ? LineRule::keep : LineRule::free;
  o.smoothing.border = keep_border ? BorderRule::keep : BorderRule::free;
}

}  // namespace furrow::io
