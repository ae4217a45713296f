// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "bridge/keeping/keep.h"
#include "physics/base/require.h"

namespace furrow::bridge {

void require_legal(const KeepOptions& o) {
  const auto need = [](bool good, const char* what, double value) {
    if (!good || !std::isfinite(value)) physics::refuse("keep_lines", what, " = ", std::to_string(value));
  };
  need(o.seconds > 0, "seconds", o.seconds);
  need(o.gust >= 0, "gust", o.gust);
  need(o.gust_seconds > 0, "gust_seconds", o.gust_seconds);
  need(o.calm_seconds > 0, "calm_seconds", o.calm_seconds);
  need(o.pushes >= 1, "pushes", o.pushes);
  need(o.push > 0, "push", o.push);
  need(o.kept > 0 && o.kept < 1, "kept", o.kept);
  need(o.largest_turn >= 0, "largest_turn", o.largest_turn);
  need(o.least_height >= 0, "least_height", o.least_height);
  need(o.height_trials >= 0, "height_trials", o.height_trials);
  double last = 1;
  for (const double factor : o.presses)
    need(factor > last, "presses do not rise above 1", factor), last = factor;
  for (const double k : o.struts) need(k > 0, "struts", k);
}

}  // namespace furrow::bridge
