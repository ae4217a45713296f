// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/refine/transfer_shape.h"
#include "jobs/base/ends.h"

namespace furrow::jobs {

/// The shape of a wrinkled mesh, to be brought back to the mesh it was made of.
struct TransferJob {
  MeshInput original, wrinkled;
  std::optional<MeshInput> rest;       ///< the wrinkled mesh before lines and motion, if it does not know
  std::optional<MeshInput> body = {};  ///< that it is worn on: where it comes through is reported
  Frame frame = {};                    ///< of the files read and written
  geometry::TransferOptions options = {};
  std::filesystem::path output;  ///< mesh to write; empty or "-": none
};

/// What jobs::transfer() did.
struct TransferReport {
  geometry::TransferReport moved;
  io::MeshFile result;                  ///< the original in its new shape [m], y up
  ClothCrossings crossings;             ///< of the cloth with itself
  EndFacts end;                         ///< with what the body does, where one was given
  std::optional<std::string> obj_text;  ///< from OBJ to OBJ: the file's text with other positions
  Frame frame;                          ///< of the file written
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(TransferJob& job);

/// Moves the original's vertices as geometry::transfer_shape() does and writes it, whole or not at all. From
/// OBJ to OBJ all but the coordinates is copied as it stands. Throws physics::Cancelled, nothing written, if
/// the listener cancels; std::invalid_argument for outputs that would replace an input,
/// geometry::ContentError for files that cannot be used. Cost: a closest point for each vertex.
TransferReport transfer(const TransferJob& job, Listener& listener);

/// The report for programs, and what the command line prints, without the name of the file written.
Json to_json(const TransferReport& report);

}  // namespace furrow::jobs
