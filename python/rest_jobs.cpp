// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "io/scene/settings_schema.h"
#include "jobs/chain/keep.h"
#include "jobs/rest/drape.h"
#include "python/keywords.h"

/// Jobs that bring a scene to rest: drape, keep.
namespace furrow::python {
namespace {

// ---- drape

const Keywords<jobs::DrapeJob>& drape_rows() {
  using Job = jobs::DrapeJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "output", "mesh to write; of several garments worn.ply becomes worn-shirt.ply and so on",
          [](auto& j) -> auto& { return j.output; }),
      own<Job>("subdivide", "int | Literal[\"auto\"]",
               "refinements (Loop), 0 to 6; \"auto\", the default: as many as the gap needs",
               [](const Value& v, Job& j) {
                 if (py::isinstance<py::str>(v.given) && py::cast<std::string>(v.given) == "auto") return;
                 take(v, j.subdivide);
               }),
      row<Job>(
          "made_for", "body that the garment was made for and lies about: brought from there to the body",
          [](auto& j) -> auto& { return j.settings.made_for; }),
      row<Job>(
          "fabrics", "the same garment in each of these fabrics; a mesh for each, in the result",
          [](auto& j) -> auto& { return j.fabrics; }),
      row<Job>(
          "animation", "the way to rest, a frame an iteration: pc2, mdd or glb",
          [](auto& j) -> auto& { return j.settings.animation; }),
      own<Job>("band", "Mapping[str, float]",
               "elastic bands: a border loop's name, and the band's length over the loop's, in (0, 2]",
               [](const Value& v, Job& j) {
                 if (!py::isinstance<py::dict>(v.given)) v.fail("a dict such as {\"top\": 0.95}");
                 for (const auto& [loop, length] : py::reinterpret_borrow<py::dict>(v.given)) {
                   jobs::Band band{py::cast<std::string>(py::str(loop)), 0};
                   take(Value{v.keyword, length}, band.length);
                   if (!(band.length > 0 && band.length <= 2))
                     Value{v.keyword, length}.fail("above 0 and at most 2");
                   j.settings.bands.push_back(band);
                 }
               }),
      row<Job>(
          "band_stiffness", "force in a band at twice its length [N], >= 0; default 50",
          [](auto& j) -> auto& { return j.settings.band_stiffness; }),
      row<Job>(
          "bending_friction", "moment that a metre of crease bears before it gives way [N], >= 0; default 0",
          [](auto& j) -> auto& { return j.settings.bending_friction; }),
      row<Job>(
          "residual", "largest net force on a vertex, over its weight, at which it rests, > 0; default 0.001",
          [](auto& j) -> auto& { return j.settings.residual; }),
      row<Job>(
          "contact_depth", "goes on until nothing lies deeper in the gap than this [m], > 0",
          [](auto& j) -> auto& { return j.settings.contact_depth; }),
      choice<Job, jobs::SelfContactUse>(
          "self_contact",
          "whether cloth keeps off cloth; default \"auto\": unless it then finds no rest, or with plain",
          {{"auto", jobs::SelfContactUse::automatic},
           {"on", jobs::SelfContactUse::on},
           {"off", jobs::SelfContactUse::off}},
          [](auto& j) -> auto& { return j.settings.self_contact; }),
      row<Job>(
          "cloth_thickness", "of the cloth, with self_contact [m], > 0; default 0.001",
          [](auto& j) -> auto& { return j.settings.thickness; }),
      choice<Job, jobs::LooseUse>(
          "loose", "what becomes of parts that neither the body nor a pin holds; default \"hold\"",
          {{"hold", jobs::LooseUse::hold}, {"drop", jobs::LooseUse::drop}, {"fall", jobs::LooseUse::fall}},
          [](auto& j) -> auto& { return j.settings.loose; }),
      row<Job>(
          "penetration", "depth to which the body may come through the cloth [m], >= 0; default 0.005",
          [](auto& j) -> auto& { return j.settings.penetration; }),
      row<Job>(
          "budget", "processor time after which the best state so far is the end [s], > 0; default 60",
          [](auto& j) -> auto& { return j.budget; }),
      row<Job>(
          "plain", "paper 2's own scheme, to compare with",
          [](auto& j) -> auto& { return j.settings.plain; }),
      row<Job>(
          "max_iterations", "at most, on each level, >= 0; default 200, with plain 20000",
          [](auto& j) -> auto& { return j.settings.iterations; }),
  };
  return rows;
}

/// Garments over the first: the paths, or meshes into the memory.
std::vector<std::filesystem::path> over_of(const py::list& inputs, Memory& memory) {
  std::vector<std::filesystem::path> over;
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    if (py::isinstance<HeldMesh>(inputs[i]))
      over.emplace_back(memory.add(py::cast<const HeldMesh&>(inputs[i]), "garment"));
    else
      take(Value{"garment", inputs[i]}, over.emplace_back());
  }
  return over;
}

Outcome outcome_of(jobs::DrapeJobReport&& report, const jobs::DrapeJob& job) {
  Outcome outcome{jobs::to_json(report)};
  if (!job.output.empty() && !report.layers) outcome.report["written"] = job.output.string();
  if (report.garments[0].animated) outcome.report["animation"] = job.settings.animation.string();
  for (const jobs::DrapeRemark& r : report.remarks)
    (r.fails ? outcome.failures : outcome.warnings).push_back(r.remark);
  outcome.succeeded = !report.fails() && !report.cancelled();
  for (jobs::Draped& d : report.garments) outcome.meshes.push_back({std::move(d.file), d.name});
  return outcome;
}

Outcome drape(const py::list& inputs, Call& call) {
  jobs::DrapeJob job;
  call.apply(drape_rows(), job);
  CalledScene scene = called_scene(inputs[0], io::used_by::drape, "", call);
  call.require_all_used(words_of(drape_rows(), io::used_by::drape));
  job.scene = std::move(scene.input);
  Memory memory(job.scene.memory);
  job.over = over_of(inputs, memory);
  if (scene.is_file) job.more_inputs.push_back(py::cast<std::string>(py::str(inputs[0])));
  if (call.has("subdivide") && !job.subdivide)  // "auto" goes before the scene's
    if (auto& root = *job.scene.settings.root; root.contains("garment")) root["garment"].erase("subdivide");
  return outcome_of(without_lock(job, call, jobs::drape), job);
}

// ---- keep

struct KeepCall {
  jobs::KeepJob job;
  std::filesystem::path state;
};

/// A flag that turns a field off.
Keyword<KeepCall> no(const char* name, const char* help, bool jobs::KeepJob::*field) {
  return own<KeepCall>(name, "bool", help, [field](const Value& v, KeepCall& c) {
    bool off = false;
    take(v, off);
    c.job.*field = !off;
  });
}

const Keywords<KeepCall>& keep_rows() {
  static const Keywords<KeepCall> rows = {
      row<KeepCall>(
          "state", "a saved state, with lines drawn on the cloth as it hangs or lies",
          [](auto& c) -> auto& { return c.state; }),
      row<KeepCall>(
          "run", "how long each trial runs forward from rest [s], > 0; default 5",
          [](auto& c) -> auto& { return c.job.seconds; }),
      row<KeepCall>(
          "gust", "and an acceleration to each of four sides [m/s^2], >= 0; default 12",
          [](auto& c) -> auto& { return c.job.gust; }),
      own<KeepCall>("kept", "float | str",
                    "share of its height with which a line holds, in (0, 1); default 0.95",
                    [](const Value& v, KeepCall& c) { take_share(v, c.job.kept); }),
      no("no_balance", "do not turn what hangs on a line of pins into balance", &jobs::KeepJob::balance),
      no("no_settle", "keep the garment where it lies, though nothing holds it there",
         &jobs::KeepJob::settle),
      no("no_help", "no press, struts or lower height where the rest state does not hold",
         &jobs::KeepJob::help),
      no("fast", "searches for rest alone: what is called held is so at rest, and may be lost in motion",
         &jobs::KeepJob::prove),
      row<KeepCall>(
          "whole", "press what lies between the lines, too, where it could give way",
          [](auto& c) -> auto& { return c.job.whole; }),
      row<KeepCall>(
          "budget", "processor time after which the last rest state is the end [s], > 0; default 300",
          [](auto& c) -> auto& { return c.job.budget; }),
  };
  return rows;
}

Outcome keep(const py::list& inputs, Call& call) {
  KeepCall c;
  call.apply(keep_rows(), c);
  CalledScene scene = called_scene(inputs[0], io::used_by::keep, c.state, call);
  call.require_all_used(words_of(keep_rows(), io::used_by::keep));
  c.job.scene = std::move(scene.input);
  c.job.state = std::move(scene.state);
  c.job.state_path = scene.state_path;
  jobs::KeepReport report = without_lock(c.job, call, jobs::keep);
  if (!report.ran) {
    call.listener.rethrow();
    throw physics::Cancelled("cancelled");
  }
  Outcome outcome{jobs::to_json(report)};
  Json& written = outcome.report["written"] = Json::array();
  for (const auto& file : {report.mesh, report.saved_state})
    if (!file.empty()) written.push_back(file.string());
  outcome.warnings = report.warnings;
  outcome.succeeded = report.all_hold() && !report.lines.interrupted;
  if (!report.all_hold())
    outcome.failures.push_back({"not_kept", "not every line holds; the report says which, and why", "", ""});
  outcome.meshes.push_back({std::move(report.garment), garment_name(c.job.scene)});
  return outcome;
}

}  // namespace

void add_rest_jobs(std::vector<Runner>& runners) {
  runners.push_back({"drape", words_of(drape_rows(), io::used_by::drape), drape});
  runners.push_back({"keep", words_of(keep_rows(), io::used_by::keep), keep});
}

}  // namespace furrow::python
