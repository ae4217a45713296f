// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bridge/draping/fit_report.h"
#include "jobs/base/ends.h"

namespace furrow::jobs {

/// What a garment is coloured by.
enum class FitColour { strain, distance };

/// Worn garments, to be measured on the bodies that wear them.
struct FitJob {
  std::vector<MeshInput> worn;
  std::vector<MeshInput> bodies;              ///< one, or one for each garment
  std::optional<MeshInput> rest;              ///< a single garment as it was made, with the same vertices
  Frame frame = {};                           ///< of the files read and written
  std::optional<std::string> body_unit = {};  ///< of the bodies' files; none: the frame's
  bridge::FitOptions options = {};
  std::optional<double> contact;    ///< cloth nearer lies on the body [m]; none: by the gap that it kept
  std::optional<FitColour> colour;  ///< none: strain where all garments know theirs
  std::optional<double> range;      ///< where the colours end: strain [-] or distance [m]; > 0
  std::filesystem::path output;     ///< of a single garment, with colours; empty or "-": not written
  std::vector<std::string> more_outputs = {};  ///< files that the caller writes: none may replace another
  std::vector<std::string> more_inputs = {};   ///< files that the caller reads: none may be replaced
};

/// A garment that was measured.
struct FittedGarment {
  std::string path, name;  ///< of its file, and without folder and ending
  io::MeshFile garment;    ///< coloured, with the columns fit_distance [m] and strain [-]
  bridge::FitReport report;
  bridge::FitOptions options;
  ClothCrossings crossings;  ///< of the cloth with itself
};

/// What jobs::fit() found.
struct FitJobReport {
  std::vector<FittedGarment> garments;
  FitColour shown = FitColour::strain;
  Frame frame;  ///< of the file written
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(FitJob& job);

/// Measures strain, distance and ease (bridge/draping/fit_report.h) and colours the garments. Throws
/// physics::Cancelled, nothing written, if the listener cancels; std::invalid_argument for a job that cannot
/// be, geometry::ContentError for files that cannot be used. Cost: two closest points for each vertex.
FitJobReport fit(const FitJob& job, Listener& listener);

/// The report for programs, and what the command line prints, without the names of the files written.
Json to_json(const FitJobReport& report);
/// All numbers of one garment, SI units; what is not known is null.
Json to_json(const bridge::FitReport& report, const bridge::FitOptions& options);

}  // namespace furrow::jobs
