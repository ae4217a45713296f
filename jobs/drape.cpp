// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/drape.h"

#include <algorithm>

#include "io/animation/animation_file.h"
#include "io/scene/settings_schema.h"
#include "jobs/check/output_checks.h"
#include "jobs/read_inputs.h"
#include "jobs/report/drape_remarks.h"
#include "jobs/run/drape_garment.h"
#include "jobs/run/recorded_material.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"

namespace furrow::jobs {
namespace {

void check_scene(const io::Scene& scene) {
  if (!scene.body && scene.pins.empty())
    throw std::invalid_argument(
        "a garment rests on a body or hangs from what holds it: name a body with --body, or what is held "
        "with --pin-loop, --pin-group, --pin-box or --pin-vertices");
  if (scene.body && !scene.body->frames.empty())
    throw std::invalid_argument("--body-frames: drape fits a garment to one pose; simulate moves it");
  if (scene.body && !physics::at_rest(scene.body->motion))
    throw std::invalid_argument(
        "body.motion: drape takes the body as it lies in its file; move it there, or simulate");
  if (!scene.lines.empty())
    throw std::invalid_argument("drape draws no lines; draw them on what it writes, with furrow wrinkle");
}

void check(const DrapeJob& job, const io::Scene& scene, Listener& listener) {
  check_scene(scene);
  const DrapeSettings& s = job.settings;
  using physics::require;
  require("drape", "penetration", s.penetration, s.penetration >= 0, ">= 0");
  require("drape", "band_stiffness", s.band_stiffness, s.band_stiffness >= 0, ">= 0");
  require("drape", "subdivide", scene.subdivide, scene.subdivide >= 0 && scene.subdivide <= 6, "in [0, 6]");
  if (s.iterations) require("drape", "iterations", *s.iterations, *s.iterations >= 0, ">= 0");
  require("drape", "thickness", s.thickness, s.thickness > 0, "> 0");
  if (s.contact_depth) require("drape", "contact_depth", *s.contact_depth, *s.contact_depth > 0, "> 0");
  if (scene.starts > 1 && !s.animation.empty())
    throw std::invalid_argument("--animation shows one way to rest; leave it out, or --starts");
  if (job.fabrics.size() > 1 && (!job.output.empty() || !s.animation.empty()))
    throw std::invalid_argument("--fabrics writes a picture only; drape each by itself for its mesh");
  if (!(s.residual > 0)) throw std::invalid_argument("--residual takes a number > 0");
  if (s.bending_friction > 0 && scene.material.bending_law == bridge::Bending::plate)
    throw std::invalid_argument(
        "--bending-friction: hinges give way one by one, which a plate's do not; take --bending-law hinge");
  if (s.plain && s.contact_depth)
    throw std::invalid_argument(
        "--contact-depth: --plain moves cloth out to the gap at once; leave out one of them");
  if (s.plain && s.self_contact == SelfContactUse::on)
    throw std::invalid_argument(
        "--self-contact: --plain lets cloth pass through cloth; leave out one of them");
  const std::string output = job.output.string(), animation = s.animation.string();
  if (!output.empty()) check_output(output);
  if (!animation.empty() && !io::animation_format(s.animation))
    throw std::invalid_argument(animation + ": the ending names no animation; choose pc2, mdd or glb");
  check_folder(animation);
  std::vector<std::string> inputs{scene.garment.string()};
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->field}) inputs.push_back(path.string());
  inputs.insert(inputs.end(), job.more_inputs.begin(), job.more_inputs.end());
  std::vector<std::string> outputs{output, animation};
  outputs.insert(outputs.end(), job.more_outputs.begin(), job.more_outputs.end());
  check_replaced(outputs, inputs, listener);
}

/// Once of all settings that were said and that rest has no use for: what moves, and how long.
void warn_of_unused_settings(const io::TomlDocument& document, Listener& listener) {
  std::string names;
  for (const std::string& path : io::settings_without_use(document, io::used_by::drape))
    names += (names.empty() ? "" : ", ") + path;
  if (names.empty()) return;
  listener.warn(
      {"settings_unused", "a garment at rest has no use for " + names + "; furrow simulate has", names, ""});
}

/// The settings with what the garment's file notes, or cotton, unless something is said of what the cloth is.
io::TomlDocument with_fabric(const DrapeJob& job) {
  io::TomlDocument document = job.scene.settings;
  if (!job.fabrics.empty()) return document;
  take_recorded_material(document, garment_of(document, job.scene.folder), job.scene.memory);
  if (!names_cloth(document)) io::set_value(document, "material.preset", "cotton", "furrow drape");
  return document;
}

OpenScene open_scene(const DrapeJob& job, Listener& listener) {
  OpenScene open{{}, with_fabric(job), job.scene.folder, {}};
  open.scene = scene_of(open.document, open.folder);
  if (open.scene.garment.empty())
    throw std::invalid_argument(open.document.name + ": garment.mesh is missing");
  check_inputs(open.scene, open.document, -1, job.scene.memory);
  take_noted_frame(open.scene, open.document, job.scene.memory);
  if (job.subdivide) open.scene.subdivide = *job.subdivide;
  open.frame.unit = open.scene.unit;
  open.frame.up = open.scene.up;
  check(job, open.scene, listener);
  return open;
}

/// One for each fabric, or the scene alone.
std::vector<io::Scene> scenes_of(const DrapeJob& job, const OpenScene& open) {
  if (job.fabrics.empty()) return {open.scene};
  const io::TomlDocument& document = open.document;
  if (document.root.contains("/material/preset"_json_pointer) && !document.is_of_file("material.preset"))
    throw std::invalid_argument("--fabric: --fabrics names the fabrics; leave out one of them");
  std::vector<io::Scene> scenes;
  for (const std::string& fabric : job.fabrics) {
    io::TomlDocument other = document;
    io::set_value(other, "material.preset", fabric, "--fabrics");
    scenes.push_back(scene_of(other, open.folder));
    scenes.back().subdivide = open.scene.subdivide;
  }
  return scenes;
}

}  // namespace

bool DrapeJobReport::fails() const {
  return std::any_of(garments.begin(), garments.end(), [](const Draped& d) { return !d.succeeds(); });
}

DrapeJobReport drape(const DrapeJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  warn_of_unused_settings(job.scene.settings, listener);
  const OpenScene open = open_scene(job, listener);
  const std::vector<io::Scene> scenes = scenes_of(job, open);
  const Context context{open.frame, listener, &job.scene.memory};
  std::optional<BodyCollider> body;
  if (open.scene.body)
    body.emplace(load_body(*open.scene.body, context, tolerance_for(open.scene.simulation.contact_gap)));
  const bool choose =
      !job.subdivide && !open.document.root.value("garment", Json::object()).contains("subdivide");
  DrapeJobReport report{{}, {}, scenes[0], open.frame};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    report.garments.push_back(
        drape_garment(scenes[i], body ? &*body : nullptr, job.settings, choose, context));
    Draped& draped = report.garments.back();
    draped.name = job.fabrics.empty() ? open.scene.garment.stem().string() : job.fabrics[i];
    draped.penetration = job.settings.penetration;
    draped.allowed_crossings = std::size_t(open.scene.allow_crossings);
    if (draped.report.stopped) break;
  }
  if (job.fabrics.size() < 2) note_material(report.garments[0].file, open.document, report.garments[0].gap);
  if (!job.output.empty() && job.output != "-") write_mesh(job.output, report.garments[0].file, context);
  report.remarks = remarks_on(report.garments);
  return report;
}

}  // namespace furrow::jobs
