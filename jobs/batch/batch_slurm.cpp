// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/batch/batch_slurm.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "geometry/mesh/errors.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/control_character.h"
#include "io/base/shell_word.h"

namespace furrow::jobs {
namespace {

constexpr double least_task = 30;    // s: what Slurm takes to start a task shall not count
constexpr int chunk_of_unknown = 4;  // cases a task, as long as none is finished
constexpr int most_tasks = 1000;     // Slurm's own limit, where nobody raised it

int chunk_of(const io::BatchPlan& plan, const SlurmJob& job, std::size_t open) {
  int chunk = job.chunk;
  if (chunk == 0) {
    const std::optional<double> seconds = mean_seconds(plan);
    chunk = seconds ? std::max(1, int(std::ceil(least_task / std::max(*seconds, 0.01)))) : chunk_of_unknown;
  }
  return std::max(chunk, int((open + most_tasks - 1) / most_tasks));
}

void write_script(const std::filesystem::path& path, const std::string& text) {
  io::write_atomically(path, [&](std::ostream& out) { out << text; });
  std::filesystem::permissions(path, std::filesystem::perms::owner_exec, std::filesystem::perm_options::add);
}

/// "#SBATCH" takes quotes, but no line ends.
std::string job_name(const std::string& title) {
  std::string name = "furrow";
  for (const char c : title) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
  return name.substr(0, 40);
}

/// Options of sbatch, each between the two.
std::string options(const std::string& before, const std::string& after,
                    const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += before + "--" + name + after;
  return text;
}

std::string array_script(const io::BatchPlan& plan, const SlurmScripts& s,
                         const std::filesystem::path& program) {
  const std::string chunk = std::to_string(s.chunk);
  return "#!/bin/sh\n" +
         options("#SBATCH ", "\n",
                 {"job-name=" + job_name("-" + plan.title), "array=0-" + std::to_string(s.tasks - 1),
                  "cpus-per-task=1", "requeue", "open-mode=append"}) +
         "# A task fails if one of its cases did, after all of them.\n"
         "exec " +
         io::shell_word(program.string()) + " batch task " + io::shell_word(s.todo.string()) +
         " $((SLURM_ARRAY_TASK_ID * " + chunk + " + 1)) $((SLURM_ARRAY_TASK_ID * " + chunk + " + " + chunk +
         "))\n";
}

}  // namespace

std::vector<CaseJob> read_cases(const std::filesystem::path& todo, int first, int last,
                                const std::filesystem::path& program) {
  std::istringstream in(io::read_text(todo));
  std::vector<CaseJob> jobs;
  std::string line;
  for (int number = 1; number <= last && std::getline(in, line); ++number) {
    if (number < first) continue;
    try {
      const Json one = Json::parse(line);
      jobs.push_back({program, one.at("record").get<std::string>(), one.at("arguments")});
    } catch (const Json::exception&) {
      throw geometry::ContentError(todo.string() + ":" + std::to_string(number) +
                                   ": is no case; furrow batch slurm writes such files");
    }
  }
  return jobs;
}

SlurmScripts write_slurm_scripts(const io::BatchPlan& plan, const SlurmJob& job) {
  if (job.chunk < 0) throw std::invalid_argument("chunk = " + std::to_string(job.chunk) + " is not >= 0");
  if (io::has_control_character(job.options))
    throw std::invalid_argument("options for sbatch have a control character; write them in one line");
  const std::vector<CaseJob> cases = case_jobs(plan, job.program);
  if (cases.empty()) throw std::invalid_argument("no case of the plan is open; there is nothing to submit");
  std::string todo;
  for (const CaseJob& one : cases)
    todo += Json{{"record", one.record.string()}, {"arguments", one.arguments}}.dump() + "\n";
  const std::string hash = io::content_hash(std::as_bytes(std::span(todo.data(), todo.size())));
  const std::filesystem::path folder = plan.output / "slurm" / hash;
  std::filesystem::create_directories(folder);
  SlurmScripts s{folder / "todo.jsonl", folder / "array.sh", folder / "gather.sh", folder / "submit.sh"};
  s.chunk = chunk_of(plan, job, cases.size());
  s.tasks = (cases.size() + std::size_t(s.chunk) - 1) / std::size_t(s.chunk);
  io::write_atomically(s.todo, [&](std::ostream& out) { out << todo; });
  write_script(s.array, array_script(plan, s, job.program));
  write_script(s.gather,
               "#!/bin/sh\n" +
                   options("#SBATCH ", "\n", {"job-name=" + job_name("-gather"), "open-mode=append"}) +
                   "exec " + io::shell_word(job.program.string()) + " batch gather " +
                   io::shell_word(job.plan.string()) + "\n");
  const std::string logs = io::shell_word((folder / "%A_%a.log").string()),
                    log = io::shell_word((folder / "gather.log").string());
  write_script(s.submit,
               "#!/bin/sh\n# Submits the array, and what gathers after it, whatever came of it.\nset -eu\n"
               "id=$(sbatch " +
                   options("", " ", {"parsable", "output=" + logs}) + job.options + " " +
                   io::shell_word(s.array.string()) +
                   ")\nid=${id%%;*}\n"
                   "sbatch " +
                   options("", " ", {"parsable", "dependency=afterany:\"$id\"", "output=" + log}) +
                   job.options + " " + io::shell_word(s.gather.string()) + " >/dev/null\necho \"$id\"\n");
  return s;
}

}  // namespace furrow::jobs
