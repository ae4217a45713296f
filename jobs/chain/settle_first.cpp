// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/settle_first.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/stiffness.h"
#include "geometry/stroke/project_onto_surface.h"
#include "io/stroke/resolve_strokes.h"
#include "jobs/chain/hold_drawn.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/draw/line_round.h"
#include "jobs/rest/drape_garment.h"

namespace furrow::jobs {
namespace {

using geometry::Point;

/// Carries points from a garment's shape to another of the same faces.
class Carrier {
 public:
  Carrier(const geometry::Mesh& from, const geometry::Mesh& to) : to_(to), surface_(from) {}

  Point operator()(const Point& p, const std::optional<geometry::Vector>& direction) const {
    geometry::SurfaceHit hit = surface_.closest(p);
    if (direction)
      if (const auto along = surface_.first_hit(p, *direction)) hit = *along;
    const Point carried = geometry::position_of(to_, hit.point);
    return hit.on_border ? carried + (p - hit.position) : carried;
  }

 private:
  const geometry::Mesh& to_;
  geometry::SurfaceProjector surface_;
};

/// Its points, and between them one for each `spacing` [m], carried: it lies on the same threads as before.
class CarriedStroke {
 public:
  CarriedStroke(const geometry::Stroke& stroke, const Carrier& carrier, double spacing)
      : from_(stroke), carrier_(carrier), spacing_(spacing), result_(stroke) {
    result_.points.clear(), result_.breaks.clear(), result_.heights.clear(), result_.widths.clear();
    result_.direction.reset();
  }

  geometry::Stroke make() {
    const auto& breaks = from_.breaks;
    for (std::size_t i = 0; i < from_.points.size(); ++i) {
      if (i > 0 && std::find(breaks.begin(), breaks.end(), i) != breaks.end())
        result_.breaks.push_back(result_.points.size());
      else if (i > 0)
        lead(i - 1, i);
      add(i, i, 0);
    }
    if (from_.closed && from_.points.size() > 1) lead(from_.points.size() - 1, 0);
    return std::move(result_);
  }

 private:
  /// Between two of its points.
  void add(std::size_t a, std::size_t b, double share) {
    const auto mix = [&](const auto& list) { return (1 - share) * list[a] + share * list[b]; };
    const geometry::Point p = from_.points[a], q = from_.points[b];
    result_.points.push_back(carrier_(p + share * (q - p), from_.direction));
    if (!from_.heights.empty()) result_.heights.push_back(mix(from_.heights));
    if (!from_.widths.empty()) result_.widths.push_back(mix(from_.widths));
  }
  void lead(std::size_t a, std::size_t b) {
    const double length =
        std::sqrt(CGAL::squared_distance(geometry::Point(from_.points[a]), geometry::Point(from_.points[b])));
    const int n = int(std::clamp(length / spacing_, 1.0, 1000.0));
    for (int k = 1; k < n; ++k) add(a, b, double(k) / n);
  }

  const geometry::Stroke& from_;
  const Carrier& carrier_;
  double spacing_;
  geometry::Stroke result_;
};

/// The garment as it was made, complete, before it was brought to rest.
io::MeshFile made(const io::Scene& scene, const Context& context) {
  io::MeshFile file = begin_garment(scene, context);
  complete_garment(file, scene.material);
  return file;
}

}  // namespace

std::optional<MemoryFiles> settle_first(const io::Scene& scene, double gap, const Budget& budget,
                                        const Context& context) {
  SilentListener silent(context.listener);
  const Context quiet{context.frame, silent, context.memory};  // reading has warned before
  const io::MeshFile before = made(scene, quiet);
  io::Scene alone = scene;
  alone.lines.clear();
  alone.starts = 1;
  alone.output = {};
  const ProgressScope progress(context.listener, "settling");
  const BodyCollider body = load_body(*scene.body, quiet, tolerance_for(scene.simulation.contact_gap));
  alone.simulation.contact_gap = gap;
  const auto lines = io::find_wrinkle_record(before);
  const bool holds = lines && !lines->lines.empty() && can_hold_lines(scene.material);
  const Draped draped =
      holds ? hold_drawn(before, alone, &body, budget, quiet) : drape_garment(alone, &body, {}, false, quiet);
  if (draped.end.falls() || !draped.end.finite || draped.report.stopped) return std::nullopt;
  io::MeshFile rests = before;
  for (const geometry::Vertex v : rests.mesh->vertices()) rests.mesh->point(v) = draped.file.mesh->point(v);
  if (holds) io::set_wrinkle_record(rests, *io::find_wrinkle_record(draped.file));  // the lines' presses
  if (auto map = geometry::find_map(rests.mesh, geometry::attribute::rest_position))
    rests.mesh->remove_property_map(*map);  // lines are drawn from where it lies now
  MemoryFiles memory = context.memory ? *context.memory : MemoryFiles{};
  const Carrier carrier(before.mesh, rests.mesh);
  const double spacing = geometry::mean_rest_length(rests.mesh);
  for (const io::SceneLines& lines : scene.lines) {
    if (lines.time > 0) break;
    const io::ResolvedStrokes resolved =
        io::resolve_strokes(read_strokes(lines, quiet), before, lines.options.insertion.max_distance);
    std::vector<io::DrawnStroke>& strokes = memory.strokes[lines.strokes];
    strokes.clear();
    for (const geometry::Stroke& stroke : resolved.strokes)
      strokes.push_back({CarriedStroke(stroke, carrier, spacing).make()});
  }
  memory.meshes[scene.garment] = std::move(rests);
  return memory;
}

void warn_of_refining(const io::Scene& scene, int times, const std::string& as_given,
                      const Context& context) {
  context.warn("refined_first",
               scene.garment.string() + ": refined " +
                   (times == 1 ? "once" : std::to_string(times) + " times") +
                   " before its lines were drawn, as its edges are too long to keep " +
                   geometry::length_text(scene.simulation.contact_gap) + " from the body; " + as_given +
                   " leaves it as it is",
               scene.garment.string(), as_given);
}

}  // namespace furrow::jobs
