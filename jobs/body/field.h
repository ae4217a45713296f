// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>

#include "jobs/body/world_body.h"

namespace furrow::jobs {

/// The signed distance field of a body, to be built; kept in the body's cache, if it has one.
struct FieldJob {
  io::SceneBody body;                    ///< its mesh and the options of the field
  Frame frame = {};                      ///< of the body's file
  std::filesystem::path slice;           ///< PNG of it in the body's middle plane; empty: none
  std::optional<physics::Vec3> at = {};  ///< where distance and gradient are reported [m]
};

/// Error of the field at points of a lattice in its band, by exact distance [m].
struct FieldErrors {
  int points = 0;
  double largest = 0, mean = 0;
};

/// What jobs::field() built.
struct FieldReport {
  BodyCollider body;
  FieldErrors errors;
  std::optional<physics::Vec3> at;
  double seconds = 0;  ///< that reading and building took [s]
};

/// Builds the field, or loads it from the body's cache, and writes the picture, if named, whole or not at
/// all. Throws physics::Cancelled, nothing written, if the listener cancels; std::invalid_argument for a
/// picture that would replace the body, geometry::ContentError for a body that cannot be used.
FieldReport field(const FieldJob& job, Listener& listener);

/// The report for programs, and what the command line prints.
Json to_json(const FieldReport& report);

}  // namespace furrow::jobs
