// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>

#include <algorithm>

#include "io/scene/equivalent_flags.h"
#include "io/scene/settings_schema.h"
#include "jobs/move/judge_report.h"
#include "jobs/move/simulate.h"
#include "python/keywords.h"

/// Jobs that move a scene: simulate, chart.
namespace furrow::python {
namespace {

// ---- simulate

struct SimulateCall {
  jobs::SimulateJob job;
  std::filesystem::path state;
};

const Keywords<SimulateCall>& simulate_rows() {
  static const Keywords<SimulateCall> rows = {
      row<SimulateCall>(
          "state", "a saved state to go on from; then without a garment",
          [](auto& c) -> auto& { return c.state; }),
      own<SimulateCall>(
          "accuracy", "float | str",
          "error of the result that is accepted, as a share of the garment's diagonal, in (0, 1): "
          "integrator and step are chosen for it",
          [](const Value& v, SimulateCall& c) { take_share(v, c.job.tolerance.emplace()); }),
      row<SimulateCall>(
          "budget", "predicted seconds of one thread that choosing for accuracy may take; default 60",
          [](auto& c) -> auto& { return c.job.budget; }),
      row<SimulateCall>(
          "outputs_below", "folder that outputs named by a scene file must lie in; default the scene's",
          [](auto& c) -> auto& { return c.job.outputs_below; }),
      row<SimulateCall>(
          "times", "tell what the processor's time goes to", [](auto& c) -> auto& { return c.job.times; }),
      own<SimulateCall>(
          "watch", "Watch",
          "called with (time [s], positions n x 3 [m], a copy) as the run goes on, at most every "
          "0.2 s or at each long step",
          [](const Value& v, SimulateCall&) {
            if (!PyCallable_Check(v.given.ptr())) v.fail("callable");
          }),
  };
  return rows;
}

void check_accuracy(const SimulateCall& c, const Call& call) {
  if (!c.job.tolerance && call.has("budget"))
    throw std::invalid_argument(
        "budget: it bounds the choice for accuracy; give that, too, or leave out budget");
  if (!c.job.tolerance) return;
  if (!c.state.empty())
    throw std::invalid_argument(
        "accuracy: it judges a scene from its beginning; leave out accuracy or state");
  for (const char* chosen : {"integrator", "dt", "sweeps"})
    if (call.has(chosen))
      throw std::invalid_argument(std::string("accuracy: it chooses integrator and step, and ") + chosen +
                                  " names one; leave out one of them");
}

Outcome outcome_of(jobs::SimulateReport&& report, const std::string& garment) {
  Outcome outcome{jobs::to_json(report)};
  outcome.warnings = report.warnings;
  if (!report.ran) {
    outcome.failures.push_back({"no_choice", jobs::words(*report.choice, report.scene_dt), "", ""});
    outcome.succeeded = false;
    return outcome;
  }
  outcome.report["flags"] = io::equivalent_flags(report.settings, report.state, report.settings_before);
  if (!report.failure.empty()) outcome.failures.push_back({"diverged", report.failure, "", ""});
  for (const jobs::Fault& fault : report.faults) outcome.failures.push_back(fault.told);
  outcome.succeeded = !report.fails() && report.run.outcome != physics::Outcome::stopped_by_observer;
  if (report.failure.empty()) outcome.meshes.push_back({std::move(report.garment), garment});
  return outcome;
}

Outcome simulate(const py::list& inputs, Call& call, const jobs::Watch& watch) {
  SimulateCall c;
  call.apply(simulate_rows(), c);
  CalledScene scene = called_scene(inputs[0], io::used_by::simulate, c.state, call);
  call.require_all_used(words_of(simulate_rows(), io::used_by::simulate));
  check_accuracy(c, call);
  c.job.scene = std::move(scene.input);
  c.job.state = std::move(scene.state);
  c.job.state_path = scene.state_path;
  c.job.watch = watch;
  return outcome_of(without_lock(c.job, call, jobs::simulate), garment_name(c.job.scene));
}

/// What `watch` is called with, in the thread of the call; it takes the interpreter's lock.
jobs::Watch watch_of(Call& call, const py::object& callable) {
  if (!callable) return {};
  return [&call, &callable](double time, std::span<const physics::Vec3> x) {
    call.listener.tell([&] {
      const py::ssize_t n = py::ssize_t(x.size());
      py::array_t<double> positions({n, py::ssize_t(3)});
      for (std::size_t i = 0; i < x.size(); ++i)
        std::copy_n(x[i].data(), 3, positions.mutable_data(py::ssize_t(i)));
      callable(time, positions);
    });
  };
}

// ---- chart

const Keywords<jobs::ChartJob>& chart_rows() {
  using Job = jobs::ChartJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "output", "picture to draw: svg or png, by gnuplot; its numbers as .csv beside it",
          [](auto& j) -> auto& { return j.picture; }),
      row<Job>(
          "csv", "file for the chart's numbers", [](auto& j) -> auto& { return j.csv; }),
      own<Job>("accuracy", "float | str",
               "error that is accepted, as a share of the garment's diagonal; default 0.01",
               [](const Value& v, Job& j) { take_share(v, j.options.tolerance); }),
      row<Job>(
          "budget", "predicted seconds of one thread for all runs [s], > 0; default 60",
          [](auto& j) -> auto& { return j.options.budget; }),
  };
  return rows;
}

std::vector<KeywordWords> chart_words() {
  std::vector<KeywordWords> words = words_of(chart_rows());
  words.push_back(setting_keywords(io::used_by::nobody).back());  // settings alone
  return words;
}

Outcome chart(const py::list& inputs, Call& call) {
  jobs::ChartJob job;
  call.apply(chart_rows(), job);
  job.name = py::isinstance<HeldMesh>(inputs[0]) || py::isinstance<py::dict>(inputs[0])
                 ? "scene"
                 : py::cast<std::string>(py::str(inputs[0]));
  job.scene = called_scene(inputs[0], io::used_by::nobody, "", call).input;
  call.require_all_used(chart_words());
  if (job.csv.empty() && !job.picture.empty())
    job.csv = std::filesystem::path(job.picture).replace_extension(".csv");
  const jobs::ChartReport report = without_lock(job, call, jobs::chart);
  Outcome outcome{jobs::to_json(report)};
  outcome.succeeded = report.judgement.has_answer();
  if (!outcome.succeeded)
    outcome.failures.push_back({"no_choice", jobs::words(report.judgement, report.scene_dt), "", ""});
  return outcome;
}

}  // namespace

void add_scene_jobs(std::vector<Runner>& runners) {
  runners.push_back(
      {"simulate", words_of(simulate_rows(), io::used_by::simulate), [](const py::list& inputs, Call& call) {
         const py::object callable = call.value("watch");
         return simulate(inputs, call, watch_of(call, callable));
       }});
  runners.push_back({"chart", chart_words(), chart});
}

}  // namespace furrow::python
