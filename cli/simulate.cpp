// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/simulate.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/print_text.h"
#include "cli/scene_flags.h"
#include "cli/subcommands.h"
#include "io/scene/equivalent_flags.h"
#include "jobs/base/read_inputs.h"
#include "jobs/move/judge_report.h"

namespace furrow::cli {
namespace {

struct SimulateArguments : CommonArguments {
  std::string in;
  SimulateJob job;
  SceneFlags flags;
};

/// Throws UsageError for an accuracy beside what it chooses, and a budget without one.
void check_accuracy(const SimulateArguments& a, const SimulateJob& job) {
  if (!job.tolerance && a.typed->count("--budget"))
    throw UsageError("--budget bounds the choice for --accuracy 1%; give that, too, or leave out --budget");
  if (!job.tolerance) return;
  const std::string accuracy = a.typed->get_option("--accuracy")->as<std::string>();
  if (job.state)
    throw UsageError("--accuracy " + accuracy +
                     " judges a scene from its beginning; leave out one of the two");
  const io::TomlDocument& settings = job.scene.settings;
  const Json simulation = settings.root->value("simulation", Json::object());
  for (const std::string key : {"integrator", "dt", "sweeps"})
    if (simulation.contains(key) && settings.place("simulation." + key).starts_with('`'))
      throw UsageError("--accuracy " + accuracy + " chooses integrator and step, and " +
                       settings.place("simulation." + key) + " names one; leave out one of them");
}

SimulateJob job_of(const SimulateArguments& a) {
  SimulateJob job = a.job;
  const std::string state = job.state_path.string();
  if (!state.empty()) job.state = io::read_state(state);
  job.scene.settings = scene_settings(a.in, state, job.state, a.flags, a);
  job.scene.folder = std::filesystem::path(is_scene(a.in) ? a.in : state).parent_path();
  job.needs_output = a.quiet || !is_scene(a.in);
  check_accuracy(a, job);
  return job;
}

/// The files that the settings name.
std::vector<std::string> outputs_of(const Json& settings) {
  std::vector<std::string> files;
  const auto output = settings.find("output");
  if (output == settings.end()) return files;
  for (const auto& [key, value] : output->items())
    if (value.is_string() && key != "folder") files.push_back(value.get<std::string>());
  return files;
}

constexpr double most_off_by_steps = 0.2;  // of all energy that is lost, without a hint

/// Of parts of the processor time, the largest first, without what rounds to nothing.
std::string shares_of(const Json& times) {
  std::vector<std::pair<double, std::string>> parts;
  for (const auto& [name, part] : times.items())
    if (value_of(part, "share") >= 0.005) parts.emplace_back(-value_of(part, "share"), name);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (const auto& [share, name] : parts)
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(std::lround(-100 * share)) + " %";
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

/// "implicit step", "leapfrog step": one of a run's.
std::string step_of(const Json& report) { return text_of(report, "integrator") + " step"; }

/// Where the energy of implicit steps went; "" where none was lost.
std::string losses_of(const Json& balance) {
  const Json& lost = table_of(balance, "lost");
  const double air = value_of(lost, "air"), steps = value_of(lost, "steps"), off = std::abs(steps);
  if (!(air + off > 0)) return "";
  const auto joules = [](double energy) { return number(1000 * energy) + " mJ"; };
  std::string line = "energy lost: " + joules(air) + " to the air; the steps " +
                     (steps < 0 ? "made " : "took ") + joules(off);
  if (off > most_off_by_steps * (air + off)) line += " (less with a shorter --dt)";
  return line;
}

Lines simulate_lines(const Json& report) {
  Lines lines;
  lines.push_back((text_of(report, "title").empty() ? "" : text_of(report, "title") + ": ") +
                  text_of(report, "outcome") + " at " + number(value_of(report, "time")) + " s, " +
                  counted(count_of(report, "steps"), step_of(report)) + " of " +
                  number(value_of(report, "dt")) + " s (" + number(value_of(report, "seconds")) +
                  " s of work)");
  const Json& strain = table_of(report, "strain");
  lines.push_back("strain: " + per_cent(value_of(strain, "p99")) +
                  " and less in 99 % of the cloth, at most " + per_cent(value_of(strain, "max")));
  if (const Json& rest = table_of(report, "at_rest"); !rest.empty())
    lines.push_back(std::string(rest.value("converged", false) ? "at rest" : "not at rest") +
                    " before it moved, after " + counted(count_of(rest, "iterations"), "iteration") + " (" +
                    number(value_of(rest, "seconds")) + " s); angle defect " +
                    number(value_of(rest, "angle_defect_before")) + " drawn, " +
                    number(value_of(rest, "angle_defect")) + " rad/m^2 at rest");
  if (report.contains("contact_gap"))
    lines.push_back("body: gap " + length(report, "contact_gap") + ", " +
                    std::to_string(count_of(report, "contacts")) + " vertices in contact, " +
                    std::to_string(count_of(report, "vertices_inside")) + " inside");
  add_heights(lines, report);
  if (const std::string lost = losses_of(table_of(report, "balance")); !lost.empty()) lines.push_back(lost);
  if (const Json& choice = table_of(report, "choice"); !choice.empty())
    lines.push_back(text_of(choice, "says"));
  if (report.contains("times")) lines.push_back("processor time: " + shares_of(report["times"]));
  add_crossings(lines, report);
  return lines;
}

/// The mesh, if it goes to standard output, then the report.
void print(const SimulateReport& report, CommonArguments common) {
  common = in_frame(common, report.frame);
  common.out = report.settings->value("/output/mesh"_json_pointer, std::string());
  if (common.out == "-" && report.failure.empty()) write_mesh(report.garment, common);
  Json json = to_json(report);
  json["flags"] = io::equivalent_flags(report.settings, report.state, report.settings_before);
  print_report(json, common, {simulate_lines(json), outputs_of(report.settings)});
}

int simulate(const SimulateArguments& a) {
  const SimulateJob job = job_of(a);
  catch_interrupts();
  Terminal terminal(a);
  const SimulateReport report = jobs::simulate(job, terminal);
  if (!report.ran) {
    std::cerr << "error: " << a.in << ": " << worded(words(*report.choice, report.scene_dt)) << "\n";
    return exit_code_of(report.choice->broken == Broken::interrupted, report.choice->has_answer());
  }
  print(report, a);
  for (const Warning& w : report.warnings) terminal.warn(w);
  if (!report.failure.empty()) std::cerr << "error: " << worded(report.failure) << "\n";
  for (const Fault& fault : report.faults) std::cerr << "error: " << worded(fault.told.text) << "\n";
  return exit_code_of(report.run.outcome == physics::Outcome::stopped_by_observer, !report.fails());
}

void add_simulate(CLI::App& sub, SimulateArguments& a) {
  sub.add_option(
      "garment", a.in,
      "garment to read (PLY of furrow wrinkle brings rest lengths and masses), or a scene: a .toml file");
  add_card(sub, card(a.job));
  a.flags.add_to(sub, io::used_by::simulate);
}

const Subcommand simulate_subcommand(
    80, "simulate",
    "Let a garment hang, fall and rest on a body\n\n"
    "  furrow simulate sheet.ply --pin-box -0.5,0,-1,-0.5,1,1 -o hung.ply\n"
    "  furrow simulate wrinkled.ply --body body.obj -o worn.ply\n"
    "  furrow simulate scenes/skirt.toml --set material.bending=1\n"
    "  furrow simulate wrinkled.ply --body body.obj --stop-at 1 --save-state at1.ply\n"
    "  furrow simulate --state at1.ply -o worn.ply",
    add_simulate, simulate);

}  // namespace
}  // namespace furrow::cli
