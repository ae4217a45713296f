// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "geometry/mesh/mesh.h"
#include "io/mesh/mesh_file.h"
#include "physics/base/particles.h"

namespace furrow::io {

/// Files that hold a moving mesh's positions; vertices as in the mesh, in single precision.
enum class AnimationFormat {
  pc2,  ///< Point Cache 2: positions only, little-endian, times in frames
  mdd,  ///< LightWave's: positions only, big-endian, times in seconds
  glb   ///< glTF 2.0: the mesh, a morph target for each frame after the first, and their weights over time
};

/// The format that a file name's ending names, in any case of letters; nothing for any other ending.
std::optional<AnimationFormat> animation_format(const std::filesystem::path& path);

enum class Interpolation { linear, step };

struct AnimationOptions {
  double fps = 25;       ///< frames a second; > 0, finite
  double start = 0;      ///< time of the first frame [s]; >= 0, finite
  WriteOptions frame{};  ///< unit and axes of PC2 and MDD: those of the mesh file they go with. glTF is
                         ///< always metres, y up
  Interpolation interpolation = Interpolation::linear;  ///< between frames; GLB only
};

/// Writes an animation frame by frame; the number of frames need not be known. Frame i has the time start + i
/// / fps. Until close() the frames lie in a file without a name beside `path`: an interrupted program leaves
/// nothing behind, and an older file at `path` stays as it was. Without close() nothing is written.
class AnimationWriter {
 public:
  /// Takes the topology (for GLB the texture coordinates, too) of `mesh`, whose positions are not used.
  /// Throws std::invalid_argument for an unknown ending, an option out of its range, or a mesh without
  /// vertices or with removed ones; std::runtime_error if the folder cannot be written.
  AnimationWriter(const std::filesystem::path& path, const geometry::Mesh& mesh,
                  const AnimationOptions& options = {});
  AnimationWriter(AnimationWriter&&) noexcept;
  AnimationWriter& operator=(AnimationWriter&&) noexcept;
  ~AnimationWriter();

  /// Adds the next frame: the position of every vertex, in the mesh's order [m, y up]. Throws
  /// std::invalid_argument for another number of positions, one that is not finite in the file's numbers, or
  /// after close(); std::runtime_error where the disk is full or the format's largest size is reached (GLB: 4
  /// GiB). Then the frames so far stay, and close() writes them. Cost: O(vertices), and 12 bytes of disk a
  /// vertex (GLB 24).
  void add(std::span<const physics::Vec3> positions);
  std::size_t frames() const { return frames_; }
  double next_time() const;  ///< of the frame that add() takes next [s]

  /// Writes all frames added so far into place, whole or not at all (io/base/atomic_file.h). Throws
  /// std::invalid_argument if there are none or if it was called before; std::runtime_error if the file
  /// cannot be written.
  void close();

 private:
  std::filesystem::path path_;
  AnimationOptions options_;
  std::size_t vertices_ = 0, frames_ = 0;
  std::unique_ptr<class AnimationEncoder> encoder_;
  std::unique_ptr<class Spool> spool_;  ///< null after close()
};

}  // namespace furrow::io
