// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "jobs/base/ailment.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// A mesh to be examined, as a garment or, where `is_body`, as a body; and mended, if asked.
struct DoctorJob {
  MeshInput mesh;
  std::optional<MeshInput> body;         ///< that a garment goes with
  std::optional<std::string> body_unit;  ///< of the body's file: "m", "cm", "mm" or "inch"; none: the frame's
  Frame frame = {};
  bool is_body = false;
  bool repair = false;
  std::filesystem::path output;                ///< of the mended mesh; empty or "-": not written
  std::vector<std::string> more_outputs = {};  ///< files that the caller writes: none may replace another
};

/// What jobs::doctor() found.
struct DoctorReport {
  std::vector<Ailment> found;  ///< of the mesh, then of the pair
  std::vector<Ailment> left;   ///< after repair, of the mesh alone; empty without it
  bool repaired = false;
  io::MeshFile mesh;  ///< as it was read, or mended [m], y up
  Frame frame;        ///< of the file written
  bool well() const { return (repaired ? left : found).empty(); }
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(DoctorJob& job);

/// Examines a mesh: what is wrong, where, and what mends it; the same checks come before every job. With
/// `repair` the mesh is mended: vertices at exactly the same place are joined, and seams that lie open by a
/// rounding (geometry/figure/border_seams.h); faces that are there twice are dropped, neighbours wound alike,
/// what is not manifold is parted, and holes are closed: small ones of a garment, all of a body. Texture,
/// groups and materials stay; what vertices had, rest lengths among it, stays where nothing is joined. Throws
/// physics::Cancelled if the listener cancels; std::invalid_argument for an output that would replace an
/// input, geometry::ContentError for files that cannot be read. O(F log F).
DoctorReport doctor(const DoctorJob& job, Listener& listener);

/// The report for programs, and what the command line prints.
Json to_json(const DoctorReport& report);

}  // namespace furrow::jobs
