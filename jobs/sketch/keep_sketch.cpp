// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/keep_sketch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "geometry/fold/line_region.h"
#include "geometry/mesh/property_names.h"
#include "jobs/chain/keep.h"
#include "jobs/sketch/sketch_rounds.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

using bridge::KeptLine;
using bridge::Verdict;
using Rgb = std::array<std::uint8_t, 3>;

struct VerdictLook {
  const char* word;
  Rgb colour;
};

/// The colours of verdict_scene.cpp, as lights.
VerdictLook look_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return {"held", {64, 168, 104}};
    case Verdict::pressed:
      return {"pressed", {240, 205, 60}};
    case Verdict::strutted:
      return {"strutted", {243, 135, 60}};
    case Verdict::lowered:
      return {"lowered", {70, 120, 220}};
    case Verdict::may_hold:
      return {"may_hold", {160, 90, 210}};
    case Verdict::not_known:
      return {"not_known", {150, 150, 150}};
    case Verdict::cannot_hold:
      break;
  }
  return {"cannot_hold", {196, 40, 50}};
}

constexpr const char* in_memory = "-";
constexpr Rgb plain{216, 210, 198};
constexpr const char* legend_of_verdicts =
    "Green: held. Yellow: held, pressed. Orange: held by struts. Blue: stands, lower than asked. "
    "Violet: may hold. Red: cannot hold.";

/// The cloth of each line in its verdict's colour, the worst on top.
std::vector<std::uint8_t> colours_of_verdicts(const KeepReport& report) {
  const geometry::Mesh& mesh = report.garment.mesh;
  std::vector<Rgb> colour(mesh.num_vertices(), plain);
  const auto id = geometry::find_map(mesh, geometry::attribute::line);
  const std::vector<double> lengths = geometry::lengths_before_lines(mesh);
  const std::vector<double> widths = io::line_widths(report.record);
  for (const Verdict verdict : {Verdict::held, Verdict::pressed, Verdict::strutted, Verdict::lowered,
                                Verdict::may_hold, Verdict::cannot_hold, Verdict::not_known})
    for (const KeptLine& line : report.lines.lines) {
      if (line.verdict != verdict || !id) continue;
      std::vector<geometry::Vertex> seeds;
      for (const geometry::Vertex v : mesh.vertices())
        if ((*id)[v] == line.line) seeds.push_back(v);
      const double width = std::size_t(line.line) < widths.size() ? widths[std::size_t(line.line)]
                                                                  : std::numeric_limits<double>::quiet_NaN();
      for (const geometry::Vertex v : geometry::line_region(mesh, seeds, width, lengths))
        colour[v.idx()] = look_of(verdict).colour;
    }
  std::vector<std::uint8_t> bytes;
  for (const geometry::Vertex v : mesh.vertices())
    bytes.insert(bytes.end(), colour[v.idx()].begin(), colour[v.idx()].end());
  return bytes;
}

/// Passes all on but that a mesh in memory would be written without its rest state: it is written as PLY.
class OfFilesAlone : public Listener {
 public:
  explicit OfFilesAlone(Listener& other) : other_(other) {}
  void progress(const std::string& what, double share) override { other_.progress(what, share); }
  void warn(const Warning& warning) override {
    if (warning.where != in_memory) other_.warn(warning);
  }
  bool cancelled() override { return other_.cancelled(); }
  bool allows(const std::string& demand) override { return other_.allows(demand); }
  bool replaces(const std::string& path) override { return other_.replaces(path); }

 private:
  Listener& other_;
};

KeepJob keep_job(const Sketch& sketch, const Json& strokes) {
  KeepJob job;
  job.budget = std::numeric_limits<double>::infinity();  // whoever draws sees it and cancels
  job.scene = sketch.scene;
  job.scene.settings.root->erase("output");
  add_round(sketch, strokes, 0, Json::array(), job.scene);
  io::set_value(job.scene.settings, "output.mesh", in_memory, "the studio");
  return job;
}

}  // namespace

KeptSketch keep_sketch(const Sketch& sketch, const Json& strokes, Listener& listener) {
  const auto record = io::find_wrinkle_record(sketch.garment);
  if (strokes.empty() && (!record || record->lines.empty()))
    throw std::invalid_argument("there is no line to keep; draw one, or switch one on");
  OfFilesAlone of_files(listener);
  KeepReport report = keep(keep_job(sketch, strokes), of_files);
  if (!report.ran || report.lines.interrupted || listener.cancelled()) throw physics::Cancelled("cancelled");
  KeptSketch kept;
  kept.all_hold = report.all_hold();
  kept.colours = colours_of_verdicts(report);
  kept.legend = legend_of_verdicts;
  for (const KeptLine& line : report.lines.lines) {
    const std::size_t i = std::size_t(line.line);
    kept.lines.push_back({i < report.record.lines.size() ? report.record.lines[i].name : "a line",
                          look_of(line.verdict).word, words(line, report.record)});
  }
  for (const Warning& w : report.warnings) kept.remarks.push_back(w.text);
  kept.file = std::move(report.garment);
  return kept;
}

}  // namespace furrow::jobs
