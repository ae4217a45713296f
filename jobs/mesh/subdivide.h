// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/insert/insertion.h"
#include "geometry/rest/rest_state.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// How a mesh is refined.
enum class Refinement {
  strokes,     ///< lines are inserted along them; the shape stays
  everywhere,  ///< a vertex in every face, every edge flipped; the shape stays
  loop,
  sqrt3,
  linear  ///< every triangle into four; the surface stays
};

/// A mesh, to be refined.
struct SubdivideJob {
  MeshInput mesh;
  Refinement refinement = Refinement::loop;
  int steps = 1;  ///< of loop, sqrt3, linear; in [0, 6]
  std::variant<std::filesystem::path, std::vector<io::DrawnStroke>> strokes =
      {};                                   ///< [m], y up, or their file
  Frame frame = {};                         ///< of the files read and written
  geometry::InsertionOptions options = {};  ///< of strokes and everywhere
  std::optional<int> max_weights = {};  ///< skin weights that a vertex keeps, 0: all; none: as interpolated
  std::filesystem::path output = {};    ///< empty or "-": not written
};

/// What jobs::subdivide() did.
struct SubdivideReport {
  io::MeshFile mesh;                                   ///< [m], y up
  std::optional<geometry::InsertionReport> insertion;  ///< of strokes and everywhere
  std::optional<geometry::RestMetricAudit> rest;       ///< after it
  Frame frame;                                         ///< of the file written
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(SubdivideJob& job);

/// Refines the mesh and writes it, whole or not at all. Throws physics::Cancelled, nothing written, if the
/// listener cancels; std::invalid_argument for an option and for an output that would replace the strokes,
/// geometry::ContentError for files that cannot be used.
SubdivideReport subdivide(const SubdivideJob& job, Listener& listener);

/// The report for programs, and what the command line prints, without the name of the file written.
Json to_json(const SubdivideReport& report);

}  // namespace furrow::jobs
