// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/degenerate_faces.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "jobs/base/read_inputs.h"

namespace furrow::jobs {
namespace {

/// "40 s", "3 h", "12 days".
std::string duration_text(double seconds) {
  if (seconds < 3600) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * 86400) return fmt::format("{:.0f} h", seconds / 3600);
  return seconds < 365 * 86400 ? fmt::format("{:.0f} days", seconds / 86400)
                               : fmt::format("{:.2g} years", seconds / (365 * 86400));
}

/// Edges of the bounding box [m].
std::array<double, 3> box_edges(const geometry::Mesh& mesh) {
  if (mesh.number_of_vertices() == 0) return {};
  CGAL::Bbox_3 box;
  for (geometry::Vertex v : mesh.vertices()) box += mesh.point(v).bbox();
  return {box.x_span(), box.y_span(), box.z_span()};
}

/// "m or inch": the units in which a file's mesh of `size` [m] would be as large as what people wear.
std::string units_that_fit(double size, const Frame& frame) {
  constexpr double smallest = 0.2, largest = 3;  // a sock, a coat or a person [m]
  std::string units;
  for (const char* unit : {"m", "cm", "mm", "inch"}) {
    Frame other = frame;
    other.unit = unit;
    const double in_it = size * read_options(other).metres_per_unit / read_options(frame).metres_per_unit;
    if (unit != frame.unit_in_use() && in_it >= smallest && in_it <= largest)
      units += (units.empty() ? "" : " or ") + std::string(unit);
  }
  return units;
}

std::string too_small(double size, const std::string& what, const Frame& frame) {
  if (size >= limits.least_size) return "";
  const std::string units = units_that_fit(size, frame);
  const std::string it = "the " + what + " is " + geometry::length_text(size) + " in size";
  if (!units.empty())
    return it + " with `unit=" + frame.unit_in_use() + "`; say `unit=" + units + "` if its file is in that" +
           (what == "body" ? ", or `body_unit` for the body alone" : "");
  if (what != "body" && size >= limits.least_garment) return "";
  return it + ", and no `unit` makes it a person's; scale it";
}

}  // namespace

void require_allowed(const std::string& demand, const Context& context) {
  if (!context.listener.allows(demand))
    throw std::invalid_argument(demand + "; `force` goes on all the same");
}

std::string odd_size(const geometry::Mesh& mesh, const std::string& what, const Frame& frame) {
  const auto [x, height, z] = box_edges(mesh);
  const bool wide = what != "body" && std::max(x, z) > std::max(height, 10.0);  // a floor may be as wide
  if (height > 10 || wide)
    return "the " + what + " is " + geometry::length_text(wide ? std::max(x, z) : height) +
           (wide ? " wide" : " tall") + "; if its file is not in metres, say so with `unit=cm`, mm or inch" +
           (what == "body" ? ", or with `body_unit` if only the body's is not" : "");
  return too_small(std::max({x, height, z}), what, frame);
}

void require_size(const geometry::Mesh& mesh, const std::string& name, const std::string& what,
                  const Context& context) {
  const std::string fault = odd_size(mesh, what, context.frame);
  if (fault.empty() || context.listener.allows(name + ": " + fault)) return;
  throw geometry::ContentError(name + ": " + fault + "; `force` takes it as it is");
}

void require_area(const geometry::Mesh& mesh, const std::string& name) {
  if (geometry::degenerate_faces(mesh).size() < mesh.number_of_faces()) return;
  throw geometry::ContentError(name + ": none of its faces has an area, so it is no cloth; repair it");
}

bool is_utf8(const std::string& text) {
  try {
    Json(text).dump();
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

void require_heights(const std::vector<io::DrawnStroke>& strokes, const geometry::Mesh& garment,
                     const Context& context) {
  const auto [x, y, z] = box_edges(garment);
  const double size = std::hypot(x, y, z);
  for (const io::DrawnStroke& drawn : strokes) {
    const double height = drawn.stroke.height;
    if (!(std::abs(height) > size / 2)) continue;
    const std::string number = Json(height).dump();
    const std::string demand = "stroke '" + drawn.stroke.name + "': its height is " + number +
                               " m, on a garment of " + geometry::length_text(size) +
                               " from corner to corner; heights are in metres: write " +
                               Json(height / 1000).dump() + " for " + number + " mm";
    if (std::abs(height) <= size)
      context.warn("height", demand, "", "height");
    else if (!context.listener.allows(demand))
      throw geometry::ContentError(demand + "; `force` draws it as it is");
  }
}

void require_refinement(std::size_t faces, double children, int steps, const std::string& option,
                        const Context& context) {
  const double refined = double(faces) * std::pow(children, steps);
  if (refined <= limits.faces) return;
  constexpr double bytes_a_face = 600;  // measured: a mesh with its rest, while it is refined
  require_allowed(fmt::format("`{}={}`: the mesh would have {:.2g} faces and take {:.2g} GB; refine it less",
                              option, steps, refined, 1e-9 * bytes_a_face * refined),
                  context);
}

void require_animation(double seconds, double fps, std::size_t vertices, const Context& context) {
  const double frames = seconds * fps, bytes = frames * 12 * double(vertices);
  if (frames <= limits.frames && bytes <= limits.animation_bytes) return;
  require_allowed(
      fmt::format("`fps={:.4g}`: the animation would have {:.2g} frames and take {:.2g} GB; lower it", fps,
                  frames, 1e-9 * bytes),
      context);
}

void SimulationGate::check(const physics::SimulateProgress& progress) {
  const double steps = (end_ - progress.time) / progress.dt;
  if (allowed_ || !(steps * cost_of_step_ > limits.processor_seconds)) return;
  require_allowed(
      fmt::format("{:.2g} steps of {:.2g} s are to come, about {} of processor time; {}", steps, progress.dt,
                  duration_text(steps * cost_of_step_),
                  step_is_set_
                      ? "take a longer `dt`, or leave it out"
                      : "steps are that short where cloth is light for its stiffness (`density`), or "
                        "faces are next to nothing (`furrow info`: min_angle_deg): mend these, or try "
                        "`integrator=implicit`"),
      context_);
  allowed_ = true;
}

}  // namespace furrow::jobs
