// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/errors.h"
#include "io/animation/animation_file.h"
#include "io/base/byte_order.h"
#include "io/base/own_mark.h"
#include "io/mesh/file_frame.h"

namespace furrow::io {
namespace {

namespace fs = std::filesystem;
using geometry::ContentError;

constexpr std::size_t point_bytes = 12;

/// `size` bytes of a file from `begin` on.
std::string read_part(const fs::path& path, std::uint64_t begin, std::size_t size) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(size, '\0');
  if (!in.seekg(static_cast<std::streamoff>(begin)) ||
      !in.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw ContentError(path.string() + ": cannot be read, or ends too early");
  return bytes;
}

struct Layout {
  std::int32_t frames = 0, points = 0;
  std::uint64_t first = 0;  ///< byte of frame 0
  std::vector<double> times;
  std::endian order = std::endian::little;
};

class PointCache : public FrameSource {
 public:
  PointCache(fs::path path, Layout layout, const ReadOptions& options)
      : FrameSource(static_cast<std::size_t>(layout.points), std::move(layout.times)),
        path_(std::move(path)),
        first_(layout.first),
        order_(layout.order),
        options_(options) {}

  std::vector<physics::Vec3> positions(std::size_t frame) const override {
    check_frame(frame);
    const std::size_t size = point_bytes * vertices();
    const std::string bytes = read_part(path_, first_ + frame * size, size);
    std::vector<physics::Vec3> x;
    x.reserve(vertices());
    for (std::size_t at = 0; at < size; at += point_bytes) {
      const auto c = [&](std::size_t k) { return read_in_order<float>(&bytes[at + 4 * k], order_); };
      const auto point = from_file(c(0), c(1), c(2), options_);
      if (!point)
        throw ContentError(path_.string() + ": frame " + std::to_string(frame) + ", vertex " +
                           std::to_string(at / point_bytes) + ": " + bad_coordinate);
      x.push_back(bridge::to_eigen(*point));
    }
    return x;
  }

 private:
  fs::path path_;
  std::uint64_t first_;
  std::endian order_;
  ReadOptions options_;
};

/// Checks the counts against the mesh and the file's size, before anything is made of them.
void check_counts(const fs::path& path, const Layout& layout, std::uint64_t size, std::size_t vertices) {
  const auto fail = [&](const std::string& what) { throw ContentError(path.string() + ": " + what); };
  if (layout.frames <= 0 || layout.points <= 0)
    fail("its head says " + std::to_string(layout.frames) + " frames of " + std::to_string(layout.points) +
         " vertices: damaged, or its writer did not finish");
  const std::uint64_t a_frame = point_bytes * static_cast<std::uint64_t>(layout.points);
  const std::uint64_t rest = size - std::min(size, layout.first);
  if (rest % a_frame != 0 || rest / a_frame != static_cast<std::uint64_t>(layout.frames))
    fail(std::to_string(layout.frames) + " frames of " + std::to_string(layout.points) +
         " vertices do not fit its " + std::to_string(size) + " bytes: cut, damaged, or another format");
  if (static_cast<std::size_t>(layout.points) != vertices)
    fail(std::to_string(layout.points) + " vertices, but the mesh has " + std::to_string(vertices) +
         "; give the mesh that it was made for");
}

void check_times(const fs::path& path, const std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
      throw ContentError(path.string() + ": the time of frame " + std::to_string(i) +
                         " is not finite or not after the one before");
}

Layout pc2_layout(const fs::path& path, std::uint64_t size, std::size_t vertices, double fps) {
  constexpr char mark[12] = "POINTCACHE2";
  constexpr std::size_t file_head = 32;
  const std::string head = size < file_head ? std::string(file_head, '\0') : read_part(path, 0, file_head);
  if (std::memcmp(head.data(), mark, sizeof mark) != 0)
    throw ContentError(path.string() + ": no PC2 file: it does not begin with POINTCACHE2");
  const auto integer = [&](std::size_t at) {
    return read_in_order<std::int32_t>(&head[at], std::endian::little);
  };
  const auto number = [&](std::size_t at) { return read_in_order<float>(&head[at], std::endian::little); };
  if (integer(12) != 1)
    throw ContentError(path.string() + ": PC2 version " + std::to_string(integer(12)) + "; only 1 is read");
  Layout layout{integer(28), integer(16), file_head, {}, std::endian::little};
  check_counts(path, layout, size, vertices);
  for (std::int32_t i = 0; i < layout.frames; ++i)
    layout.times.push_back((double{number(20)} + i * double{number(24)}) / fps);
  return layout;
}

Layout mdd_layout(const fs::path& path, std::uint64_t size, std::size_t vertices) {
  if (size < 8) throw ContentError(path.string() + ": no MDD file: it is shorter than a head");
  const std::string head = read_part(path, 0, 8);
  const auto integer = [&](std::size_t at) {
    return read_in_order<std::int32_t>(&head[at], std::endian::big);
  };
  Layout layout{integer(0), integer(4), 0, {}, std::endian::big};
  layout.first = 8 + 4 * static_cast<std::uint64_t>(std::max(layout.frames, 0));
  check_counts(path, layout, size, vertices);
  const std::string times = read_part(path, 8, 4 * static_cast<std::size_t>(layout.frames));
  for (std::size_t at = 0; at < times.size(); at += 4)
    layout.times.push_back(read_in_order<float>(&times[at], std::endian::big));
  return layout;
}

}  // namespace

std::unique_ptr<FrameSource> open_point_cache(const fs::path& path, bool mdd, std::size_t vertices,
                                              const FrameSourceOptions& options) {
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    throw ContentError(path.string() + ": " + (error ? error.message() : "is no regular file"));
  std::uint64_t size = fs::file_size(path, error);
  if (error) throw ContentError(path.string() + ": cannot be read: " + error.message());
  if (size >= own_tail.size() && read_part(path, size - own_tail.size(), own_tail.size()) == own_tail)
    size -= own_tail.size();
  Layout layout = mdd ? mdd_layout(path, size, vertices) : pc2_layout(path, size, vertices, options.fps);
  check_times(path, layout.times);
  return std::make_unique<PointCache>(path, std::move(layout), options.frame);
}

}  // namespace furrow::io
