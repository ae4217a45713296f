// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/give_sketch.h"

#include <stdexcept>

#include "bridge/convert.h"
#include "io/animation/animation_file.h"
#include "jobs/transfer.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

/// glTF holds the shape as an animation of one frame.
void write_glb(const fs::path& path, const geometry::Mesh& mesh) {
  io::AnimationWriter writer(path, mesh);
  writer.add(bridge::positions_of(mesh));
  writer.close();
}

/// What is in the folder was written by give_sketch(), which may replace it.
class Replacing : public SilentListener {
 public:
  using SilentListener::SilentListener;
  bool replaces(const std::string&) override { return true; }
};

void write_on_original(const fs::path& path, const fs::path& original, io::MeshFile drawn, const Frame& frame,
                       Listener& listener) {
  Replacing replacing(listener);
  TransferJob job;
  job.original = original;
  job.wrinkled = std::move(drawn);
  job.frame = frame;
  job.output = path;
  transfer(job, replacing);
}

}  // namespace

fs::path give_sketch(const Sketch& sketch, const Json& strokes, const std::string& as,
                     const fs::path& original, const fs::path& folder, Listener& listener) {
  const bool on_original = as == "original";
  if (!on_original && as != "ply" && as != "obj" && as != "glb")
    throw std::invalid_argument("as: is none of ply, obj, glb and original");
  io::MeshFile drawn = draw_sketch(sketch, strokes, listener).file;
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw std::runtime_error(folder.string() + ": cannot be made: " + failed.message());
  const std::string name = original.stem().string();
  const fs::path path =
      folder / (on_original ? name + "-original" + original.extension().string() : name + "." + as);
  if (on_original)
    write_on_original(path, original, std::move(drawn), sketch.frame, listener);
  else if (as == "glb")
    write_glb(path, drawn.mesh);
  else
    write_sketched(sketch, drawn, path, listener);
  return path;
}

}  // namespace furrow::jobs
