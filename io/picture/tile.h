// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "io/picture/eye.h"
#include "io/picture/shade.h"

namespace furrow::io {

/// A part of the picture, made for as few rays as it can be. One line of sight runs through each corner of a
/// pixel. Where the four corners look alike and no border runs between them, the pixel is their mean;
/// elsewhere it takes side × side lines of sight of its own. The shares of light that arrive are found at
/// every eighth corner. Halfway between, and halfway again, they are the mean of those around, where these
/// lie on one smooth surface and agree; elsewhere they are found by rays, too. No number is random, and no
/// tile depends on another.
class Tile {
 public:
  static constexpr int pixels = 64;  ///< of its sides, unless the picture ends before

  /// Keeps references to the first two. `side`: of the lines of sight through an edge's pixel.
  Tile(const Eye& eye, const Shader& shader, int side, int column, int row);

  /// Linear light of a pixel, counted from the picture's corner; none: nothing but the background.
  std::optional<Eigen::Vector3d> pixel(int column, int row, const Eigen::Vector3d& background) const;

 private:
  struct Place {
    Look look;
    LightShares shares;
    std::optional<Eigen::Vector3d> light;
  };
  static std::optional<LightShares> mean_shares(const Seen& seen, const std::array<const Place*, 4>& around);
  static const Place* nearest(const Seen& seen, std::span<const Place* const> known);
  const Place& corner(int i, int j) const { return corners_[std::size_t(j) * (pixels + 1) + i]; }
  Place& corner(int i, int j) { return corners_[std::size_t(j) * (pixels + 1) + i]; }
  void light_corner(int i, int j, int spacing);
  Eigen::Vector3d many(int i, int j, const Eigen::Vector3d& background) const;

  const Eye& eye_;
  const Shader& shader_;
  int side_, column_, row_;
  std::vector<Place> corners_;
};

}  // namespace furrow::io
