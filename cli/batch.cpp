// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <set>
#include <thread>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "furrow/version.h"
#include "io/base/nearest_word.h"
#include "io/base/run_program.h"
#include "jobs/batch/batch_slurm.h"

namespace furrow::cli {
namespace {

struct BatchArguments : CommonArguments {
  std::string action, plan, options;
  std::vector<std::string> words;  ///< of a case
  int jobs = 0, chunk = 0;
  bool all = false, submit = false;
};

/// Throws UsageError for an option that the plan's command does not have, before any case would fail of it.
void check_options(const io::BatchPlan& plan, const CLI::App& command, const std::string& file) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
  std::set<std::string> checked;
  for (const io::BatchCase& one : plan.cases)
    for (const std::string& word : one.arguments) {
      if (!word.starts_with("--") || !checked.insert(word).second) continue;
      const std::string name = word.substr(2);
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw UsageError(file + ": furrow " + plan.command + " has no option '" + name + "'; did you mean '" +
                         io::nearest_word(name, known) + "'?");
    }
}

io::BatchPlan read_plan(const BatchArguments& a, const CLI::App& app) {
  io::BatchPlan plan = io::read_batch_plan(a.plan, FURROW_VERSION);
  check_options(plan, *app.get_subcommand(plan.command), a.plan);
  if (plan.repeated > 0)
    warn(fmt::format("{}: {} cases are the same as others, and are run once", a.plan, plan.repeated), a);
  return plan;
}

std::string words_of(const BatchCounts& c) {
  const std::string missed =
      c.missed > 0 ? fmt::format(" ({} of them with exit code 4: no success)", c.missed) : "";
  return fmt::format("{} {}: {} finished{}, {} failed, {} open", c.cases, c.cases == 1 ? "case" : "cases",
                     c.finished, missed, c.failed, c.open);
}

Json json_of(const BatchCounts& c) {
  return {{"cases", c.cases},
          {"finished", c.finished},
          {"missed", c.missed},
          {"failed", c.failed},
          {"open", c.open}};
}

int gather_batch(const io::BatchPlan& plan, const BatchArguments& a) {
  Terminal terminal(a);
  const GatherReport report = gather(plan, terminal);
  Json json = json_of(report.counts);
  json["written"] = names_of_files({report.rows.string(), report.page.string()});
  print_report(json, a, {{words_of(report.counts)}, {report.rows.string(), report.page.string()}, {}});
  return report.counts.finished - report.counts.missed == report.counts.cases ? exit_ok : exit_not_converged;
}

int list_batch(const io::BatchPlan& plan, const BatchArguments& a) {
  std::vector<std::string> lines;
  for (const CaseJob& one : case_jobs(plan, io::this_program(), a.all)) lines.push_back(command_line(one));
  if (a.json) {
    Json json = json_of(count(plan));
    json["lines"] = lines;
    print_report(json, a);
    return exit_ok;
  }
  for (const std::string& line : lines) std::cout << line << "\n";
  flush_output();
  if (!a.quiet) std::cerr << words_of(count(plan)) << "\n";
  return exit_ok;
}

Json json_of(const CaseReport& r) {
  return {{"case", r.name},
          {"state", r.state == CaseState::finished ? "finished"
                    : r.state == CaseState::failed ? "failed"
                                                   : "open"},
          {"computed", r.computed},
          {"exit", r.exit_code},
          {"error", r.error}};
}

std::string words_of(const CaseReport& r) {
  if (r.state == CaseState::finished) return r.name + (r.computed ? ": computed" : ": was finished before");
  return fmt::format("{}: {} with exit code {}{}{}", r.name,
                     r.state == CaseState::open ? "interrupted" : "failed", r.exit_code,
                     r.error.empty() ? "" : ": ", r.error);
}

ExitCode exit_code_of_case(const CaseReport& r) {
  return r.state == CaseState::open ? exit_interrupted : r.state == CaseState::failed ? exit_failed : exit_ok;
}

int run_case_of_batch(const BatchArguments& a) {
  if (a.words.empty())
    throw UsageError("batch case: there is no command behind --; furrow batch list PLAN writes such lines");
  const CaseReport report = run_case({io::this_program(), a.plan, a.words});
  Json json = json_of(report);
  json["record"] = a.plan;
  print_report(json, a, {{words_of(report)}, {}, {}});
  return exit_code_of_case(report);
}

/// The lines of a file that Slurm's script names, one after the other.
int run_task_of_batch(const BatchArguments& a) {
  if (a.words.size() != 2)
    throw UsageError("batch task: write the first and the last line of its file; furrow batch slurm does");
  const auto number = [](const std::string& word) {
    int n = 0;
    const auto end = std::from_chars(word.data(), word.data() + word.size(), n);
    if (end.ec != std::errc() || end.ptr != word.data() + word.size() || n < 1)
      throw UsageError("batch task: '" + word + "' is no number of a line");
    return n;
  };
  catch_interrupts();
  Terminal terminal(a);
  const std::vector<CaseReport> reports =
      run_cases(read_cases(a.plan, number(a.words[0]), number(a.words[1]), io::this_program()), 1, terminal);
  Json json{{"cases", Json::array()}};
  std::vector<std::string> words;
  int exit_code = interrupted() ? exit_interrupted : exit_ok;
  for (const CaseReport& one : reports) {
    json["cases"].push_back(json_of(one));
    words.push_back(words_of(one));
    exit_code = std::max(exit_code, int(exit_code_of_case(one)));
  }
  print_report(json, a, {words, {}, {}});
  return exit_code;
}

/// Cases side by side, then gathered, whatever came of them.
int run_in_parallel(const io::BatchPlan& plan, const BatchArguments& a) {
  catch_interrupts();
  const int cores = std::max(1, int(std::thread::hardware_concurrency()));
  {
    Terminal terminal(a);
    run_cases(case_jobs(plan, io::this_program()), a.jobs > 0 ? a.jobs : cores, terminal);
  }
  const int exit_code = gather_batch(plan, a);
  return interrupted() ? exit_interrupted : exit_code;
}

int prepare_slurm(const io::BatchPlan& plan, const BatchArguments& a) {
  const SlurmScripts s = write_slurm_scripts(
      plan, {io::this_program(), std::filesystem::absolute(a.plan).lexically_normal(), a.chunk, a.options});
  Json json{
      {"tasks", s.tasks},
      {"chunk", s.chunk},
      {"written", names_of_files({s.todo.string(), s.array.string(), s.gather.string(), s.submit.string()})}};
  std::vector<std::string> next{"sh", s.submit.string()};
  if (a.submit) {
    const io::ProgramRun run = io::run_program("sh", {s.submit.string()});
    if (run.exit_code != 0) throw std::runtime_error("sbatch refused the job: " + run.err);
    json["job"] = run.out.substr(0, run.out.find('\n'));
    next = {"furrow", "batch", "gather", a.plan};
  }
  std::string words = fmt::format("{} tasks of up to {} cases", s.tasks, s.chunk);
  if (a.submit) words += ", submitted as job " + json["job"].get<std::string>();
  print_report(json, a, {{words}, {s.submit.string()}, next});
  return exit_ok;
}

/// Throws UsageError for an option of another action, which would do nothing.
void check_action(const BatchArguments& a) {
  const auto check = [&](bool given, const char* option, const char* action) {
    if (given && a.action != action)
      throw UsageError(std::string(option) + " goes with furrow batch " + action + ", not with " + a.action);
  };
  check(a.all, "--all", "list");
  check(a.jobs > 0, "--jobs", "parallel");
  check(a.chunk > 0, "--chunk", "slurm");
  check(a.submit, "--submit", "slurm");
  check(!a.options.empty(), "--sbatch", "slurm");
}

int batch(const BatchArguments& a, const CLI::App& app) {
  check_action(a);
  if (a.action == "case") return run_case_of_batch(a);
  if (a.action == "task") return run_task_of_batch(a);
  if (!a.words.empty())
    throw UsageError("batch " + a.action + ": '" + a.words[0] + "' is one argument too many");
  const io::BatchPlan plan = read_plan(a, app);
  if (a.action == "list") return list_batch(plan, a);
  if (a.action == "parallel") return run_in_parallel(plan, a);
  if (a.action == "slurm") return prepare_slurm(plan, a);
  return gather_batch(plan, a);
}

void add_batch(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<BatchArguments>();
  CLI::App* sub = app.add_subcommand("batch",
                                     "Many garments on many bodies in many fabrics, on one machine or a "
                                     "cluster; what is finished is not run again\n\n"
                                     "  furrow batch parallel plan.toml\n"
                                     "  furrow batch list plan.toml | parallel --joblog log\n"
                                     "  furrow batch slurm plan.toml --submit\n"
                                     "  furrow batch gather plan.toml");
  sub->add_option(
         "action", a->action,
         "list: a line for a shell of each case that is not finished; parallel: run them, then gather; "
         "slurm: write scripts for an array of Slurm; gather: results.jsonl and report.html; case, task: "
         "run one or several (that is what the lines and the scripts do)")
      ->required()
      ->check(CLI::IsMember({"list", "parallel", "slurm", "gather", "case", "task"}));
  sub->add_option("plan", a->plan,
                  "plan to read (TOML, docs/batches.md); of case: the record to write; of "
                  "task: the file of cases")
      ->required();
  sub->add_option("words", a->words,
                  "of case: what furrow is to do, behind --; of task: its first and last line");
  sub->add_flag("--all", a->all, "of list: finished cases, too");
  sub->add_option("--jobs", a->jobs, "of parallel: cases at a time (default: one a core)")
      ->check(CLI::Range(1, 10000));
  sub->add_option("--chunk", a->chunk,
                  "of slurm: cases a task (default: some 30 s of them by what finished ones took, else 4)")
      ->check(CLI::Range(1, 1000000));
  sub->add_option("--sbatch", a->options,
                  "of slurm: options for sbatch: --sbatch '--partition=short --mem=2G'");
  sub->add_flag("--submit", a->submit, "of slurm: hand the scripts to sbatch, too");
  add_common_options(*sub, *a);
  sub->callback([a, &app, &exit_code] { exit_code = batch(*a, app); });
}

const Subcommand batch_subcommand(190, add_batch);

}  // namespace
}  // namespace furrow::cli
