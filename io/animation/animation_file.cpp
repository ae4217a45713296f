// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/animation/animation_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/preconditions.h"
#include "io/animation/animation_encoder.h"
#include "io/base/atomic_file.h"
#include "io/base/figure_path.h"
#include "io/base/spool.h"
#include "io/mesh/file_frame.h"

namespace furrow::io {
namespace {

constexpr std::array<std::pair<const char*, AnimationFormat>, 3> endings = {
    {{".pc2", AnimationFormat::pc2}, {".mdd", AnimationFormat::mdd}, {".glb", AnimationFormat::glb}}};

void check(const AnimationOptions& o) {
  if (!(o.fps > 0) || !std::isfinite(o.fps))
    throw std::invalid_argument("animation: fps must be > 0 and finite, is " + std::to_string(o.fps));
  if (!(o.start >= 0) || !std::isfinite(o.start))
    throw std::invalid_argument("animation: start must be >= 0 s and finite, is " + std::to_string(o.start));
  check_unit(o.frame.metres_per_unit);
}

std::unique_ptr<AnimationEncoder> make_encoder(const std::filesystem::path& path, const geometry::Mesh& mesh,
                                               const AnimationOptions& options) {
  const auto format = animation_format(path);
  if (!format)
    throw std::invalid_argument(path.string() + ": animations are written as pc2, mdd or glb, not '" +
                                path.extension().string() + "'");
  switch (*format) {
    case AnimationFormat::pc2:
      return pc2_encoder(mesh, options);
    case AnimationFormat::mdd:
      return mdd_encoder(mesh, options);
    default:
      return glb_encoder(mesh, options);
  }
}

void check_positions(std::span<const physics::Vec3> positions, std::size_t vertices,
                     const WriteOptions& options) {
  if (positions.size() != vertices)
    throw std::invalid_argument("animation: " + std::to_string(positions.size()) +
                                " positions for a mesh of " + std::to_string(vertices) + " vertices");
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const geometry::Vector p = to_file(bridge::to_cgal(positions[i]), options);
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(p[k]) <= std::numeric_limits<float>::max()))
        throw std::invalid_argument("animation: the position of vertex " + std::to_string(i) +
                                    " is not finite in single precision");
  }
}

}  // namespace

std::optional<AnimationFormat> animation_format(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  for (const auto& [known, format] : endings)
    if (ending == known) return format;
  return std::nullopt;
}

AnimationWriter::AnimationWriter(const std::filesystem::path& path, const geometry::Mesh& mesh,
                                 const AnimationOptions& options)
    : path_(path), options_(options), vertices_(mesh.number_of_vertices()) {
  check(options);
  geometry::require_structure(mesh, "animation");
  geometry::require_triangles(mesh, "animation");
  if (vertices_ == 0 || mesh.has_garbage())
    throw std::invalid_argument("animation: the mesh has no vertices, or removed ones: collect its garbage");
  encoder_ = make_encoder(path, mesh, options);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw std::runtime_error(path.string() + ": cannot be written: it is a folder");
  spool_ = std::make_unique<Spool>(path);
}

AnimationWriter::AnimationWriter(AnimationWriter&&) noexcept = default;
AnimationWriter& AnimationWriter::operator=(AnimationWriter&&) noexcept = default;
AnimationWriter::~AnimationWriter() = default;

double AnimationWriter::next_time() const { return frame_time(options_, frames_); }

void AnimationWriter::add(std::span<const physics::Vec3> positions) {
  if (!spool_) throw std::invalid_argument("animation: " + path_.string() + " is closed");
  check_positions(positions, vertices_, options_.frame);
  const auto refuse = [&](const char* why) {
    throw std::runtime_error(path_.string() + ": frame " + std::to_string(frames_) + ": " + why);
  };
  if (frames_ == std::numeric_limits<std::int32_t>::max() ||
      (frames_ > 0 && static_cast<float>(frame_time(options_, frames_ - 1)) >=
                          static_cast<float>(frame_time(options_, frames_))))
    refuse("the format's times cannot tell it from the one before; take fewer frames a second");
  const std::string bytes = encoder_->frame(frames_, positions);
  if (spool_->size() + bytes.size() > encoder_->largest_file())
    refuse("the file would be larger than its format allows; keep fewer frames, or write pc2 or mdd");
  spool_->append(bytes);
  ++frames_;
}

void AnimationWriter::close() {
  if (!spool_) throw std::invalid_argument("animation: " + path_.string() + " is closed");
  if (frames_ == 0) throw std::invalid_argument("animation: no frame was added to " + path_.string());
  write_atomically(path_, [&](std::ostream& out) {
    out << encoder_->head(frames_);
    spool_->copy_to(out);
    out << encoder_->tail(frames_);
  });
  spool_.reset();
}

}  // namespace furrow::io
