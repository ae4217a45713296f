// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/print_summary.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"

/// What the subcommands share: units, reports, progress, interruption, exit codes.
namespace furrow::cli {

enum ExitCode {
  exit_ok = 0,
  exit_failed = 1,
  exit_usage = 2,
  exit_unreadable = 3,
  exit_not_converged = 4,
  exit_interrupted = 130
};

/// On stderr: that the budget of so many seconds ended the job, what that means, and what helps.
void report_spent_budget(double seconds, const std::vector<std::string>& written);

/// exit_interrupted, else whether it came to what was asked for: exit_ok or exit_not_converged.
inline ExitCode exit_code_of(bool was_interrupted, bool succeeded) {
  return was_interrupted ? exit_interrupted : succeeded ? exit_ok : exit_not_converged;
}

/// A fault in how the program was called; exits with exit_usage.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using namespace jobs;

/// Options that every subcommand has; with the unit and the axis of the files read and written.
struct CommonArguments : Frame {
  std::string out;       ///< what is written; "-": OBJ to stdout, and the report goes to stderr
  bool json = false;     ///< the report as JSON
  bool force = false;    ///< go on where a job would take very much memory or time
  bool replace = false;  ///< outputs may replace files that furrow did not write
  bool verbose = false;  ///< the whole report as text, too, not its summary alone
  bool quiet = false;    ///< no progress, no warnings, and no report but that of json
  /// bar, lines, none, or seconds between two lines; auto: a bar on a terminal, lines elsewhere.
  std::string progress = "auto";
  const CLI::App* typed = nullptr;  ///< what was on the command line
};
void add_common_options(CLI::App& sub, CommonArguments& common);

/// As in jobs/mesh_input.h; warnings go to stderr.
io::MeshFile read_mesh(const std::string& path, const CommonArguments& common);
io::MeshFile read_garment(const std::string& path, const CommonArguments& common,
                          const std::string& what = "garment");

/// The body of a scene, if it has one, for a picture of what a job wrote: silently, as its repairs have been
/// reported by the job.
std::optional<io::MeshFile> read_body_of(const io::Scene& scene, CommonArguments common);

/// Writes the mesh to common.out.
void write_mesh(const io::MeshFile& file, const CommonArguments& common);
/// Writes it to another file; "-" is OBJ to standard output.
void write_mesh(const std::string& path, const io::MeshFile& file, const CommonArguments& common);

/// Throws std::runtime_error if what was written to standard output did not arrive.
void flush_output();

/// Prints a report to stdout: its summary for people, with --verbose all of it (print_text.h), too, or JSON
/// with a schema version. A report without a summary is printed whole.
void print_report(const Json& report, const CommonArguments& common, const Summary& summary = {});
void warn(const std::string& message, const CommonArguments& common);
/// The arguments, with unit and axis of what a job wrote.
inline CommonArguments in_frame(CommonArguments common, const Frame& frame) {
  static_cast<Frame&>(common) = frame;
  return common;
}
/// Those that are not empty, for "written" of a report.
std::vector<std::string> names_of_files(std::vector<std::string> names);

/// `text` as exactly n numbers separated by commas. Throws UsageError that names the option.
std::vector<double> parse_numbers(const std::string& text, std::size_t n, const std::string& option);

/// "1%" as 0.01. Throws UsageError, naming the option, for anything but a percentage in (0, 100).
double parse_share(const std::string& text, const std::string& option);

/// What stands between the commas; nothing of "", and no empty part at the end.
std::vector<std::string> split_at_commas(const std::string& text);

constexpr double unlimited = std::numeric_limits<double>::infinity();  ///< budget [s]

/// Tells progress on stderr unless the user does not want to hear of it: as a bar that cleans up after
/// itself, or as a line every ten seconds (or as many as were asked for) where nobody sits at a terminal.
class Progress {
 public:
  /// budget: of processor time, which every line names [s]; infinity: none.
  Progress(std::string what, const CommonArguments& common, double budget);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(double share);  ///< in [0, 1]

 private:
  enum class Form { none, bar, lines };
  static Form form_of(const CommonArguments& common);
  std::string seconds_left(double time, int permille);
  void draw_bar(int permille, double time);

  std::string what_;
  Form form_;
  int shown_ = -1;  ///< by the bar [permille]
  double start_, told_;
  double between_lines_;    ///< [s]
  double end_ = unlimited;  ///< as it was last expected [s]
  std::string limit_;       ///< words for the budget
};

/// From the first call on, Ctrl-C and SIGTERM set a flag in place of ending the program; the second one ends
/// it at once.
void catch_interrupts();
bool interrupted();

/// Tells on stderr what a job has to say: progress, warnings; Ctrl-C cancels it, once catch_interrupts() was
/// called.
class Terminal : public Listener {
 public:
  /// budget: of the job, of processor time [s].
  explicit Terminal(const CommonArguments& common, double budget = unlimited)
      : common_(common), budget_(budget) {}
  void progress(const std::string& what, double share) override;
  void warn(const Warning& warning) override;
  bool cancelled() override;
  bool allows(const std::string& demand) override;
  bool replaces(const std::string&) override { return common_.replace; }

 private:
  const CommonArguments& common_;
  double budget_;
  std::string what_;
  std::unique_ptr<Progress> bar_;
};

}  // namespace furrow::cli
