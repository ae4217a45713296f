// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/batch_slurm.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/shell_word.h"
#include "jobs/batch.h"

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

std::string array_script(const io::BatchPlan& plan, const SlurmScripts& s) {
  const std::string chunk = std::to_string(s.chunk);
  return "#!/bin/sh\n"
         "#SBATCH --job-name=" +
         job_name("-" + plan.title) +
         "\n"
         "#SBATCH --array=0-" +
         std::to_string(s.tasks - 1) +
         "\n"
         "#SBATCH --cpus-per-task=1\n"
         "#SBATCH --requeue\n"
         "#SBATCH --open-mode=append\n"
         "# Each task runs " +
         chunk +
         " lines; it fails if one of them did, after all of them.\n"
         "first=$((SLURM_ARRAY_TASK_ID * " +
         chunk +
         " + 1))\n"
         "last=$((first + " +
         std::to_string(s.chunk - 1) +
         "))\n"
         "sed -n \"${first},${last}p\" " +
         io::shell_word(s.todo.string()) +
         " | {\n"
         "  status=0\n"
         "  while IFS= read -r line; do sh -c \"$line\" </dev/null || status=1; done\n"
         "  exit $status\n"
         "}\n";
}

}  // namespace

std::vector<std::string> open_lines(const io::BatchPlan& plan, const std::filesystem::path& program) {
  std::vector<std::string> lines;
  for (const io::BatchCase& one : plan.cases)
    if (state_of(case_files(plan, one).record) != CaseState::finished)
      lines.push_back(command_line(plan, one, program));
  return lines;
}

SlurmScripts write_slurm_scripts(const io::BatchPlan& plan, const SlurmJob& job) {
  if (job.chunk < 0) throw std::invalid_argument("chunk = " + std::to_string(job.chunk) + " is not >= 0");
  const std::vector<std::string> lines = open_lines(plan, job.program);
  if (lines.empty()) throw std::invalid_argument("no case of the plan is open; there is nothing to submit");
  std::string todo;
  for (const std::string& line : lines) todo += line + "\n";
  const std::string hash = io::content_hash(std::as_bytes(std::span(todo.data(), todo.size())));
  const std::filesystem::path folder = plan.output / "slurm" / hash;
  std::filesystem::create_directories(folder);
  SlurmScripts s{folder / "todo.txt", folder / "array.sh", folder / "gather.sh", folder / "submit.sh"};
  s.chunk = chunk_of(plan, job, lines.size());
  s.tasks = (lines.size() + std::size_t(s.chunk) - 1) / std::size_t(s.chunk);
  io::write_atomically(s.todo, [&](std::ostream& out) { out << todo; });
  write_script(s.array, array_script(plan, s));
  write_script(s.gather, "#!/bin/sh\n#SBATCH --job-name=" + job_name("-gather") +
                             "\n#SBATCH --open-mode=append\nexec " + io::shell_word(job.program.string()) +
                             " batch gather " + io::shell_word(job.plan.string()) + "\n");
  const std::string logs = io::shell_word((folder / "%A_%a.log").string()),
                    log = io::shell_word((folder / "gather.log").string());
  write_script(s.submit,
               "#!/bin/sh\n# Submits the array, and what gathers after it, whatever came of it.\nset -eu\n"
               "id=$(sbatch --parsable --output=" +
                   logs + " " + job.options + " " + io::shell_word(s.array.string()) +
                   ")\nid=${id%%;*}\n"
                   "sbatch --parsable --dependency=afterany:\"$id\" --output=" +
                   log + " " + job.options + " " + io::shell_word(s.gather.string()) +
                   " >/dev/null\necho \"$id\"\n");
  return s;
}

}  // namespace furrow::jobs
