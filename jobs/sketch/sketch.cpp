// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geometry/mesh/self_intersections.h"
#include "io/base/atomic_file.h"
#include "io/scene/fabrics.h"
#include "io/scene/relocated.h"
#include "io/stroke/touch_file.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/world_body.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/cloth/pins.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/draw/line_round.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/made_for.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

/// A sketch is read again and again, and in one that comes from elsewhere nothing is to wait for a pipe.
void require_regular(const fs::path& path) {
  if (fs::is_other(fs::status(path)))
    throw geometry::ContentError(path.string() +
                                 ": is no regular file; the studio reads it more than once, so copy "
                                 "it to one");
}

/// The scene, in the frame that its garment notes.
io::Scene scene_in_frame(SceneInput& input) {
  io::Scene scene = scene_of(input.settings, input.folder);
  if (scene.garment.empty())
    throw std::invalid_argument(input.settings.name + ": garment.mesh is missing: name the garment");
  check_inputs(scene, input.settings, -1);
  require_regular(scene.garment);
  if (scene.body) require_regular(scene.body->mesh);
  if (scene.body) require_regular(scene.body->frames);
  for (const io::SceneLines& round : scene.lines) require_regular(round.strokes);
  take_noted_frame(scene, input.settings);
  return scene;
}

Frame frame_of_scene(const io::Scene& scene) {
  Frame frame;
  frame.unit = scene.unit;
  frame.up = scene.up;
  return frame;
}

std::size_t rounds_at_start(const io::Scene& scene) {
  return std::size_t(std::count_if(scene.lines.begin(), scene.lines.end(),
                                   [](const io::SceneLines& l) { return l.time == 0; }));
}

void check_rounds(const io::Scene& scene, const std::string& name, Listener& listener) {
  if (rounds_at_start(scene) > 1)
    throw std::invalid_argument(name +
                                ": lines: the studio draws one round of lines at time 0, and there are " +
                                std::to_string(rounds_at_start(scene)) +
                                "; join their strokes in one file, or run it with `furrow simulate`");
  if (scene.lines.size() > rounds_at_start(scene))
    listener.warn({"later_lines",
                   name + ": lines that are drawn later are not shown; they stay in the saved scene", name,
                   "lines.time"});
}

std::vector<io::DrawnStroke> parsed(const Json& strokes) {
  return io::drawn_strokes_from(Json{{"strokes", strokes}}.dump(), "the drawing");
}

/// The settings of what comes to rest: those of the scene, without its lines.
SceneInput at_rest_settings(const Sketch& sketch) {
  SceneInput input = sketch.scene;
  input.settings.root->erase("lines");
  input.settings.root->erase("output");
  input.settings.root->erase("title");
  if (input.settings.root->contains("garment")) input.settings.root["garment"].erase("subdivide");
  if (input.settings.root->contains("simulation"))
    input.settings.root["simulation"].erase(
        "integrator");  // which open_sketch() chose, and no search for rest uses
  return input;
}

/// Passes all on, and keeps what is warned of.
class Collecting : public Listener {
 public:
  explicit Collecting(Listener& other) : other_(other) {}
  void progress(const std::string& what, double share) override { other_.progress(what, share); }
  void warn(const Warning& warning) override { texts.push_back(warning.text); }
  bool cancelled() override { return other_.cancelled(); }
  bool allows(const std::string& demand) override { return other_.allows(demand); }
  bool replaces(const std::string& path) override { return other_.replaces(path); }

  std::vector<std::string> texts;

 private:
  Listener& other_;
};

WrinkleJob job_for(const Sketch& sketch, const Json& strokes) {
  WrinkleJob job;
  job.garment = sketch.garment;
  job.strokes = parsed(strokes);
  job.frame = sketch.frame;
  job.options = sketch.options;
  job.density = sketch.density;
  job.crossed = sketch.crossed;
  job.crossings = sketch.crossings;
  job.wants_quality = false;
  job.budget = std::numeric_limits<double>::infinity();  // whoever draws sees it and cancels
  return job;
}

/// The garment without strokes, as furrow drape takes it.
DrapeJob plain_job(const Sketch& sketch) {
  DrapeJob job;
  job.budget = std::numeric_limits<double>::infinity();
  job.scene = at_rest_settings(sketch);
  io::set_value(job.scene.settings, "garment.mesh", "the garment", "the studio");
  job.scene.memory.meshes["the garment"] = sketch.garment;
  job.settings.made_for = sketch.made_for;
  return job;
}

SketchAtRest drape_plain(const Sketch& sketch, Listener& listener) {
  DrapeJobReport report = drape(plain_job(sketch), listener);
  if (report.cancelled()) throw physics::Cancelled("cancelled");
  SketchAtRest rest{std::move(report.garments[0].file), report.garments[0].outcome(), {}};
  for (const DrapeRemark& r : report.remarks)
    if (r.fails) rest.remarks.push_back(r.remark.text);
  return rest;
}

/// A table as TOML; tables inside it stand in braces.
void write_table(std::ostream& out, const Json& table, const std::string& heading) {
  if (!heading.empty()) out << "\n" << heading << "\n";
  for (const auto& [key, value] : table.items()) out << key << " = " << io::value_text(value) << "\n";
}

std::string toml_of(const Json& settings) {
  std::ostringstream out;
  Json root = Json::object();
  const auto is_list = [](const Json& v) { return v.is_array() && !v.empty() && v[0].is_object(); };
  for (const auto& [key, value] : settings.items())
    if (!value.is_object() && !is_list(value) && !value.empty()) root[key] = value;
  write_table(out, root, "");
  for (const auto& [key, value] : settings.items()) {
    if (value.is_object() && !value.empty()) write_table(out, value, "[" + key + "]");
    if (is_list(value))
      for (const Json& row : value) write_table(out, row, "[[" + key + "]]");
  }
  return out.str();
}

}  // namespace

Sketch open_sketch(const SceneInput& input, Listener& listener, const fs::path& made_for) {
  Sketch sketch;
  sketch.scene = input;
  sketch.made_for = made_for;
  require_regular(made_for);
  for (const char* list : {"lines", "pins"}) io::make_list(sketch.scene.settings, list);
  if (!sketch.scene.settings.root->value("material", Json::object()).contains("preset"))
    io::set_value(sketch.scene.settings, "material.preset", "cotton", "the studio");
  const Json simulation = sketch.scene.settings.root->value("simulation", Json::object());
  if (!simulation.contains("integrator") && !simulation.contains("dt"))  // at a step that can be watched
    io::set_value(sketch.scene.settings, "simulation.integrator", "implicit", "the studio");
  const io::Scene scene = scene_in_frame(sketch.scene);
  check_made_for(made_for, scene);
  check_rounds(scene, sketch.scene.settings.name, listener);
  sketch.frame = frame_of_scene(scene);
  const Context context{sketch.frame, listener};
  sketch.garment = begin_garment(scene, context);
  sketch.pins = find_pins(sketch.garment, scene.pins);
  sketch.crossed = std::make_shared<const CrossedStart>(crossed_start(sketch.garment.mesh));
  sketch.crossings = std::make_shared<geometry::CrossingMemory>();
  sketch.density = scene.material.density;
  if (rounds_at_start(scene) == 1) {
    const auto round = std::find_if(scene.lines.begin(), scene.lines.end(),
                                    [](const io::SceneLines& l) { return l.time == 0; });
    sketch.options = round->options;
  }
  sketch.options.memory = geometry::make_fold_memory();
  if (!made_for.empty())
    sketch.body = read_mesh(made_for, context);
  else if (scene.body)
    sketch.body = read_mesh(scene.body->mesh, {with_unit(sketch.frame, scene.body->unit), listener});
  return sketch;
}

std::shared_ptr<BodyShelf> make_shelf() { return std::make_shared<BodyShelf>(); }

void check_made_for(const Sketch& sketch, Listener& listener) {
  if (sketch.made_for.empty()) return;
  const io::Scene scene = scene_of(sketch.scene.settings, sketch.scene.folder);
  const physics::TriangleMesh body =
      read_body(scene.body->mesh, {with_unit(sketch.frame, scene.body->unit), listener});
  const MadeFor pair = read_made_for(sketch.made_for, body, *scene.body, {sketch.frame, listener});
  heed(faults_of_pair(sketch.garment.mesh, pair.outline, true), scene.garment.string(),
       {sketch.frame, listener});
}

Json strokes_of(const Sketch& sketch, Listener& listener) {
  const io::Scene scene = scene_of(sketch.scene.settings, sketch.scene.folder);
  for (const io::SceneLines& round : scene.lines) {
    if (round.time != 0 || round.strokes.empty()) continue;
    const auto strokes = read_strokes(round, {sketch.frame, listener});
    std::ostringstream text;
    io::write_strokes(text, strokes);
    return Json::parse(text.str())["strokes"];
  }
  return Json::array();
}

Json settings_for(const Sketch& sketch, const fs::path& folder) {
  Json settings = io::relocated(sketch.scene.settings, sketch.scene.folder, folder);
  if (sketch.frame.unit) settings["unit"] = *sketch.frame.unit;
  if (sketch.frame.up) settings["up"] = *sketch.frame.up;
  settings.erase("output");  // what the scene wrote is not for the studio to replace
  return settings;
}

SketchedGarment draw_sketch(const Sketch& sketch, const Json& strokes, Listener& listener) {
  SketchedGarment drawn;
  std::vector<std::vector<int>> pins = sketch.pins;
  if (strokes.empty()) {
    drawn.file = sketch.garment;
    drawn.shown = shown_mesh(drawn.file.mesh, {}, 1 << 30);
  } else {
    Collecting collecting(listener);
    WrinkleReport report = wrinkle(job_for(sketch, strokes), collecting);
    const LineRound& round = report.drawn.round;
    drawn.file = std::move(report.garment);
    drawn.shown = shown_mesh(drawn.file.mesh, round.report.undisplaced, round.first_line);
    drawn.told = std::move(collecting.texts);
    for (const Warning& w : report.failures) drawn.told.push_back(w.text);
    pin_new_vertices(drawn.file.mesh, sketch.garment.mesh->number_of_vertices(), pins);
  }
  for (const std::vector<int>& group : pins)
    for (const int v : group) drawn.shown.pinned.push_back(std::uint32_t(v));
  return drawn;
}

SketchAtRest drape_sketch(const Sketch& sketch, const Json& strokes, Listener& listener) {
  if (strokes.empty()) return drape_plain(sketch, listener);
  WrinkleJob job = job_for(sketch, strokes);
  job.settle = at_rest_settings(sketch);
  job.hold = sketch.options.rest == geometry::RestRule::drawn;
  job.made_for = sketch.made_for;
  WrinkleReport report = wrinkle(job, listener);
  if (listener.cancelled() || report.rest->report.stopped) throw physics::Cancelled("cancelled");
  SketchAtRest rest{std::move(report.garment), report.rest->outcome(), {}};
  for (const Warning& w : report.failures) rest.remarks.push_back(w.text);
  return rest;
}

TouchedSketch touch_sketch(const Sketch& sketch, const Json& wanted, Listener& listener) {
  DrapeJob job = plain_job(sketch);
  job.settings.touches = io::touches_from(Json{{"touches", {wanted}}}.dump(), "the studio");
  Touched touched = touch(job, listener);
  const TouchReport& report = touched.touches.at(0);
  return {std::move(touched.file), geometry::word_of(report.touch.kind), report.moved, report.balances,
          touched.crossings};
}

void write_sketched(const Sketch& sketch, const io::MeshFile& file, const fs::path& path,
                    Listener& listener) {
  write_mesh(path, file, {sketch.frame, listener});
}

std::vector<std::string> save_sketch(const Sketch& sketch, const Json& strokes, const fs::path& folder,
                                     Listener& listener) {
  const SketchedGarment drawn = draw_sketch(sketch, strokes, listener);
  Json settings = io::relocated(sketch.scene.settings, sketch.scene.folder, folder);
  Json lines = Json::array(), later = settings.value("lines", Json::array());
  Json first = Json::object();
  for (const Json& round : later)
    if (round.value("time", 0.0) == 0) first = round;
  first["strokes"] = "strokes.json";
  first.erase("without");
  if (!strokes.empty()) lines.push_back(first);
  for (const Json& round : later)
    if (round.value("time", 0.0) != 0) lines.push_back(round);
  settings["lines"] = lines;
  io::OutputGroup together;
  std::vector<std::string> written{"scene.toml", "shape.ply"};
  if (!strokes.empty()) {
    io::write_strokes(folder / "strokes.json", parsed(strokes), write_options(sketch.frame));
    written.push_back("strokes.json");
  }
  write_sketched(sketch, drawn.file, folder / "shape.ply", listener);
  io::write_atomically(folder / "scene.toml", [&](std::ostream& out) {
    out << "# Written by furrow studio; furrow simulate runs it.\n" << toml_of(settings);
  });
  together.commit();
  return written;
}

std::vector<std::string> save_motion(const SketchMotion& motion, const Frame& frame, const fs::path& folder) {
  Json settings = motion.settings, first = Json::object(), lines = Json::array();
  for (const Json& round : settings.value("lines", Json::array()))
    if (round.value("time", 0.0) == 0) first = round;
  first.erase("without");
  io::OutputGroup together;
  std::vector<std::string> written{"motion.toml"};
  for (const auto& [time, strokes] : motion.rounds) {
    first["time"] = time;
    first["strokes"] = "motion-strokes-" + std::to_string(lines.size() + 1) + ".json";
    io::write_strokes(folder / first["strokes"].get<std::string>(), parsed(strokes), write_options(frame));
    written.push_back(first["strokes"]);
    lines.push_back(first);
  }
  settings["lines"] = lines;
  settings["simulation"]["seconds"] = motion.longest;
  settings["simulation"]["stop_at"] = motion.time - 1e-6;  // the rounding of a sum of steps
  io::write_atomically(folder / "motion.toml", [&](std::ostream& out) {
    out << "# Written by furrow studio: what was played, and drawn meanwhile; furrow simulate does it "
           "again.\n"
        << toml_of(settings);
  });
  together.commit();
  return written;
}

std::string shape_bits(const io::MeshFile& file) {
  std::string bits;
  const auto add = [&bits](const auto& number) {
    bits.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  for (const geometry::Vertex v : file.mesh->vertices())
    for (int k = 0; k < 3; ++k) add(double(file.mesh->point(v)[k]));
  for (const geometry::Face f : file.mesh->faces())
    for (const geometry::Vertex v : file.mesh->vertices_around_face(file.mesh->halfedge(f))) add(v.idx());
  return bits;
}

std::vector<FabricChoice> fabric_choices() {
  constexpr double gravity = 9.81;
  std::vector<FabricChoice> choices;
  for (const io::Fabric& fabric : io::fabrics()) {
    const double length = std::cbrt(fabric.rigidity / (fabric.density * gravity));
    const char* const feel = length < 0.014   ? "flowing"
                             : length < 0.023 ? "soft"
                             : length < 0.028 ? "firm"
                                              : "stiff";
    choices.push_back({fabric.name, fmt::format("{:.0f} g/m², {}", 1000 * fabric.density, feel)});
  }
  return choices;
}

}  // namespace furrow::jobs
