// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "geometry/figure/shape_body.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// A body that is to get a person's measurements.
struct BodyJob {
  MeshInput mesh;
  Frame frame = {};                 ///< of the files read and written
  geometry::BodyMeasures measures;  ///< [m]; none: the body is measured, and nothing is changed
  std::filesystem::path output;     ///< empty or "-": not written
};
struct BodyReport {
  io::MeshFile mesh;  ///< [m], y up
  geometry::BodyMeasures asked;
  geometry::ShapeReport shape;
  int new_crossings = 0;  ///< pairs of faces that cross and did not before
  Frame frame;            ///< of the file written

  /// Whether each girth and the height are within 5 mm of what was asked for, and nothing crosses anew.
  bool succeeds() const { return shape.farthest <= 0.005 && new_crossings <= 0; }
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(BodyJob& job);

/// Shapes a body as geometry::shape_body() does, and writes it, whole or not at all. Throws
/// physics::Cancelled, nothing written, if the listener cancels; std::invalid_argument for measurements out
/// of their range, geometry::ContentError for files that cannot be used, and a body without a torso.
BodyReport shape_body(const BodyJob& job, Listener& listener);

Json to_json(const BodyReport& report);

}  // namespace furrow::jobs
