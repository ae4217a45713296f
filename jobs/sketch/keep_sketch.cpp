// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/keep_sketch.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "geometry/mesh/property_names.h"
#include "jobs/chain/keep.h"
#include "jobs/sketch/sketch_rounds.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

using bridge::KeptLine;
using bridge::Verdict;
const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return "held";
    case Verdict::pressed:
      return "pressed";
    case Verdict::strutted:
      return "strutted";
    case Verdict::lowered:
      return "lowered";
    case Verdict::may_hold:
      return "may_hold";
    case Verdict::not_known:
      return "not_known";
    case Verdict::cannot_hold:
      break;
  }
  return "cannot_hold";
}

constexpr const char* in_memory = "-";
constexpr const char* legend_of_verdicts =
    "Green: held. Yellow: held, pressed. Orange: held by struts. Blue: stands, lower than asked. "
    "Violet: may hold. Red: cannot hold.";

/// The upper end of a line; of a closed one, its uppermost vertex; none where the mesh has none of its
/// vertices.
std::optional<std::array<double, 3>> end_of(const geometry::Mesh& mesh, int line) {
  const auto id = geometry::find_map(mesh, geometry::attribute::line);
  const auto on_line = geometry::find_map(mesh, geometry::attribute::line_edge);
  std::optional<std::array<double, 3>> best;
  bool best_is_end = false;
  for (const geometry::Vertex v : mesh.vertices()) {
    if (!id || !on_line || (*id)[v] != line) continue;
    int edges = 0;
    for (const geometry::Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      edges += (*on_line)[mesh.edge(h)];
    const geometry::Point p = mesh.point(v);
    const bool is_end = edges == 1;
    if (best && (is_end == best_is_end ? p.y() <= (*best)[1] : best_is_end)) continue;
    best = {p.x(), p.y(), p.z()};
    best_is_end = is_end;
  }
  return best;
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
  kept.legend = legend_of_verdicts;
  for (const KeptLine& line : report.lines.lines) {
    const std::size_t i = std::size_t(line.line);
    kept.lines.push_back({i < report.record.lines.size() ? report.record.lines[i].name : "a line",
                          word_of(line.verdict), words(line, report.record),
                          end_of(report.garment.mesh, line.line)});
  }
  for (const Warning& w : report.warnings) kept.remarks.push_back(w.text);
  kept.file = std::move(report.garment);
  return kept;
}

}  // namespace furrow::jobs
