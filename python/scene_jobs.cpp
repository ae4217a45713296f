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

/// Those of its card, and who watches.
Keywords simulate_keywords(jobs::SimulateJob& job) {
  Keywords keywords = keywords_of(card(job));
  keywords.push_back(
      {{"watch", "Watch",
        "called with (time [s], positions n x 3 [m], a copy) as the run goes on, at most every 0.2 s "
        "or at each long step"},
       [](const Value& v) {
         if (!PyCallable_Check(v.given.ptr())) v.fail("callable");
       }});
  return keywords;
}

void check_accuracy(const jobs::SimulateJob& job, const Call& call) {
  if (!job.tolerance && call.has("budget"))
    throw std::invalid_argument(
        "budget: it bounds the choice for accuracy; give that, too, or leave out budget");
  if (!job.tolerance) return;
  if (!job.state_path.empty())
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
  jobs::SimulateJob job;
  call.apply(simulate_keywords(job));
  CalledScene scene = called_scene(inputs[0], io::used_by::simulate, job.state_path, call);
  call.require_all_used(words_of(simulate_keywords(job), io::used_by::simulate));
  check_accuracy(job, call);
  job.scene = std::move(scene.input);
  job.state = std::move(scene.state);
  job.state_path = scene.state_path;
  job.watch = watch;
  return outcome_of(without_lock(job, call, jobs::simulate), garment_name(job.scene));
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

std::vector<KeywordWords> chart_words() {
  std::vector<KeywordWords> words = words_of_card<jobs::ChartJob>();
  words.push_back(setting_keywords(io::used_by::nobody).back());  // settings alone
  return words;
}

Outcome chart(const py::list& inputs, Call& call) {
  jobs::ChartJob job;
  call.apply(keywords_of(card(job)));
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
  jobs::SimulateJob none;
  runners.push_back({"simulate", words_of(simulate_keywords(none), io::used_by::simulate),
                     [](const py::list& inputs, Call& call) {
                       const py::object callable = call.value("watch");
                       return simulate(inputs, call, watch_of(call, callable));
                     }});
  runners.push_back({"chart", chart_words(), chart});
}

}  // namespace furrow::python
