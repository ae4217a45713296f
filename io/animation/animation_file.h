// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"
#include "io/mesh/mesh_file.h"
#include "physics/base/arrays.h"

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

struct FrameSourceOptions {
  double fps = 25;      ///< frames a second, > 0, finite; MDD files have their own times
  ReadOptions frame{};  ///< unit and axes of the files
};

/// A moving mesh that lies in files. Frames are read one by one, when they are asked for.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  std::size_t frames() const { return times_.size(); }         ///< >= 1
  std::size_t vertices() const { return vertices_; }           ///< of each frame
  const std::vector<double>& times() const { return times_; }  ///< of each frame, increasing [s]
  /// The positions of a frame in the mesh's order [m, y up]. Several threads may call it at once. Throws
  /// std::invalid_argument for a frame beyond the last; geometry::ContentError where the file cannot be read,
  /// was changed, holds a position that is not finite, or has another number of vertices.
  virtual std::vector<physics::Vec3> positions(std::size_t frame) const = 0;

 protected:
  FrameSource(std::size_t vertices, std::vector<double> times)
      : vertices_(vertices), times_(std::move(times)) {}
  void check_frame(std::size_t frame) const;

 private:
  std::size_t vertices_;
  std::vector<double> times_;
};

/// Opens the frames of a mesh of that many vertices. Reads only heads (of a sequence: the first file). Cost
/// and memory: O(frames). Throws std::invalid_argument for an option out of its range; geometry::ContentError
/// for a file that is missing, damaged, cut or longer than its head says, or for another number of vertices.
///
/// \details
/// - A PC2 or MDD file, by its ending. Times of PC2: (first frame + i * frames a sample) / fps.
/// - A sequence of OBJ, PLY or OFF files: one run of # in the file's name stands for the number of the frame,
///   with at least as many digits (body_####.obj: body_0001.obj … body_12000.obj). Its time is (number -
///   first number) / fps; a missing number is time without a frame.
std::unique_ptr<FrameSource> open_frames(const std::filesystem::path& path, std::size_t vertices,
                                         const FrameSourceOptions& options = {});

/// The format behind open_frames(), PC2 or MDD.
std::unique_ptr<FrameSource> open_point_cache(const std::filesystem::path& path, bool mdd,
                                              std::size_t vertices, const FrameSourceOptions& options);

}  // namespace furrow::io
