// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <list>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "geometry/fold/fold_clusters.h"
#include "geometry/fold/wrinkle.h"

namespace furrow::geometry {

/// A garment with some of its clusters folded.
struct FoldProgress {
  Mesh mesh;
  WrinkleReport report;               ///< sums over them, but for `lines`
  std::map<int, WrinkledLine> lines;  ///< by id
  std::vector<Point> displaced;       ///< by vertex, before smoothing
};

/// What FoldMemory remembers by: equal for equal bits alone.
std::string bits_of(const Mesh& mesh);
std::string bits_of(const WrinkleOptions& options);
std::string bits_of(const FoldCluster& cluster, std::span<const Stroke> strokes, int first_line);

/// Garments folded up to some cluster; of one garment and its options, those used last. Several threads may
/// share one.
class FoldMemory {
 public:
  /// What is remembered of the most clusters, from the first one on; returns of how many. `garment` and
  /// `clusters` are bits; all that is remembered of another garment is forgotten.
  std::size_t recall(const std::string& garment, std::span<const std::string> clusters,
                     FoldProgress& progress);
  void remember(const std::string& garment, std::span<const std::string> clusters,
                const FoldProgress& progress);
  /// Clusters that were folded, and not recalled, since this was made.
  std::size_t folded() const;

 private:
  struct Prefix {
    std::vector<std::string> clusters;
    FoldProgress progress;
  };
  mutable std::mutex mutex_;
  std::string garment_;
  std::list<Prefix> prefixes_;  ///< used last first
  std::size_t folded_ = 0;
};

}  // namespace furrow::geometry
