// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common.h"

#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "cli/card_options.h"
#include "cli/help.h"
#include "cli/print_text.h"
#include "jobs/base/finite_report.h"

namespace furrow::cli {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of --progress: its number, or the usual one [s].
double seconds_between_lines(const std::string& progress) {
  const double seconds = std::strtod(progress.c_str(), nullptr);
  return seconds > 0 ? seconds : 10;
}

/// What is wrong with the value of --progress; "": nothing.
std::string check_progress(const std::string& value) {
  for (const char* word : {"auto", "bar", "lines", "none"})
    if (value == word) return "";
  char* end = nullptr;
  return std::strtod(value.c_str(), &end) > 0 && *end == 0
             ? ""
             : "takes bar, lines, none or seconds between two lines, not '" + value + "'";
}

/// Whether stderr is a terminal that may be told to go back in a line.
bool takes_control_codes() {
  const char *plain = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) && !(plain && *plain) && !(terminal && std::string(terminal) == "dumb");
}

volatile std::sig_atomic_t interrupt_flag = 0;
timespec first_interrupt = {};
/// The second one ends the process at once. `timeout` and some shells send one signal to the process and one
/// to its group, so what follows within 0.2 s belongs to the first one.
void on_interrupt(int signal) {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (!interrupt_flag) {
    first_interrupt = now;
    interrupt_flag = 1;
  } else if (now.tv_sec - first_interrupt.tv_sec + 1e-9 * (now.tv_nsec - first_interrupt.tv_nsec) > 0.2) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void add_common_options(CLI::App& sub, CommonArguments& common) {
  add_card(sub, common_card(common, common.force, common.replace));
  begin_group(sub, group::output);
  sub.add_flag("--json", common.json, "print the report as JSON");
  sub.add_flag("-v,--verbose", common.verbose, "all numbers of the report, not its summary alone");
  sub.add_flag("-q,--quiet", common.quiet,
               "no report, no progress, no warnings; with --json the report alone");
  begin_group(sub, group::output, Audience::few);
  sub.add_option(
         "--progress", common.progress,
         "bar (on a terminal, without NO_COLOR), lines (one every 10 s), seconds between two lines, or "
         "none (default: a bar on a terminal, lines elsewhere)")
      ->check(check_progress);
}

io::MeshFile read_mesh(const std::string& path, const CommonArguments& common) {
  Terminal terminal(common);
  return jobs::read_mesh(path, {common, terminal});
}

io::MeshFile read_garment(const std::string& path, const CommonArguments& common, const std::string& what) {
  Terminal terminal(common);
  return jobs::read_garment(path, {common, terminal}, what);
}

std::optional<io::MeshFile> read_body_of(const io::Scene& scene, CommonArguments common) {
  if (!scene.body) return std::nullopt;
  common.quiet = true;
  if (scene.body->unit) common.unit = scene.body->unit;
  return read_mesh(scene.body->mesh.string(), common);
}

void write_mesh(const io::MeshFile& file, const CommonArguments& common) {
  write_mesh(common.out, file, common);
}

void write_mesh(const std::string& path, const io::MeshFile& file, const CommonArguments& common) {
  Terminal terminal(common);
  const Context context{common, terminal};
  if (path != "-") return jobs::write_mesh(path, file, context);
  warn_of_lost_attributes(path, file, context);
  io::write_mesh(std::cout, io::MeshFormat::obj, file, write_options(common));
  flush_output();
}

void flush_output() {
  std::cout.flush();
  if (!std::cout)
    throw std::runtime_error("standard output: cannot be written; is its disk full or its reader gone?");
}

void print_report(const Json& report, const CommonArguments& common, const Summary& summary) {
  std::ostream& out = common.out == "-" ? std::cerr : std::cout;
  if (common.json) {
    out << worded_report(finite_report(report)).dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  } else if (!common.quiet) {
    Summary said = summary;
    for (std::string& line : said.lines) line = worded(line);
    print_summary(out, said);
    if (common.verbose || summary.lines.empty()) print_text(out, worded_report(report));
  }
  out.flush();
  flush_output();
}

void warn(const std::string& message, const CommonArguments& common) {
  if (!common.quiet) std::cerr << "warning: " << worded(message) << "\n";
}

std::vector<std::string> names_of_files(std::vector<std::string> names) {
  std::erase(names, "");
  return names;
}

std::vector<double> parse_numbers(const std::string& text, std::size_t n, const std::string& option) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  for (;;) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || !std::isfinite(value)) break;
    numbers.push_back(value);
    at = end;
    if (*at != ',') break;
    ++at;
  }
  if (*at != 0 || numbers.size() != n)
    throw UsageError(option + " takes " + std::to_string(n) + " numbers separated by commas, not '" + text +
                     "'");
  return numbers;
}

double parse_share(const std::string& text, const std::string& option) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || std::string(end) != "%" || !(value > 0 && value < 100))
    throw UsageError(option + " takes a share of the garment's size such as 1%, not '" + text + "'");
  return value / 100;
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

Progress::Form Progress::form_of(const CommonArguments& common) {
  if (common.quiet || common.progress == "none") return Form::none;
  const bool wants_bar = common.progress == "auto" || common.progress == "bar";
  return wants_bar && takes_control_codes() ? Form::bar : Form::lines;
}

Progress::Progress(std::string what, const CommonArguments& common, double budget)
    : what_(std::move(what)),
      form_(form_of(common)),
      start_(now()),
      told_(start_),
      between_lines_(seconds_between_lines(common.progress)) {
  if (std::isfinite(budget)) limit_ = fmt::format(" (at most {:.4g} s of processor time)", budget);
}

Progress::~Progress() {
  if (form_ == Form::bar && shown_ >= 0) std::cerr << "\r\033[K" << std::flush;
}

/// ", 12 s left", or nothing where the end has moved away since it was last expected.
std::string Progress::seconds_left(double time, int permille) {
  if (permille == 0) return "";
  const double end = time + (time - start_) * (1000 - permille) / permille;
  const bool recedes = end - start_ > 1.2 * (end_ - start_);
  end_ = end;
  return recedes ? "" : fmt::format(", {:.0f} s left", end - time);
}

void Progress::draw_bar(int permille, double time) {
  if (permille == shown_) return;
  shown_ = permille;
  std::string bar(30, ' ');
  std::fill_n(bar.begin(), 30 * permille / 1000, '=');
  std::cerr << "\r\033[K" << what_ << " [" << bar << fmt::format("] {:5.1f} %", permille / 10.0)
            << seconds_left(time, permille) << limit_ << std::flush;
}

void Progress::show(double share) {
  if (form_ == Form::none) return;
  const int permille = static_cast<int>(1000 * std::clamp(share, 0.0, 1.0));
  const double time = now();
  if (form_ == Form::bar) return draw_bar(permille, time);
  if (time - told_ < between_lines_) return;
  told_ = time;
  std::cerr << fmt::format("{}: {:.1f} %{}{}\n", what_, permille / 10.0, seconds_left(time, permille), limit_)
            << std::flush;
}

void Terminal::progress(const std::string& what, double share) {
  if (share >= 1) return bar_.reset();
  if (!bar_ || what != what_) bar_ = std::make_unique<Progress>(what, common_, budget_);
  what_ = what;
  bar_->show(share);
}

void Terminal::warn(const Warning& warning) { cli::warn(warning.text, common_); }

bool Terminal::cancelled() { return interrupted(); }

bool Terminal::allows(const std::string& demand) {
  if (common_.force) cli::warn(demand + "; --force goes on all the same", common_);
  return common_.force;
}

void report_spent_budget(double seconds, const std::vector<std::string>& files) {
  std::string written;
  for (const std::string& file : names_of_files(files)) written += (written.empty() ? "" : ", ") + file;
  std::cerr << "error: the budget of " << fmt::format("{:.4g}", seconds) << " s of processor time is spent; "
            << (written.empty() ? "" : "the best state so far is in " + written + "; ")
            << "give it more with --budget, or refine it less\n";
}

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}
bool interrupted() { return interrupt_flag != 0; }

}  // namespace furrow::cli
