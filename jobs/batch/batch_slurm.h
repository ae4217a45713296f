// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "jobs/batch/batch.h"

namespace furrow::jobs {

struct SlurmJob {
  std::filesystem::path program, plan;  ///< furrow itself; the plan's file; both absolute
  int chunk = 0;        ///< cases a task; >= 0; 0: some 30 s of them by what finished cases took, else 4
  std::string options;  ///< for sbatch, as its command line has them
};
struct SlurmScripts {
  std::filesystem::path todo, array, gather, submit;
  std::size_t tasks = 0;
  int chunk = 0;
};
/// Writes what Slurm needs for the cases that are not finished into a folder of its own in the plan's output:
/// them as JSON, a line each, an array script of which each task runs a chunk, a script that gathers after it
/// whatever came of it, and one that submits both. Larger chunks than asked for where an array of 1,000 tasks
/// would not do. Throws std::invalid_argument if no case is open, the chunk is negative, or a name or the
/// options have a control character.
SlurmScripts write_slurm_scripts(const io::BatchPlan& plan, const SlurmJob& job);

/// Lines `first` to `last` of such a file of cases, from 1; fewer where it ends before. Throws
/// geometry::ContentError for a line that is no case.
std::vector<CaseJob> read_cases(const std::filesystem::path& todo, int first, int last,
                                const std::filesystem::path& program);

}  // namespace furrow::jobs
