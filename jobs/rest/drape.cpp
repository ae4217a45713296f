// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape.h"

#include <algorithm>

#include "io/animation/animation_file.h"
#include "io/base/figure_path.h"
#include "io/scene/garment_list.h"
#include "io/scene/settings_schema.h"
#include "jobs/base/budget.h"
#include "jobs/base/card.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/fabric_file.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/rest/drape_garment.h"
#include "jobs/rest/drape_layers.h"
#include "jobs/rest/drape_remarks.h"
#include "jobs/rest/made_for.h"
#include "jobs/rest/touch_garment.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

void check_scene(const io::Scene& scene) {
  if (!scene.body && scene.pins.empty())
    throw std::invalid_argument(
        "a garment rests on a body or hangs from what holds it: name a body with `body`, or what is held "
        "with `pin_loop`, `pin_group`, `pin_box` or `pin_vertices`");
  if (scene.body && !scene.body->frames.empty())
    throw std::invalid_argument("`body_frames`: drape fits a garment to one pose; simulate moves it");
  if (scene.body && !physics::at_rest(scene.body->motion))
    throw std::invalid_argument(
        "body.motion: drape takes the body as it lies in its file; move it there, or simulate");
  if (!scene.lines.empty())
    throw std::invalid_argument("drape draws no lines; draw them on what it writes, with `furrow wrinkle`");
}

/// What several garments are not draped with.
void check_layers(const DrapeJob& job, const io::Scene& scene) {
  const DrapeSettings& s = job.settings;
  const auto leave_out = [](const std::string& option) {
    throw std::invalid_argument(option + ": not with several garments; leave it out, or drape one of them");
  };
  if (!scene.pins.empty()) leave_out("pins (`pin_loop`, `pin_group`, `pin_box`, `pin_vertices`)");
  if (!s.bands.empty()) leave_out("`band`");
  if (!job.fabrics.empty()) leave_out("`fabrics`");
  if (s.plain) leave_out("`plain`");
  if (s.loose == LooseUse::drop) leave_out("`loose=drop`");
  if (s.bending_friction > 0) leave_out("`bending_friction`");
  if (!s.touches.empty() || !s.touch_file.empty()) leave_out("`touches`");
  if (!s.animation.empty()) leave_out("`animation`");
  if (scene.starts > 1) leave_out("`starts`");
  if (s.self_contact == SelfContactUse::off)
    throw std::invalid_argument(
        "`self_contact=off`: several garments need it to stay apart; leave it out, or drape each by itself");
  if (!scene.body) throw std::invalid_argument("several garments are draped on a body: name it with `body`");
  if (job.output == "-")
    throw std::invalid_argument(
        "`output=-`: several garments are several files; write `output=worn.ply`, which becomes "
        "worn-shirt.ply and so on");
}

/// Scenes with a garment each, the innermost first.
using GarmentScenes = std::vector<io::TomlDocument>;

/// Those of the scene, and then those over them.
GarmentScenes garment_scenes(const DrapeJob& job) {
  GarmentScenes scenes = io::scenes_by_garment(job.scene.settings);
  for (const std::filesystem::path& path : job.over) {
    io::TomlDocument own = scenes.front();
    io::set_value(own, "garment.mesh", path.string(), "the garments");
    for (const char* key : {"layer", "thickness", "touch"}) own.root["garment"].erase(key);
    scenes.push_back(std::move(own));
  }
  return scenes;
}

/// The garments' paths, the innermost first. Throws std::invalid_argument if one is there twice.
std::vector<std::filesystem::path> garments_of(const GarmentScenes& scenes,
                                               const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const io::TomlDocument& document : scenes) {
    const std::filesystem::path path = garment_of(document, folder);
    for (const std::filesystem::path& other : paths) {
      std::error_code none;
      if (path == other || std::filesystem::equivalent(path, other, none))
        throw std::invalid_argument(
            path.string() +
            " is given twice: no garment is worn over itself; name each once, from the "
            "inside to the outside");
    }
    paths.push_back(path);
  }
  return paths;
}

/// Each garment's file's name without ending; a number tells those apart that have the same.
std::vector<std::string> names_of(std::span<const std::filesystem::path> paths) {
  std::vector<std::string> names;
  for (const std::filesystem::path& path : paths) {
    const std::string stem = io::stem_of(path);
    std::string name = stem;
    for (int i = 2; std::find(names.begin(), names.end(), name) != names.end(); ++i)
      name = stem + "-" + std::to_string(i);
    names.push_back(name);
  }
  return names;
}

void check(const DrapeJob& job, const GarmentScenes& all, const io::Scene& scene, Listener& listener) {
  check_scene(scene);
  const DrapeSettings& s = job.settings;
  check_made_for(s.made_for, scene);
  check_card(job);
  if (scene.starts > 1 && !s.animation.empty())
    throw std::invalid_argument("`animation` shows one way to rest; leave it out, or `starts`");
  if (job.fabrics.size() > 1 && (!job.output.empty() || !s.animation.empty()))
    throw std::invalid_argument("`fabrics` writes a picture only; drape each by itself for its mesh");
  if (s.plain && s.contact_depth)
    throw std::invalid_argument(
        "`contact_depth`: `plain` moves cloth out to the gap at once; leave out one of them");
  const std::string output = job.output.string(), animation = s.animation.string();
  if (!output.empty()) check_output(output);
  if (!animation.empty() && !io::animation_format(s.animation))
    throw std::invalid_argument(animation + ": the ending names no animation; choose pc2, mdd or glb");
  check_folder(animation);
  std::vector<std::string> inputs{scene.garment.string(), s.made_for.string(), s.touch_file.string()};
  if (scene.body) inputs.push_back(scene.body->mesh.string());
  inputs.insert(inputs.end(), job.more_inputs.begin(), job.more_inputs.end());
  std::vector<std::string> outputs{output, animation};
  if (all.size() > 1) {
    check_layers(job, scene);
    outputs[0].clear();
    const std::vector<std::filesystem::path> garments = garments_of(all, job.scene.folder);
    for (const auto& path : garments) inputs.push_back(path.string());
    for (const std::string& name : names_of(garments))
      if (!output.empty()) outputs.push_back(layer_output(job.output, name).string());
  }
  outputs.insert(outputs.end(), job.more_outputs.begin(), job.more_outputs.end());
  check_replaced(outputs, inputs, listener);
}

/// Once of all settings that were said and that rest has no use for: what moves, and how long.
void warn_of_unused_settings(const io::TomlDocument& document, Listener& listener) {
  std::string names;
  for (const std::string& path : io::settings_without_use(document, io::used_by::drape))
    names += (names.empty() ? "" : ", ") + path;
  if (names.empty()) return;
  listener.warn({"settings_unused", "a garment at rest has no use for " + names + "; `furrow simulate` has",
                 names, ""});
}

/// The settings with what the garment's file notes, or cotton, unless something is said of what the cloth is.
io::TomlDocument with_fabric(const DrapeJob& job, io::TomlDocument document) {
  if (!job.fabrics.empty()) return document;
  take_fabric_file(document, job.scene.folder);
  take_recorded_material(document, garment_of(document, job.scene.folder), job.scene.memory);
  take_default_cloth(document, "furrow drape");
  return document;
}

/// None: the garment hangs from its pins.
std::optional<BodyCollider> body_of(const OpenScene& open, const Context& context) {
  if (!open.scene.body) return std::nullopt;
  return load_body(*open.scene.body, context, tolerance_for(open.scene.simulation.contact_gap));
}

/// That of the innermost garment; the others' are checked with it.
OpenScene open_scene(const DrapeJob& job, const GarmentScenes& all, Listener& listener) {
  OpenScene open{{}, with_fabric(job, all.front()), job.scene.folder, {}};
  open.scene = scene_of(open.document, open.folder);
  if (open.scene.garment.empty())
    throw std::invalid_argument(open.document.name + ": garment.mesh is missing");
  check_inputs(open.scene, open.document, -1, job.scene.memory);
  take_noted_frame(open.scene, open.document, job.scene.memory);
  if (job.subdivide) open.scene.subdivide = *job.subdivide;
  open.frame.unit = open.scene.unit;
  open.frame.up = open.scene.up;
  check(job, all, open.scene, listener);
  return open;
}

/// One for each fabric, or the scene alone.
std::vector<io::Scene> scenes_of(const DrapeJob& job, const OpenScene& open) {
  if (job.fabrics.empty()) return {open.scene};
  const io::TomlDocument& document = open.document;
  if (document.root->contains("/material/preset"_json_pointer) && !document.is_of_file("material.preset"))
    throw std::invalid_argument("`fabric`: `fabrics` names the fabrics; leave out one of them");
  std::vector<io::Scene> scenes;
  for (const std::string& fabric : job.fabrics) {
    io::TomlDocument other = document;
    io::set_value(other, "material.preset", fabric, "`fabrics`");
    take_fabric_file(other, open.folder);
    scenes.push_back(scene_of(other, open.folder));
    scenes.back().subdivide = open.scene.subdivide;
  }
  return scenes;
}

/// The scene of a garment that is worn over the first one.
OpenScene open_layer(const DrapeJob& job, const OpenScene& first, const io::TomlDocument& document) {
  OpenScene open{{}, with_fabric(job, document), job.scene.folder, first.frame};
  open.scene = scene_of(open.document, open.folder);
  check_inputs(open.scene, open.document, -1, job.scene.memory);
  open.scene.unit = first.scene.unit;
  open.scene.up = first.scene.up;
  if (job.subdivide) open.scene.subdivide = *job.subdivide;
  return open;
}

void drape_all_layers(const DrapeJob& job, const GarmentScenes& all, const OpenScene& first,
                      const BodyCollider& body, bool choose, const Context& context, DrapeJobReport& report) {
  const std::vector<std::string> names = names_of(garments_of(all, job.scene.folder));
  std::vector<OpenScene> open{first};
  for (std::size_t i = 1; i < all.size(); ++i) open.push_back(open_layer(job, first, all[i]));
  std::vector<io::Scene> scenes;
  for (const OpenScene& o : open) scenes.push_back(o.scene);
  WornOver worn = drape_worn_over(scenes, names, &body, job.settings, choose, context);
  for (std::size_t i = 0; i < open.size(); ++i) {
    Draped& d = worn.garments[i];
    note_material(d.file, open[i].document, d.gap);
    if (job.output.empty()) continue;
    d.written = layer_output(job.output, names[i]);
    write_mesh(d.written, d.file, context);
  }
  report.garments = std::move(worn.garments);
  report.layers = std::move(worn.layers);
  report.remarks = remarks_on(report.garments);
  if (!report.cancelled())
    for (DrapeRemark& r : remarks_on(*report.layers, std::size_t(first.scene.allow_crossings)))
      report.remarks.push_back(std::move(r));
}

}  // namespace

std::filesystem::path layer_output(const std::filesystem::path& output, const std::string& garment) {
  const std::string text = output.string(), mark = "{}";
  if (const std::size_t at = text.find(mark); at != std::string::npos)
    return text.substr(0, at) + garment + text.substr(at + mark.size());
  return output.parent_path() / (output.stem().string() + "-" + garment + output.extension().string());
}

bool DrapeJobReport::fails() const {
  const bool under =
      layers && std::any_of(layers->pairs.begin(), layers->pairs.end(),
                            [](const LayerPair& p) { return p.touch && 2 * p.outside < p.compared; });
  return under ||
         std::any_of(garments.begin(), garments.end(), [](const Draped& d) { return !d.succeeds(); });
}

namespace {

DrapeJobReport drape_all(const DrapeJob& job, Listener& listener) {
  const GarmentScenes all = garment_scenes(job);
  warn_of_unused_settings(all.front(), listener);
  const OpenScene open = open_scene(job, all, listener);
  const std::vector<io::Scene> scenes = scenes_of(job, open);
  const Context context{open.frame, listener, &job.scene.memory};
  std::optional<BodyCollider> body = body_of(open, context);
  if (const std::filesystem::path& made_for = job.settings.made_for; !made_for.empty())
    body->made_for =
        std::make_shared<const MadeFor>(read_made_for(made_for, body->triangles, *open.scene.body, context));
  const bool choose = !job.subdivide && std::none_of(all.begin(), all.end(), [](const io::TomlDocument& d) {
    return d.root->value("garment", Json::object()).contains("subdivide");
  });
  if (job.settings.finest && !choose)
    throw std::invalid_argument("`finest` stands in place of `subdivide`: give one of them");
  if (job.settings.finest && all.size() > 1)
    throw std::invalid_argument("`finest` is for one garment; `subdivide` refines several");
  DrapeJobReport report{{}, {}, {}, scenes[0], open.frame};
  if (all.size() > 1) {
    drape_all_layers(job, all, open, *body, choose, context, report);
    return report;
  }
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    report.garments.push_back(
        drape_garment(scenes[i], body ? &*body : nullptr, job.settings, choose, context));
    Draped& draped = report.garments.back();
    draped.name = job.fabrics.empty() ? io::stem_of(open.scene.garment) : job.fabrics[i];
    if (draped.report.stopped) break;
  }
  if (job.fabrics.size() < 2) note_material(report.garments[0].file, open.document, report.garments[0].gap);
  if (!job.output.empty() && job.output != "-") write_mesh(job.output, report.garments[0].file, context);
  report.remarks = remarks_on(report.garments);
  return report;
}

}  // namespace

Touched touch(const DrapeJob& job, Listener& listener) {
  const GarmentScenes all = garment_scenes(job);
  const OpenScene open = open_scene(job, all, listener);
  const Context context{open.frame, listener, &job.scene.memory};
  const std::optional<BodyCollider> body = body_of(open, context);
  const BodyCollider* const on = body ? &*body : nullptr;
  GivenGarment given = read_given(open.scene, on, job.settings, false, context);
  const double gap = gap_in_use(given.scene, on, job.settings, given.file.mesh, context);
  const CrossedStart crossed = crossed_start(given.file.mesh);
  Touched touched;
  touched.touches = touch_garment(given, on, job.settings, gap, context);
  touched.file = std::move(given.file);
  const std::size_t pairs = measure_crossings(touched.file, &crossed).pairs;
  touched.crossings = pairs - std::min(pairs, crossed.pairs);
  return touched;
}

DrapeJobReport drape(const DrapeJob& job, Listener& listener) {
  Budget budget("drape", job.budget, listener);
  const physics::CancelScope cancelling([&budget] { return budget.cancelled(); });
  DrapeJobReport report = budget.run([&] { return drape_all(job, budget); });
  report.budget_spent = report.cancelled() && report.garments.back().measured && budget.is_spent();
  for (Draped& d : report.garments) d.budget_spent = report.budget_spent;
  return report;
}

}  // namespace furrow::jobs
