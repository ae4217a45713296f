// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/quality/fold_quality.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"
#include "jobs/draw/drawn_round.h"

namespace furrow::jobs {

/// A mesh to be measured for how well it is folded.
struct QualityJob {
  MeshInput mesh;
  std::optional<StrokeInput> strokes;  ///< none: those that the mesh notes, or the lines that it carries
  std::optional<MeshInput> base;       ///< the garment before its folds; none: what the mesh tells of it
  Frame frame = {};
  double height = io::SceneLines{}.height;     ///< of strokes that name none [m]
  std::optional<double> width;                 ///< of strokes that name none [m]; none: as rule fold chooses
  std::optional<double> max_distance;          ///< of strokes from the base [m]; none: as noted, else 0.05
  std::vector<std::string> more_outputs = {};  ///< files that the caller writes: none may replace another
};

/// One of the measures with its target. No target: neither bound.
struct QualityMeasure {
  std::string name;             ///< stable: "crest_ripple", …
  std::string id;               ///< "B1" to "B9"
  std::optional<double> value;  ///< of lines the worst; none: `why`
  std::optional<double> at_most, at_least;
  std::string line;  ///< whose it is; "": of the whole mesh
  std::string why;   ///< it could not be measured, or not be judged
  bool met() const { return !value || !((at_most && *value > *at_most) || (at_least && *value < *at_least)); }
};

/// A vertex where the cloth is knobbly.
struct Knob {
  geometry::Point place{0, 0, 0};
  double defect = 0;  ///< angle defect over a third of the area around [rad/m^2]; > 0 dome, < 0 saddle
};

/// What jobs::quality() found.
struct QualityReport {
  io::MeshFile mesh;  ///< as it was read [m], y up
  geometry::MeshQuality whole;
  std::optional<geometry::MeshQuality> before;  ///< of the garment before its folds, where that is known
  std::string base_from;   ///< "file", "garment" (that the mesh notes), "rest_positions" or "none"
  std::string lines_from;  ///< "file", "record" (strokes that the mesh notes), "mesh" (its chains) or "none"
  std::vector<geometry::LineQuality> lines;
  std::vector<QualityMeasure> measures;  ///< B1 to B9
  std::vector<double> defects;           ///< as Knob::defect, by vertex; 0 on borders
  std::vector<Knob> knobs;               ///< the worst, at most ten, at least 2 cm apart
  bool met() const;
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(QualityJob& job);

/// Measures crest, sections and normals of the lines over the surface before them, and knobs, thin faces,
/// hems and vertices of the whole mesh (geometry/quality/fold_quality.h), each beside its target. Throws
/// physics::Cancelled if the listener cancels; std::invalid_argument for an output that would replace an
/// input, geometry::ContentError for files or strokes that cannot be used. Cost: two closest points for each
/// vertex, and O(sections) for each line: a second for 20,000 vertices and ten lines.
QualityReport quality(const QualityJob& job, Listener& listener);

/// The report for programs, and what the command line prints.
Json to_json(const QualityReport& report);

}  // namespace furrow::jobs
