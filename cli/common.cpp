// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>

#include "cli/print_text.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/wrinkle_record.h"
#include "io/scene/state_file.h"

namespace furrow::cli {
namespace {

const std::map<std::string, double>& units() {
  static const std::map<std::string, double> metres{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}};
  return metres;
}

std::string unit_of(const CommonArguments& common) { return common.unit.value_or(common.noted_unit); }
std::string up_of(const CommonArguments& common) { return common.up.value_or(common.noted_up); }
io::Axis axis(const std::string& up) { return up == "z" ? io::Axis::z : io::Axis::y; }

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void tell_repairs(const std::string& path, const io::MeshFile& file, const CommonArguments& common) {
  for (const std::string& w : file.warnings) warn(path + ": " + w, common);
  const io::RepairReport& r = file.repairs;
  const auto tell = [&](std::size_t n, const char* what) {
    if (n) warn(path + ": " + std::to_string(n) + " " + what, common);
  };
  tell(r.degenerate_faces, "degenerate faces dropped");
  tell(r.duplicate_faces, "duplicate faces dropped");
  tell(r.reversed_faces, "faces turned to agree with their neighbours");
  tell(r.duplicated_vertices, "vertices duplicated where the surface was not manifold");
}

/// Formats other than PLY have no place for them.
void warn_of_lost_attributes(const std::string& path, const io::MeshFile& file,
                             const CommonArguments& common) {
  if (io::mesh_format(path) == io::MeshFormat::ply) return;
  std::string names;
  for (const geometry::VertexAttribute& attribute : geometry::vertex_attributes(file.mesh))
    names += (names.empty() ? "" : ", ") + attribute.name;
  if (!names.empty())
    warn((path == "-" ? "standard output" : path) +
             ": only PLY keeps vertex attributes; not written: " + names,
         common);
}

volatile std::sig_atomic_t interrupt_flag = 0;
/// The second one ends the process at once.
void on_interrupt(int signal) {
  interrupt_flag = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void add_common_options(CLI::App& sub, CommonArguments& common) {
  sub.add_option("--unit", common.unit,
                 "unit of length in the mesh and stroke files: m, cm, mm or inch; heights are metres always "
                 "(default m, or what "
                 "a mesh of furrow notes)")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}));
  sub.add_option("--up", common.up, "axis that points up in those files: y or z (default y, or as noted)")
      ->check(CLI::IsMember({"y", "z"}));
  sub.add_flag("--json", common.json, "print the report as JSON");
  sub.add_flag("-q,--quiet", common.quiet,
               "no report, no progress, no warnings; with --json the report alone");
}

void take_noted_frame(CommonArguments& common, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const auto record = io::read_wrinkle_record(file);
    if (!record || !units().count(record->unit)) continue;
    common.noted_unit = record->unit;
    common.noted_up = record->up;
    return;
  }
}

io::ReadOptions read_options(const CommonArguments& common) {
  return {units().at(unit_of(common)), axis(up_of(common))};
}

io::WriteOptions write_options(const CommonArguments& common) {
  return {units().at(unit_of(common)), axis(up_of(common))};
}

io::MeshFile read_mesh(const std::string& path, const CommonArguments& common) {
  io::MeshFile file = io::read_mesh(path, read_options(common));
  const auto record = io::find_wrinkle_record(file);
  const bool noted = record && units().count(record->unit);
  CommonArguments actual;
  actual.unit = noted && !common.unit ? record->unit : unit_of(common);
  actual.up = noted && !common.up ? record->up : up_of(common);
  if (actual.unit != unit_of(common) || actual.up != up_of(common))
    file = io::read_mesh(path, read_options(actual));
  if (noted && (record->unit != actual.unit || record->up != actual.up))
    warn(path + ": was written with --unit " + record->unit + " --up " + record->up, common);
  tell_repairs(path, file, common);
  io::drop_motion(file);  // a state that is used as a mesh is one
  return file;
}

std::string too_tall(const geometry::Mesh& mesh, const std::string& what) {
  double low = INFINITY, high = -INFINITY;
  for (geometry::Vertex v : mesh.vertices()) {
    low = std::min(low, mesh.point(v).y());
    high = std::max(high, mesh.point(v).y());
  }
  if (!(high - low > 10)) return "";
  return "the " + what + " is " + std::to_string(high - low) +
         " m tall; if its file is not in metres, say so with --unit cm, mm or inch";
}

io::MeshFile read_garment(const std::string& path, const CommonArguments& common, const std::string& what) {
  io::MeshFile file = read_mesh(path, common);
  if (const std::string fault = too_tall(file.mesh, what); !fault.empty())
    throw geometry::ContentError(path + ": " + fault);
  return file;
}

void write_mesh(const io::MeshFile& file, const CommonArguments& common) {
  write_mesh(common.out, file, common);
}

void write_mesh(const std::string& path, const io::MeshFile& file, const CommonArguments& common) {
  const io::WriteOptions options = write_options(common);
  warn_of_lost_attributes(path, file, common);
  if (path == "-") {
    io::write_mesh(std::cout, io::MeshFormat::obj, file, options);
    flush_output();
  } else if (auto record = io::find_wrinkle_record(file)) {
    record->unit = unit_of(common);
    record->up = up_of(common);
    io::MeshFile noted = file;
    io::set_wrinkle_record(noted, *record);
    io::write_mesh(path, noted, options);
  } else {
    io::write_mesh(path, file, options);
  }
}

void flush_output() {
  std::cout.flush();
  if (!std::cout)
    throw std::runtime_error("standard output: cannot be written; is its disk full or its reader gone?");
}

void print_report(const Json& report, const CommonArguments& common) {
  std::ostream& out = common.out == "-" ? std::cerr : std::cout;
  if (common.json) {
    Json versioned{{"schema", 1}};
    versioned.update(report);
    out << versioned.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  } else if (!common.quiet) {
    print_text(out, report);
  }
  out.flush();
  flush_output();
}

void warn(const std::string& message, const CommonArguments& common) {
  if (!common.quiet) std::cerr << "warning: " << message << "\n";
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
    throw UsageError(option + " takes " + std::to_string(n) + " numbers parted by commas, not '" + text +
                     "'");
  return numbers;
}

Progress::Progress(std::string what, const CommonArguments& common)
    : what_(std::move(what)), on_(!common.quiet && isatty(STDERR_FILENO)), start_(now()) {}

Progress::~Progress() {
  if (on_ && shown_ >= 0) std::cerr << "\r\033[K" << std::flush;
}

void Progress::show(double share) {
  const int permille = static_cast<int>(1000 * std::clamp(share, 0.0, 1.0));
  if (!on_ || permille == shown_) return;
  shown_ = permille;
  const double elapsed = now() - start_;
  std::string bar(30, ' ');
  std::fill_n(bar.begin(), 30 * permille / 1000, '=');
  char text[96];
  std::snprintf(text, sizeof text, "] %5.1f %%  %.0f s left", permille / 10.0,
                permille > 0 ? elapsed * (1000 - permille) / permille : 0.0);
  std::cerr << "\r\033[K" << what_ << " [" << bar << text << std::flush;
}

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", 1000 * metres);
  return text;
}

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}
bool interrupted() { return interrupt_flag != 0; }

}  // namespace furrow::cli
