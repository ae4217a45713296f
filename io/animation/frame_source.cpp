// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/errors.h"
#include "io/animation/animation_file.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/mesh_formats.h"

namespace furrow::io {
namespace {

namespace fs = std::filesystem;
using geometry::ContentError;

struct NumberedFile {
  long number;
  fs::path path;
};

class MeshSequence : public FrameSource {
 public:
  MeshSequence(std::vector<NumberedFile> files, std::vector<double> times, std::size_t vertices,
               const ReadOptions& options)
      : FrameSource(vertices, std::move(times)), files_(std::move(files)), options_(options) {}

  std::vector<physics::Vec3> positions(std::size_t frame) const override {
    check_frame(frame);
    const fs::path& path = files_[frame].path;
    const geometry::Mesh mesh = read_mesh(path, options_).mesh;
    if (mesh.number_of_vertices() != vertices())
      throw ContentError(path.string() + ": " + std::to_string(mesh.number_of_vertices()) +
                         " vertices, not the mesh's " + std::to_string(vertices()) +
                         "; all frames must be of one mesh");
    return bridge::positions_of(mesh);
  }

 private:
  std::vector<NumberedFile> files_;
  ReadOptions options_;
};

/// The digits that stand for the run of # in a name, as a number; nothing if the name does not fit.
std::optional<long> number_in(std::string_view name, std::string_view before, std::size_t width,
                              std::string_view after) {
  constexpr std::size_t most_digits = 9;
  if (!name.starts_with(before) || !name.ends_with(after)) return std::nullopt;
  if (name.size() < before.size() + width + after.size()) return std::nullopt;
  name.remove_prefix(before.size());
  name.remove_suffix(after.size());
  if (name.size() > std::max(most_digits, width) || name.find_first_not_of("0123456789") != name.npos)
    return std::nullopt;
  if (name.size() > width && name.front() == '0') return std::nullopt;
  const auto first = std::min(name.find_first_not_of('0'), name.size() - 1);
  if (name.size() - first > most_digits) return std::nullopt;
  return std::stol(std::string(name.substr(first)));
}

std::vector<NumberedFile> find_files(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  const std::size_t begin = name.find('#'), end = std::min(name.find_first_not_of('#', begin), name.size());
  if (name.find('#', end) != name.npos)
    throw ContentError(pattern.string() + ": more than one run of # in the name; one stands for the number");
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  std::vector<NumberedFile> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), last; !error && entry != last; entry.increment(error)) {
    const std::string found = entry->path().filename().string();
    const auto number = number_in(found, std::string_view(name).substr(0, begin), end - begin,
                                  std::string_view(name).substr(end));
    if (number) files.push_back({*number, folder / found});
  }
  if (error) throw ContentError(folder.string() + ": cannot be listed: " + error.message());
  if (files.empty()) throw ContentError(pattern.string() + ": no file fits; # stands for digits");
  std::ranges::sort(files, {}, &NumberedFile::number);
  return files;
}

std::unique_ptr<FrameSource> open_sequence(const fs::path& pattern, std::size_t vertices,
                                           const FrameSourceOptions& options) {
  mesh_format(pattern);
  if (!find_mesh_ending(pattern)->keeps_order)
    throw ContentError(pattern.string() + ": a sequence is of " + mesh_formats_in_order() +
                       " files, which keep their vertices' order");
  std::vector<NumberedFile> files = find_files(pattern);
  std::vector<double> times;
  for (const NumberedFile& file : files)
    times.push_back(static_cast<double>(file.number - files.front().number) / options.fps);
  auto source = std::make_unique<MeshSequence>(std::move(files), std::move(times), vertices, options.frame);
  source->positions(0);
  return source;
}

}  // namespace

void FrameSource::check_frame(std::size_t frame) const {
  if (frame >= frames())
    throw std::invalid_argument("frame " + std::to_string(frame) + ": there are " + std::to_string(frames()));
}

std::unique_ptr<FrameSource> open_frames(const fs::path& path, std::size_t vertices,
                                         const FrameSourceOptions& options) {
  check_unit(options.frame.metres_per_unit);
  if (!(options.fps > 0) || !std::isfinite(options.fps))
    throw std::invalid_argument("fps must be > 0 and finite, is " + std::to_string(options.fps));
  if (path.filename().string().find('#') != std::string::npos) return open_sequence(path, vertices, options);
  const auto format = animation_format(path);
  if (format == AnimationFormat::pc2 || format == AnimationFormat::mdd)
    return open_point_cache(path, format == AnimationFormat::mdd, vertices, options);
  throw ContentError(path.string() +
                     ": frames are read from pc2 and mdd files, and from a sequence like name_####.obj");
}

}  // namespace furrow::io
