// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/settings_schema.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/chain/wrinkle_stages.h"
#include "jobs/cloth/fabric_file.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/draw/wrinkle_reports.h"
#include "jobs/rest/drape.h"
#include "python/keywords.h"
#include "python/smoothing_rows.h"

/// furrow.wrinkle: lines become wrinkles.
namespace furrow::python {
namespace {

struct WrinkleCall {
  jobs::WrinkleJob job;
  std::filesystem::path state;
  bool keep = false, settle = false;
};

std::vector<Keyword<WrinkleCall>> drawing_rows() {
  using Call = WrinkleCall;
  using namespace geometry;
  return {
      row<Call>(
          "height", "of strokes that name none [m]; > 0 ridge, < 0 valley; default 0.01",
          [](auto& c) -> auto& { return c.job.height; }),
      row<Call>(
          "width",
          "of the fold of strokes that name none [m], > 0; default some five heights, by the rules safe and "
          "paper as wide as smoothing makes it",
          [](auto& c) -> auto& { return c.job.width; }),
      row<Call>(
          "max_distance", "how far a stroke may lie from the surface [m], > 0; default 0.05",
          [](auto& c) -> auto& { return c.job.options.insertion.max_distance; }),
      choice<Call, InsertionRule>(
          "rule",
          "\"fold\", the default: smooth folds; \"safe\": a chain of vertices; \"paper\": the plain rule",
          {{"fold", InsertionRule::fold}, {"safe", InsertionRule::safe}, {"paper", InsertionRule::paper}},
          [](auto& c) -> auto& { return c.job.options.insertion.rule; }),
      own<Call>("rest", "Literal[\"drawn\", \"flat\", \"copied\", \"keep\"]",
                "what the rest state learns of the lines; \"keep\": the drawn shape bears its weight; "
                "default drawn",
                [](const Value& v, Call& c) {
                  std::string word;
                  take(v, word);
                  c.keep = word == "keep";
                  if (word == "flat") c.job.options.rest = RestRule::flat;
                  if (word == "copied") c.job.options.rest = RestRule::copied;
                  if (word != "drawn" && word != "flat" && word != "copied" && word != "keep")
                    v.fail("drawn, flat, copied or keep");
                }),
      choice<Call, SmoothingRegion>(
          "region", "what is smoothed; default \"two-ring\", around the lines",
          {{"two-ring", SmoothingRegion::two_ring}, {"whole-mesh", SmoothingRegion::whole_mesh}},
          [](auto& c) -> auto& { return c.job.options.region; }),
      choice<Call, Detail>(
          "detail", "rule fold: how fine the mesh around folds becomes; default normal",
          {{"coarse", Detail::coarse}, {"normal", Detail::normal}, {"fine", Detail::fine}},
          [](auto& c) -> auto& { return c.job.options.detail; }),
      row<Call>(
          "fold_iterations", "rule fold: pairs of smoothing steps after the folds are raised; default 5",
          [](auto& c) -> auto& { return c.job.options.fold_iterations; }),
      row<Call>(
          "flat_base", "rule fold: new vertices stay on the facets of the garment",
          [](auto& c) -> auto& { return c.job.options.flat_base; }),
      row<Call>(
          "density", "mass of the cloth [kg/m^2], > 0; default that of the garment, else 0.15",
          [](auto& c) -> auto& { return c.job.density; }),
      row<Call>(
          "max_weights", "skin weights that each vertex keeps, >= 0; default as interpolated",
          [](auto& c) -> auto& { return c.job.max_weights; }),
  };
}

const Keywords<WrinkleCall>& wrinkle_rows() {
  using Call = WrinkleCall;
  static const Keywords<Call> rows = [] {
    Keywords<Call> list = {
        row<Call>(
            "output", "mesh to write; with state: a state", [](auto& c) -> auto& { return c.job.output; }),
        row<Call>(
            "state", "draw into a simulation that was stopped; then without a garment",
            [](auto& c) -> auto& { return c.state; }),
        row<Call>(
            "fade", "with state: how slowly the forces of the new lines set in [s], > 0; default 0.3",
            [](auto& c) -> auto& { return c.job.fade; }),
        row<Call>(
            "without", "names of strokes to leave out", [](auto& c) -> auto& { return c.job.without; }),
        row<Call>(
            "inserted", "also write the mesh after insertion and before smoothing",
            [](auto& c) -> auto& { return c.job.inserted; }),
        row<Call>(
            "settle",
            "let what is drawn come to rest, as drape does, with lines that last; rest \"drawn\": as it "
            "falls",
            [](auto& c) -> auto& { return c.settle; }),
        row<Call>(
            "made_for",
            "with settle: body that the garment was made for and lies about: brought from there to the body",
            [](auto& c) -> auto& { return c.job.made_for; }),
        row<Call>(
            "budget",
            "with settle: processor time after which the best state so far is the end [s], > 0; default 60",
            [](auto& c) -> auto& { return c.job.budget; }),
        own<Call>(
            "subdivide", "int | Literal[\"auto\"]",
            "with settle: refinements (Loop) before the lines are drawn, 0 to 4; default as the gap needs",
            [](const Value& v, Call& c) {
              if (py::isinstance<py::str>(v.given) && py::cast<std::string>(v.given) == "auto") return;
              take(v, c.job.subdivide);
            }),
        row<Call>(
            "smoothed", "with settle: also write the garment as drawn",
            [](auto& c) -> auto& { return c.job.smoothed; }),
    };
    for (auto& rows_of : {drawing_rows(), smoothing_rows<Call>([](Call& c) -> geometry::TaubinOptions& {
                            return c.job.options.smoothing;
                          })})
      list.insert(list.end(), rows_of.begin(), rows_of.end());
    return list;
  }();
  return rows;
}

/// Options that the rule in use would not look at are refused, rather than ignored.
void check_call(const WrinkleCall& c, const Call& call) {
  const bool folds = c.job.options.insertion.rule == geometry::InsertionRule::fold;
  const std::vector<const char*> of_paper{"iterations", "weights", "keep_lines", "keep_border", "region"};
  const std::vector<const char*> of_fold{"detail", "fold_iterations", "flat_base"};
  for (const char* name : folds ? of_paper : of_fold)
    if (call.has(name))
      throw std::invalid_argument(std::string(name) + ": the rule does not use it; it goes with rule " +
                                  (folds ? "safe or paper" : "fold"));
  const auto refuse = [](bool wrong, const char* why) {
    if (wrong) throw std::invalid_argument(why);
  };
  refuse(call.has("subdivide") && !c.settle,
         "subdivide: goes with settle; furrow.subdivide refines by itself");
  refuse(c.job.density && !c.state.empty(), "density: that of a state is changed by furrow.simulate");
}

/// What the garment is kept in, or comes to rest in: material, forces, pins and body.
jobs::SceneInput surroundings(const WrinkleCall& c, py::handle garment, Call& call) {
  jobs::SceneInput scene;
  Memory memory(scene.memory);
  if (c.job.state) scene.settings = io::document_of(c.job.state->scene, c.state.string());
  scene.folder = c.job.state_path.parent_path();
  const jobs::Frame frame = std::exchange(call.frame, {});  // that of the job, not of the settings
  call.apply_settings(io::used_by::wrinkle, scene.settings, memory);
  call.frame = frame;
  jobs::take_fabric_file(scene.settings, scene.folder);
  if (py::isinstance<HeldMesh>(garment)) {
    jobs::MemoryFiles named;
    named.meshes["garment"] = py::cast<const HeldMesh&>(garment).file;
    jobs::take_recorded_material(scene.settings, "garment", named);
  } else if (const auto* path = std::get_if<std::filesystem::path>(&c.job.garment); path && !c.job.state) {
    jobs::take_recorded_material(scene.settings, *path);
  }
  if (c.job.density) io::set_value(scene.settings, "material.density", *c.job.density, "`density`");
  if (c.keep && !c.settle) io::set_value(scene.settings, "garment.rest", "keep", "`rest=keep`");
  return scene;
}

WrinkleCall called(const py::list& inputs, Call& call) {
  WrinkleCall c;
  call.apply(wrinkle_rows(), c);
  check_call(c, call);
  c.job.frame = call.frame;
  if (!c.state.empty()) {
    if (!inputs[0].is_none()) throw std::invalid_argument("state: it has its garment; leave out the mesh");
    c.job.state = io::read_state(c.state);
    c.job.state_path = c.state;
  } else {
    take(Value{"garment", inputs[0]}, c.job.garment);
  }
  take(Value{"strokes", inputs[1]}, c.job.strokes);
  if (c.keep && !c.settle) c.job.keep = surroundings(c, inputs[0], call);
  c.job.hold = c.keep || !call.has("rest");
  if (c.settle) c.job.settle = surroundings(c, inputs[0], call);
  return c;
}

Outcome wrinkle(const py::list& inputs, Call& call) {
  const WrinkleCall c = called(inputs, call);
  call.require_all_used(words_of(wrinkle_rows(), c.keep || c.settle ? io::used_by::wrinkle : 0));
  jobs::WrinkleReport report = without_lock(c.job, call, jobs::wrinkle);
  Outcome outcome{jobs::to_json(report)};
  Json& written = outcome.report["written"] = Json::array();
  for (const auto& file : {c.job.output, c.job.inserted, c.job.smoothed})
    if (!file.empty()) written.push_back(file.string());
  outcome.failures = report.failures;
  outcome.succeeded = report.failures.empty() && !(report.rest && report.rest->report.stopped);
  const auto* path = std::get_if<std::filesystem::path>(&c.job.garment);
  outcome.meshes.push_back({std::move(report.garment), path ? path->stem().string() : "garment"});
  return outcome;
}

}  // namespace

void add_wrinkle(std::vector<Runner>& runners) {
  runners.push_back({"wrinkle", words_of(wrinkle_rows(), io::used_by::wrinkle), wrinkle});
}

}  // namespace furrow::python
