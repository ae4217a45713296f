// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <span>
#include <string>

#include "io/animation/animation_file.h"

/// The formats behind AnimationWriter, one source for each. A file is head(), frame(0) … frame(frames - 1),
/// tail().
namespace furrow::io {

class AnimationEncoder {
 public:
  virtual ~AnimationEncoder() = default;
  /// The bytes of frame `index`. Called for 0, 1, 2 …, and again for an index whose bytes could not be kept.
  virtual std::string frame(std::size_t index, std::span<const physics::Vec3> positions) = 0;
  virtual std::string head(std::size_t frames) const = 0;
  virtual std::string tail(std::size_t) const { return {}; }
  virtual std::size_t largest_file() const { return static_cast<std::size_t>(-1); }  ///< [bytes]
};

std::unique_ptr<AnimationEncoder> pc2_encoder(const geometry::Mesh& mesh, const AnimationOptions& options);
std::unique_ptr<AnimationEncoder> mdd_encoder(const geometry::Mesh& mesh, const AnimationOptions& options);
std::unique_ptr<AnimationEncoder> glb_encoder(const geometry::Mesh& mesh, const AnimationOptions& options);

/// The time of frame i [s].
inline double frame_time(const AnimationOptions& options, std::size_t i) {
  return options.start + static_cast<double>(i) / options.fps;
}

}  // namespace furrow::io
