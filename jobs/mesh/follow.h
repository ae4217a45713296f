// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// A garment that is to follow the shape keys of the body that it fits.
struct FollowJob {
  MeshInput garment, body;
  std::vector<MeshInput> body_keys =
      {};  ///< the body in other shapes, its vertices the same: each is a key more
  std::vector<std::string> keys = {};  ///< the body's keys to follow; none: all
  double gap = 0.003;                  ///< that is kept from the body, where the garment kept it [m]; >= 0
  double poke = 0.001;                 ///< depth from which two keys together get a corrective key [m]; > 0
  int mixes = 200;                     ///< random mixtures of keys that are tried at the end, in [0, 10000]
  Frame frame = {};                    ///< of the files read and written
  std::filesystem::path output;        ///< glb, vrm or ply; empty or "-": not written
};

/// A key that the garment has got.
struct FollowedKey {
  std::string
      name;  ///< the body's; of a corrective one "A*B", to be shown as far as both together (their product)
  std::size_t vertices = 0;                   ///< that it moves by 0.1 mm or more
  double farthest = 0;                        ///< [m]
  double poke_at_half = 0, poke_at_full = 0;  ///< how much deeper it then lies in the body than without [m]
};

/// What jobs::follow() did.
struct FollowReport {
  io::MeshFile garment;  ///< with a key for each of the body's, and correctives
  std::vector<FollowedKey> keys, correctives;
  std::vector<double>
      mixes;    ///< of each how much deeper the garment lies in the body, at the worst place [m]; ascending
  Frame frame;  ///< of the file written
  double mixes_at(double share) const;  ///< that so many of them do not exceed [m]
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(FollowJob& job);

/// Gives the garment a shape key for each of the body's, under its name, so that it goes along
/// (bridge/draping/follow_body.h), and for pairs of keys that come through together a corrective one; then
/// tries mixtures, each key anywhere from 0 to 1. Keys of the garment's own of these names are replaced.
/// Throws std::invalid_argument for a job that cannot be, geometry::ContentError for files that cannot be
/// used, and physics::Cancelled, nothing written. Cost: about a tenth of a second a key, a pair and a
/// mixture, for a body of 30,000 triangles.
FollowReport follow(const FollowJob& job, Listener& listener);

/// The report for programs, and what the command line prints, without the name of the file written.
Json to_json(const FollowReport& report);

}  // namespace furrow::jobs
