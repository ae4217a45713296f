// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/simulate_checks.h"

#include <algorithm>

#include "io/animation/animation_file.h"
#include "io/base/figure_path.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/fabric_file.h"
#include "jobs/cloth/recorded_material.h"

namespace furrow::jobs {
namespace {

/// Files that are read; no output may replace one.
std::vector<std::string> inputs(const io::Scene& scene, const io::TomlDocument& document,
                                const SimulateJob& job) {
  std::vector<std::string> files{scene.garment.string(), job.state_path.string()};
  if (is_scene(document.name)) files.push_back(document.name);
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->frames}) files.push_back(path.string());
  for (const io::SceneLines& lines : scene.lines) files.push_back(lines.strokes.string());
  std::erase(files, "");
  return files;
}

namespace fs = std::filesystem;

/// Where the path leads, links followed, though it need not be there yet.
fs::path real(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

/// Throws std::invalid_argument for an output of a scene file that lies outside of the folder: who runs a
/// stranger's scene has not said that it may write there.
void check_lies_below(const fs::path& output, const fs::path& folder, const std::string& place) {
  const fs::path way = real(output).lexically_relative(real(folder.empty() ? "." : folder));
  if (way.empty() || *way.begin() == "..")
    throw std::invalid_argument(place + ": " + output.string() + " lies outside of the scene's folder, " +
                                (folder.empty() ? "." : folder.string()) +
                                "; allow it with `outputs_below=FOLDER`, or name the output by a flag");
}

/// Folders that a scene file names are made, so that a fresh copy of it runs; those of flags must be there.
void make_folders(const io::Scene& scene, const io::TomlDocument& document, const fs::path& below) {
  const io::SceneOutput& out = scene.output;
  const std::pair<const char*, fs::path> outputs[] = {
      {"mesh", out.mesh},         {"state", out.state},     {"inserted", out.inserted},
      {"smoothed", out.smoothed}, {"settled", out.settled}, {"animation", out.animation},
      {"body", out.body}};
  std::vector<fs::path> folders;
  for (const auto& [key, path] : outputs) {
    const std::string setting = "output." + std::string(key);
    if (path.empty() || path == "-" || !document.is_of_file(setting)) continue;
    check_lies_below(path, below, document.place(setting));
    if (!path.parent_path().empty()) folders.push_back(path.parent_path());
  }
  for (const fs::path& folder : folders) fs::create_directories(folder);
}

void check_output_formats(const io::SceneOutput& out, bool has_body) {
  for (const auto& path : {out.mesh, out.inserted, out.smoothed, out.settled, out.body})
    if (!path.empty()) check_output(path.string());
  for (const auto& path : {out.inserted, out.smoothed, out.settled, out.body})
    if (path == "-")
      throw std::invalid_argument("only the garment at the end (`output`) can go to standard output");
  if (!out.animation.empty() && !io::animation_format(out.animation))
    throw std::invalid_argument(out.animation.string() +
                                ": the ending names no animation; choose pc2, mdd or glb");
  check_folder(out.animation.string());
  if (!out.state.empty() && io::ending_of(out.state) != ".ply")
    throw std::invalid_argument(out.state.string() + ": a state is a .ply file");
  if (!out.state.empty()) check_output(out.state.string());
  if (!out.body.empty() && !has_body)
    throw std::invalid_argument("`save_body`: there is no body; name one with `body`");
}

/// A state names its files in JSON, which is UTF-8: any other name would be lost.
void check_names(const io::TomlDocument& document, const std::string& key) {
  try {
    document.root->dump();
  } catch (const Json::exception&) {
    throw std::invalid_argument(
        key +
        ": the scene names a file whose name is not UTF-8, which a state cannot keep; rename that file: " +
        document.root->dump(-1, ' ', false, Json::error_handler_t::replace));
  }
}

void check_outputs(const OpenScene& open, const SimulateJob& job, Listener& listener) {
  const io::Scene& scene = open.scene;
  const io::SceneOutput& out = scene.output;
  if (job.needs_output && out.mesh.empty() && out.state.empty() && out.animation.empty())
    throw std::invalid_argument("nothing to write: name `output`, `save_state` or `animation`");
  if (out.checkpoint && out.state.empty())
    throw std::invalid_argument("`checkpoint`: there is no state to write; name one with `save_state`");
  check_output_formats(out, scene.body.has_value());
  if (!out.state.empty()) check_names(open.document, "output.state");
  std::vector<std::string> written;
  for (const auto& path :
       {out.mesh, out.state, out.inserted, out.smoothed, out.settled, out.animation, out.body})
    if (!path.empty() && path != "-") written.push_back(path.string());
  check_replaced(written, inputs(scene, open.document, job), listener);
}

void check_state(const io::Scene& scene, const io::SavedState& state) {
  const io::Json garment = state.scene->value("garment", io::Json::object());
  if (scene.subdivide != garment.value("subdivide", 0))
    throw std::invalid_argument(
        "`subdivide`: the garment of a state is in motion; refine it before the first step");
  if (scene.keep != (garment.value("rest", "stored") == "keep"))
    throw std::invalid_argument(
        "`rest`: the garment of a state is in motion; `furrow keep state` keeps its shape");
}

/// What the garment's file notes of its cloth, else the usual one (true); warns where the settings name
/// another.
bool take_material(OpenScene& open, const MemoryFiles& memory, Listener& listener) {
  const std::filesystem::path garment = garment_of(open.document, open.folder);
  const RecordedMaterial recorded = take_recorded_material(open.document, garment, memory);
  if (!recorded.other_cloth.is_null())
    listener.warn({"other_cloth", words_of_other_cloth(garment, recorded.other_cloth), garment.string(),
                   "material.preset"});
  return take_default_moving_cloth(open.document, "furrow simulate");
}

}  // namespace

OpenScene open_scene(const SimulateJob& job, Listener& listener) {
  OpenScene open{{}, job.scene.settings, job.scene.folder, {}};
  take_fabric_file(open.document, open.folder);
  const bool by_default = !job.state && take_material(open, job.scene.memory, listener);
  open.scene = scene_of(open.document, open.folder);
  open.scene.material.by_default = by_default;
  if (job.state && job.tolerance)
    throw std::invalid_argument("tolerance: judges a scene from its beginning; leave out one of the two");
  if (open.scene.garment.empty() && !job.state)
    throw std::invalid_argument(open.document.name + ": garment.mesh is missing");
  if (job.state) check_state(open.scene, *job.state);
  check_inputs(open.scene, open.document, job.state ? job.state->lines_drawn : -1, job.scene.memory);
  if (!job.state) take_noted_frame(open.scene, open.document, job.scene.memory);
  if (is_scene(open.document.name))
    make_folders(open.scene, open.document, job.outputs_below.value_or(open.folder));
  check_outputs(open, job, listener);
  open.frame.unit = open.scene.unit;
  open.frame.up = open.scene.up;
  return open;
}

}  // namespace furrow::jobs
