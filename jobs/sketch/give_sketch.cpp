// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/give_sketch.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "geometry/mesh/property_names.h"
#include "io/base/figure_path.h"
#include "io/base/outputs_below.h"
#include "jobs/mesh/bake.h"
#include "jobs/mesh/transfer.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

/// What is in the folder was written by give_sketch(), which may replace it.
class Replacing : public SilentListener {
 public:
  using SilentListener::SilentListener;
  bool replaces(const std::string&) override { return true; }
};

/// Of a garment that no line and no drape has changed, which does not note it: as it lies.
std::optional<MeshInput> rest_of(const io::MeshFile& drawn) {
  if (geometry::find_map(drawn.mesh, geometry::attribute::rest_position)) return std::nullopt;
  return drawn;
}

void write_on_original(const fs::path& path, const fs::path& original, io::MeshFile drawn, const Frame& frame,
                       Listener& listener) {
  Replacing replacing(listener);
  TransferJob job;
  job.original = original;
  job.rest = rest_of(drawn);
  job.wrinkled = std::move(drawn);
  job.frame = frame;
  job.output = path;
  transfer(job, replacing);
}

/// The original in the sketch's shape, and what that misses of it, as textures.
fs::path write_maps(const fs::path& folder, const fs::path& original, io::MeshFile drawn, const Frame& frame,
                    Listener& listener) {
  Replacing replacing(listener);
  TransferJob shape;
  shape.original = original;
  shape.rest = rest_of(drawn);
  shape.wrinkled = drawn;
  shape.frame = frame;
  BakeJob job;
  job.low = transfer(shape, replacing).result;
  job.high = std::move(drawn);
  job.frame = frame;
  job.prefix = (folder / io::stem_of(original)).string();
  const BakeReport report = bake(job, replacing);
  if (!report.ran) throw physics::Cancelled("cancelled");
  return report.written.front();
}

}  // namespace

std::string title_of(const fs::path& garment) { return io::stem_of(garment); }

fs::path give_sketch(const Sketch& sketch, const Json& strokes, const std::string& as,
                     const fs::path& original, const fs::path& folder, Listener& listener) {
  const bool on_original = as == "original", maps = as == "maps";
  if (!on_original && !maps && as != "ply" && as != "obj" && as != "glb")
    throw std::invalid_argument("as: is none of ply, obj, glb, original and maps");
  io::MeshFile drawn = draw_sketch(sketch, strokes, listener).file;
  std::error_code failed;
  io::OutputsBelow::check(folder);
  fs::create_directories(folder, failed);
  if (failed) throw std::runtime_error(folder.string() + ": cannot be made: " + failed.message());
  if (maps) return write_maps(folder, original, std::move(drawn), sketch.frame, listener);
  const std::string name = io::stem_of(original);
  const std::string ending = io::is_written_mesh(io::ending_of(original))
                                 ? io::file_of_figure(original).extension().string()
                                 : ".glb";
  const fs::path path = folder / (on_original ? name + "-original" + ending : name + "." + as);
  if (on_original)
    write_on_original(path, original, std::move(drawn), sketch.frame, listener);
  else
    write_sketched(sketch, drawn, path, listener);
  return path;
}

}  // namespace furrow::jobs
