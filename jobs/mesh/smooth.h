// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "geometry/fold/taubin_smooth.h"
#include "jobs/base/card.h"

namespace furrow::jobs {

/// A whole mesh, to be smoothed without shrinking.
struct SmoothJob {
  MeshInput mesh;
  Frame frame = {};  ///< of the files read and written
  geometry::TaubinOptions options = {};
  std::filesystem::path output;  ///< empty or "-": not written
};

/// What jobs::smooth() did.
struct SmoothReport {
  io::MeshFile mesh;  ///< [m], y up
  int iterations = 0;
  Frame frame;  ///< of the file written
};

/// Their options, each bound to its field (jobs/base/card.h); the second: those of smoothing, for the jobs
/// that smooth.
std::vector<CardRow> card(SmoothJob& job);
std::vector<CardRow> smoothing_card(geometry::TaubinOptions& options, Group group = {},
                                    Audience audience = {});

/// Smooths as geometry::taubin_smooth() does and writes the mesh, whole or not at all. Throws
/// physics::Cancelled, nothing written, if the listener cancels; std::invalid_argument for an option,
/// geometry::ContentError for files that cannot be used.
SmoothReport smooth(const SmoothJob& job, Listener& listener);

/// The report for programs, and what the command line prints, without the name of the file written.
Json to_json(const SmoothReport& report);

}  // namespace furrow::jobs
