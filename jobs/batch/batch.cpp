// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/batch/batch.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

#include "geometry/mesh/errors.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/field_words.h"
#include "io/base/run_program.h"
#include "io/base/shell_word.h"
#include "jobs/base/output_checks.h"
#include "jobs/batch/batch_page.h"

namespace furrow::jobs {
namespace {

using Json = nlohmann::ordered_json;

constexpr int record_schema = 1;
constexpr std::size_t sampled_cases = 200;  // of which a mean is taken

constexpr int missed_exit = 4;

bool ended_with_verdict(int exit_code) { return exit_code == 0 || exit_code == missed_exit; }

/// None where there is no record.
std::optional<Json> read_record(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  Json record = Json::parse(io::read_text(path), nullptr, false);
  if (!record.is_object() || record.value("schema", 0) != record_schema || !record.contains("exit"))
    return std::nullopt;
  return record;
}

std::string value_behind(const std::vector<std::string>& words, const std::string& option) {
  const auto at = std::find(words.begin(), words.end(), io::flag_of(option));
  return at != words.end() && at + 1 != words.end() ? *(at + 1) : "";
}

/// Slurm's number of the job and task; "": none.
std::string job_number() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  const std::string array = variable("SLURM_ARRAY_JOB_ID");
  return array.empty() ? variable("SLURM_JOB_ID") : array + "_" + variable("SLURM_ARRAY_TASK_ID");
}

std::string host_name() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

/// The last line that says what was wrong.
std::string last_error(const std::string& text) {
  const std::size_t at = text.rfind("error: ");
  return at == std::string::npos ? "" : text.substr(at + 7, text.find('\n', at) - at - 7);
}

Json record_of(const CaseJob& job, const io::ProgramRun& run) {
  Json record{{"schema", record_schema},
              {"case", job.record.stem().string()},
              {"arguments", job.arguments},
              {"exit", run.signal ? 128 + run.signal : run.exit_code},
              {"error", last_error(run.err)},
              {"seconds", run.seconds},
              {"processor_seconds", run.processor_seconds},
              {"peak_bytes", run.peak_bytes},
              {"host", host_name()},
              {"job", job_number()}};
  Json report = Json::parse(run.out, nullptr, false);
  record["report"] = report.is_discarded() ? Json(nullptr) : std::move(report);
  return record;
}

/// What a user of the report does not ask for twice.
Json row_of(const io::BatchPlan& plan, const io::BatchCase& one) {
  Json row{{"case", one.name}};
  Json& values = row["values"] = Json::object();
  for (const io::BatchValue& v : one.values) values[v.column] = v.words();
  const CaseFiles files = case_files(plan, one);
  const std::optional<Json> record = read_record(files.record);
  row["state"] = !record ? "open" : ended_with_verdict((*record)["exit"]) ? "finished" : "failed";
  if (!record) return row;
  for (const auto& [key, value] : record->items())
    if (key != "case" && key != "schema") row[key] = value;
  const auto name = [&](const char* key, const std::filesystem::path& file) {
    std::error_code ignored;
    if (!file.empty() && std::filesystem::exists(file, ignored))
      row[key] = file.lexically_relative(plan.output).string();
  };
  name("mesh", files.mesh);
  name("picture", files.picture);
  return row;
}

}  // namespace

CaseFiles case_files(const io::BatchPlan& plan, const io::BatchCase& one) {
  CaseFiles files{plan.output / "cases" / (one.name + ".json"), {}, {}};
  if (!plan.mesh.empty()) files.mesh = plan.output / "meshes" / (one.name + "." + plan.mesh);
  if (plan.picture && plan.draws()) files.picture = plan.output / "pictures" / (one.name + ".png");
  return files;
}

CaseState state_of(const std::filesystem::path& record) {
  const std::optional<Json> found = read_record(record);
  if (!found) return CaseState::open;
  return ended_with_verdict((*found)["exit"]) ? CaseState::finished : CaseState::failed;
}

std::vector<CaseJob> case_jobs(const io::BatchPlan& plan, const std::filesystem::path& program,
                               bool finished_too) {
  std::vector<CaseJob> jobs;
  for (const io::BatchCase& one : plan.cases) {
    const CaseFiles files = case_files(plan, one);
    if (!finished_too && state_of(files.record) == CaseState::finished) continue;
    std::vector<std::string> words = one.arguments;
    if (one.has_body && plan.command != "fit" && value_behind(words, "cache").empty())
      words.insert(words.end(), {io::flag_of("cache"), (plan.output / "cache").string()});
    if (!files.mesh.empty()) words.insert(words.end(), {io::flag_of("output"), files.mesh.string()});
    if (!files.picture.empty()) words.insert(words.end(), {io::flag_of("picture"), files.picture.string()});
    jobs.push_back({program, files.record, std::move(words)});
  }
  return jobs;
}

std::string command_line(const CaseJob& job) {
  std::string line = io::shell_word(job.program.string());
  for (const std::string& word : {std::string("batch"), std::string("case"), job.record.string()})
    line += " " + io::shell_word(word);
  line += " --";
  for (const std::string& word : job.arguments) line += " " + io::shell_word(word);
  return line;
}

CaseReport run_case(const CaseJob& job) {
  const std::string name = job.record.stem().string();
  if (state_of(job.record) == CaseState::finished) return {name, CaseState::finished, false, 0, ""};
  std::vector<std::string> words = job.arguments;
  for (const char* option : {"output", "picture"})
    if (const std::filesystem::path file = value_behind(words, option); file.has_parent_path())
      std::filesystem::create_directories(file.parent_path());
  std::filesystem::create_directories(job.record.parent_path());
  for (const char* option : {"json", "quiet", "replace"}) words.push_back(io::flag_of(option));
  const io::ProgramRun run = io::run_program(job.program, words);
  CaseReport report{name, CaseState::open, true, run.signal ? 128 + run.signal : run.exit_code,
                    last_error(run.err)};
  if (report.exit_code == 130 || run.signal == SIGTERM || run.signal == SIGINT) return report;
  report.state = ended_with_verdict(report.exit_code) ? CaseState::finished : CaseState::failed;
  io::write_atomically(job.record, [&](std::ostream& out) { out << record_of(job, run).dump() << '\n'; });
  return report;
}

std::vector<CaseReport> run_cases(const std::vector<CaseJob>& jobs, int at_a_time, Listener& listener) {
  std::vector<CaseReport> reports;
  for (const CaseJob& job : jobs)
    reports.push_back({job.record.stem().string(), CaseState::open, false, 0, ""});
  ProgressScope progress(listener, "batch");
  std::mutex shared;  // the listener, and what follows
  std::size_t next = 0, done = 0;
  std::exception_ptr failed;
  const auto work = [&] {
    std::unique_lock lock(shared);
    try {
      while (!failed && next < jobs.size() && progress(double(done) / double(jobs.size()))) {
        const std::size_t number = next++;
        lock.unlock();
        reports[number] = run_case(jobs[number]);
        lock.lock();
        ++done;
      }
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      failed = std::current_exception();
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < at_a_time && std::size_t(i) < jobs.size(); ++i) others.emplace_back(work);
  work();
  others.clear();  // waits for them
  if (failed) std::rethrow_exception(failed);
  return reports;
}

BatchCounts count(const io::BatchPlan& plan) {
  BatchCounts counts;
  for (const io::BatchCase& one : plan.cases) {
    const std::optional<Json> record = read_record(case_files(plan, one).record);
    const int exit_code = record ? (*record)["exit"].get<int>() : 0;
    ++counts.cases;
    ++(!record ? counts.open : ended_with_verdict(exit_code) ? counts.finished : counts.failed);
    counts.missed += exit_code == missed_exit;
  }
  return counts;
}

std::optional<double> mean_seconds(const io::BatchPlan& plan) {
  double sum = 0;
  std::size_t number = 0;
  for (const io::BatchCase& one : plan.cases) {
    if (number == sampled_cases) break;
    const std::optional<Json> record = read_record(case_files(plan, one).record);
    if (!record || !ended_with_verdict((*record)["exit"])) continue;
    sum += (*record)["seconds"].get<double>();
    ++number;
  }
  return number > 0 ? std::optional(sum / double(number)) : std::nullopt;
}

GatherReport gather(const io::BatchPlan& plan, Listener& listener) {
  std::filesystem::create_directories(plan.output);
  GatherReport report{count(plan), plan.output / "results.jsonl", plan.output / "report.html"};
  check_replaced({report.rows.string(), report.page.string()}, {}, listener);
  io::OutputGroup together;
  io::write_atomically(report.rows, [&](std::ostream& out) {
    for (const io::BatchCase& one : plan.cases) out << row_of(plan, one).dump() << '\n';
  });
  io::write_atomically(report.page, [&](std::ostream& out) {
    BatchPage page(plan, out);
    for (const io::BatchCase& one : plan.cases) page.add(row_of(plan, one));
    page.end();
  });
  together.commit();
  return report;
}

}  // namespace furrow::jobs
