// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/fold/taubin_smooth.h"
#include "python/keywords.h"

namespace furrow::python {

/// Keywords of smoothing, for the jobs that smooth; `at` returns the job's options.
template <class Job, class At>
Keywords<Job> smoothing_rows(At at) {
  using namespace geometry;
  const auto keep = [at](const char* name, const char* help, auto set) {
    return own<Job>(name, "bool", help, [at, set](const Value& v, Job& job) {
      bool on = false;
      take(v, on);
      set(at(job), on);
    });
  };
  return {
      row<Job>(
          "iterations", "pairs of smoothing steps, in [0, 100000]; default 10",
          [at](Job & j) -> auto& { return at(j).iterations; }),
      row<Job>(
          "lambda_",
          "factor of the shrinking step, > 0; default 0.33", [at](Job & j) -> auto& { return at(j).lambda; }),
      row<Job>(
          "mu", "factor of the inflating step, < -lambda_; default -0.34",
          [at](Job & j) -> auto& { return at(j).mu; }),
      choice<Job, SmoothingWeights>(
          "weights", "default \"uniform\"; \"cotangent\": of the shape before smoothing",
          {{"uniform", SmoothingWeights::uniform}, {"cotangent", SmoothingWeights::cotangent}},
          [at](Job & j) -> auto& { return at(j).weights; }),
      keep("keep_lines", "smooth the vertices of a line among themselves only",
           [](TaubinOptions& o, bool on) { o.lines = on ? LineRule::keep : LineRule::free; }),
      keep("keep_border", "smooth the border as a curve of its own",
           [](TaubinOptions& o, bool on) { o.border = on ? BorderRule::keep : BorderRule::free; }),
  };
}

}  // namespace furrow::python
