// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/inputs.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/struts.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/figure_path.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/weld.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_rules.h"
#include "io/scene/state_file.h"
#include "jobs/base/gate.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "physics/base/progress.h"

namespace furrow::jobs {

namespace {

constexpr std::pair<const char*, double> units[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}};

const std::pair<const char*, double>* find_unit(const std::string& unit) {
  const auto* found =
      std::find_if(std::begin(units), std::end(units), [&](const auto& u) { return unit == u.first; });
  return found == std::end(units) ? nullptr : found;
}

double metres_per_unit(const Frame& frame) {
  const auto* unit = find_unit(frame.unit_in_use());
  if (!unit) throw std::invalid_argument("unit: '" + frame.unit_in_use() + "' is not m, cm, mm or inch");
  return unit->second;
}

io::Axis axis(const Frame& frame) { return frame.up_in_use() == "z" ? io::Axis::z : io::Axis::y; }

}  // namespace

bool is_unit(const std::string& unit) { return find_unit(unit) != nullptr; }

void take_noted_frame(Frame& frame, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const auto record = io::read_wrinkle_record(file);
    if (!record || !is_unit(record->unit)) continue;
    frame.noted_unit = record->unit;
    frame.noted_up = record->up;
    return;
  }
}

io::ReadOptions read_options(const Frame& frame) { return {metres_per_unit(frame), axis(frame)}; }

io::WriteOptions write_options(const Frame& frame) { return {metres_per_unit(frame), axis(frame)}; }

namespace {

void tell_repairs(const std::string& path, const io::MeshFile& file, const Context& context) {
  for (const std::string& w : file.warnings) context.warn("mesh_reading", w, path);  // it names the file
  const io::RepairReport& r = file.repairs;
  const auto tell = [&](std::size_t n, const char* code, const char* what) {
    if (n) context.warn(code, path + ": " + std::to_string(n) + " " + what, path);
  };
  tell(r.degenerate_faces, "degenerate_faces", "degenerate faces dropped");
  tell(r.duplicate_faces, "duplicate_faces", "duplicate faces dropped");
  tell(r.lining_textures, "lining_textures",
       "faces of its lining take the texture coordinates of their fronts");
  tell(r.reversed_faces, "reversed_faces", "faces turned to agree with their neighbours");
  tell(r.duplicated_vertices, "duplicated_vertices",
       "vertices duplicated where the surface was not manifold");
}

io::MeshFile read_file(const std::string& path, const Context& context, Chains chains) {
  const Frame& frame = context.frame;
  const auto read = [&](const Frame& in) {
    io::ReadOptions options = read_options(in);
    options.chains = chains == Chains::taken;
    return io::read_mesh(path, options);
  };
  io::MeshFile file = read(frame);
  const auto record = io::find_wrinkle_record(file, path);
  const bool noted = record && is_unit(record->unit);
  Frame actual;
  actual.unit = noted && !frame.unit ? record->unit : frame.unit_in_use();
  actual.up = noted && !frame.up ? record->up : frame.up_in_use();
  if (*actual.unit != frame.unit_in_use() || *actual.up != frame.up_in_use()) file = read(actual);
  if (noted && (record->unit != *actual.unit || record->up != *actual.up))
    context.warn("other_frame",
                 path + ": was written with `unit=" + record->unit + "` `up=" + record->up + "`", path,
                 "unit");
  tell_repairs(path, file, context);
  io::drop_motion(file);  // a state that is used as a mesh is one
  return file;
}

/// `may_say`: a setting would leave them open.
io::MeshFile with_seams_as_one(io::MeshFile read, const std::string& name, bool may_say,
                               const Context& context) {
  const std::size_t told = read.warnings.size();
  io::MeshFile file = io::with_seams_as_one(std::move(read), name);
  for (std::size_t i = told; i < file.warnings.size(); ++i)
    context.warn("seams_joined",
                 file.warnings[i] + (may_say ? "; `garment.join=false` leaves them open" : ""), name,
                 may_say ? "garment.join" : "`furrow doctor`");
  return file;
}

}  // namespace

void stop_if_cancelled(const Context& context) {
  if (context.listener.cancelled()) throw physics::Cancelled("cancelled");
}

std::string name_of(const MeshInput& input, const std::string& unnamed) {
  const auto* path = std::get_if<std::filesystem::path>(&input);
  return path ? path->string() : unnamed;
}

io::MeshFile read_mesh(const MeshInput& input, const Context& context, Chains chains) {
  const auto* path = std::get_if<std::filesystem::path>(&input);
  const io::MeshFile* known = !path            ? &std::get<io::MeshFile>(input)
                              : context.memory ? context.memory->find_mesh(*path)
                                               : nullptr;
  io::MeshFile file = known ? *known : read_file(path->string(), context, chains);
  geometry::check_mesh(file.mesh, name_of(input, "a mesh in memory").c_str());
  io::drop_motion(file);
  return file;
}

io::MeshFile read_garment(const MeshInput& input, const Context& context, const std::string& what,
                          Chains chains, std::optional<bool> joins) {
  io::MeshFile file = read_mesh(input, context, chains);
  if (chains == Chains::refused || !geometry::is_chain(file.mesh))
    require_area(file.mesh, name_of(input, what));
  if (joins.value_or(true))
    file = with_seams_as_one(std::move(file), name_of(input, what), joins.has_value(), context);
  require_size(file.mesh, name_of(input, what), what, context);
  return file;
}

void warn_of_lost_attributes(const std::string& path, const io::MeshFile& file, const Context& context) {
  const io::MeshFormat format = io::mesh_format(path);
  if (format == io::MeshFormat::ply || format == io::MeshFormat::gltf) return;  // the latter tells itself
  std::string names;
  for (const geometry::VertexAttribute& attribute : geometry::vertex_attributes(file.mesh))
    names += (names.empty() ? "" : ", ") + attribute.name;
  if (!names.empty())
    context.warn("lost_attributes",
                 (path == "-" ? "standard output" : path) +
                     ": only PLY keeps vertex attributes; not written: " + names,
                 path);
}

io::MeshFile with_noted_frame(io::MeshFile file, const Frame& frame) {
  if (auto record = io::find_wrinkle_record(file)) {
    record->unit = frame.unit_in_use();
    record->up = frame.up_in_use();
    io::set_wrinkle_record(file, *record);
  }
  return file;
}

void write_mesh(const std::filesystem::path& path, const io::MeshFile& file, const Context& context) {
  const io::WriteOptions options = write_options(context.frame);
  warn_of_lost_attributes(path.string(), file, context);
  const auto lost = io::write_mesh(path, with_noted_frame(file, context.frame), options);
  for (const std::string& what : lost)
    context.warn("lost_in_glb", path.string() + ": it leaves out " + what, path.string());
}

SceneInput scene_from_file(const std::filesystem::path& toml) {
  return {io::read_toml(toml), toml.parent_path()};
}

bool is_scene(const std::string& path) { return io::ending_of(path) == ".toml"; }

io::TomlDocument settings_of(const std::string& scene_or_garment, const std::string& state_path,
                             const std::optional<io::SavedState>& state) {
  if (is_scene(scene_or_garment)) return io::read_toml(scene_or_garment);
  if (state) {
    if (!scene_or_garment.empty())
      throw std::invalid_argument(scene_or_garment + ": `state` has its garment; leave out the mesh");
    return io::document_of(state->scene, state_path);
  }
  if (scene_or_garment.empty()) throw std::invalid_argument("name a garment, a scene (.toml), or `state`");
  io::TomlDocument document;
  io::set_value(document, "garment.mesh", scene_or_garment, "the garment");
  return document;
}

namespace {

/// Does it; a fault of a flag is one of the call, not of a file.
template <class Work>
auto blaming_flags(const Work& work) {
  try {
    return work();
  } catch (const geometry::ContentError& e) {
    if (std::string(e.what()).starts_with('`')) throw std::invalid_argument(e.what());
    throw;
  }
}

}  // namespace

io::Scene scene_of(const io::TomlDocument& document, const std::filesystem::path& folder) {
  return blaming_flags([&] { return io::read_scene(document, folder); });
}

void take_noted_frame(io::Scene& scene, io::TomlDocument& document, const MemoryFiles& memory) {
  if (memory.holds(scene.garment)) return;
  Frame noted;
  jobs::take_noted_frame(noted, {scene.garment.string()});
  const auto take = [&](std::optional<std::string>& value, const char* key, const std::string& found,
                        const char* usual) {
    if (value || found == usual) return;
    value = found;
    io::set_value(document, key, found, scene.garment.string());
  };
  take(scene.unit, "unit", noted.noted_unit, "m");
  take(scene.up, "up", noted.noted_up, "y");
}

namespace {

/// Of one file garment and body are two figures.
void check_figures(const io::Scene& scene) {
  if (!scene.body || scene.garment.empty() || scene.garment == "-" || scene.body->mesh.empty()) return;
  const io::FigurePath garment = io::figure_path(scene.garment), body = io::figure_path(scene.body->mesh);
  const bool apart = !garment.figure.empty() && !body.figure.empty() && garment.figure != body.figure;
  if (apart || !same_file(garment.file.string(), body.file.string())) return;
  if (io::mesh_format(garment.file) != io::MeshFormat::gltf) return;  // the gate sees what is worn on itself
  throw std::invalid_argument("garment: is the body's file " + garment.file.string() +
                              ", too; name one figure of a GLB for each, as garment=avatar.glb#Skirt and "
                              "body=avatar.glb#Body, or give two files");
}

}  // namespace

void check_inputs(const io::Scene& scene, const io::TomlDocument& document, int lines_drawn,
                  const MemoryFiles& memory) {
  const auto check = [&](const std::string& key, const std::filesystem::path& path) {
    const std::string place = document.place(key);
    if (document.name.empty() || place.rfind(document.name, 0) != 0 || path.empty() || path == "-" ||
        memory.holds(path) || std::filesystem::exists(io::file_of_figure(path)))
      return;
    throw geometry::ContentError(place + ": " + key + ": there is no file " + path.string() +
                                 "; paths are relative to the file that names them");
  };
  blaming_flags([&] { io::check_keep_stands_still(scene, document, lines_drawn); });
  if (lines_drawn < 0) check("garment.mesh", scene.garment);
  if (scene.body) check("body.mesh", scene.body->mesh);
  check_figures(scene);
  for (std::size_t i = static_cast<std::size_t>(std::max(0, lines_drawn)); i < scene.lines.size(); ++i)
    check("lines." + std::to_string(i) + ".strokes", scene.lines[i].strokes);
}

}  // namespace furrow::jobs
