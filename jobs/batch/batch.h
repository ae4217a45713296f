// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/batch_plan.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// What is on record of a case. A case is finished when the program came to an end of its own with a verdict:
/// it left with 0 or 4.
enum class CaseState { open, failed, finished };

/// Where a batch keeps what belongs to a case.
struct CaseFiles {
  std::filesystem::path record;   ///< JSON
  std::filesystem::path mesh;     ///< empty: none
  std::filesystem::path picture;  ///< empty: none
};
CaseFiles case_files(const io::BatchPlan& plan, const io::BatchCase& one);

/// What the file says of a case; open if there is none, or no record is in it.
CaseState state_of(const std::filesystem::path& record);

struct CaseJob {
  std::filesystem::path program;       ///< furrow itself
  std::filesystem::path record;        ///< JSON to write; its folder is made
  std::vector<std::string> arguments;  ///< of the program
};
/// The plan's cases by absolute paths, those that are not finished or all. program: furrow itself.
std::vector<CaseJob> case_jobs(const io::BatchPlan& plan, const std::filesystem::path& program,
                               bool finished_too = false);

/// The case as a line for a shell: "furrow batch case RECORD -- drape …". Running it twice computes once.
/// Throws std::invalid_argument as io::shell_word().
std::string command_line(const CaseJob& job);

struct CaseReport {
  std::string name;                   ///< of the case
  CaseState state = CaseState::open;  ///< open: interrupted or not begun; there is no record
  bool computed = false;              ///< false: it was finished before
  int exit_code = 0;                  ///< of the program; 128 + signal if one ended it
  std::string error;                  ///< its last line of error
};
/// Runs a case in a process of its own and writes its record, whole or not at all: arguments, exit code,
/// times, memory, host, job and the program's report. What is finished is not run again. Throws
/// std::runtime_error if the program cannot be started or the record not be written.
CaseReport run_case(const CaseJob& job);

/// Runs cases, `at_a_time` of them (>= 1), each in a process of its own, until all have run or the listener
/// cancels; then those that were not begun are open. A report each, in their order. The listener is called
/// from several threads, one at a time. Throws as run_case(), once those that run have ended.
std::vector<CaseReport> run_cases(const std::vector<CaseJob>& jobs, int at_a_time, Listener& listener);

struct BatchCounts {
  std::size_t cases = 0, finished = 0, failed = 0, open = 0;
  std::size_t missed = 0;  ///< finished with exit code 4: the verdict is no success
};
struct GatherReport {
  BatchCounts counts;
  std::filesystem::path rows, page;  ///< JSON, one line a case, in the plan's order; HTML
};
/// Brings the records of a plan's cases together in its output folder: results.jsonl and report.html. Throws
/// std::invalid_argument if one is there that furrow did not write and the listener does not replace.
GatherReport gather(const io::BatchPlan& plan, Listener& listener);

BatchCounts count(const io::BatchPlan& plan);

/// Seconds that a finished case took, in the mean of some [s]; none is finished: none.
std::optional<double> mean_seconds(const io::BatchPlan& plan);

}  // namespace furrow::jobs
