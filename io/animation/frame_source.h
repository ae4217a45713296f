// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "physics/base/particles.h"

namespace furrow::io {

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
