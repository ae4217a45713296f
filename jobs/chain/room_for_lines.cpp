// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/room_for_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh/property_names.h"

namespace furrow::jobs {
namespace {

constexpr double least_room = 0.8;  ///< of a line's height
constexpr double full = 0.9;        ///< of its greatest height: there it is measured
/// Of the gap: as near to the body as cloth beside a fold may lie before, as it is lifted to the gap with the
/// fold. Seen on a tight top with valleys of 4, 8 and 15 mm.
constexpr double lift = 0.5;

physics::Vec3 vector_of(const geometry::Point& p) { return {p.x(), p.y(), p.z()}; }

/// A vertex of a line.
struct Raised {
  double height, room;  ///< [m]
};

/// By line id.
std::vector<std::vector<Raised>> raised_vertices(const io::MeshFile& drawn, std::size_t lines,
                                                 const physics::Collider& body, double gap) {
  std::vector<std::vector<Raised>> raised(lines);
  const auto line = geometry::find_map(drawn.mesh, geometry::attribute::line);
  const auto before = geometry::find_map(drawn.mesh, geometry::attribute::rest_position);
  if (!line || !before) return raised;
  for (const geometry::Vertex v : drawn.mesh->vertices()) {
    const physics::Vec3 x = vector_of(drawn.mesh->point(v)),
                        flat((*before)[v][0], (*before)[v][1], (*before)[v][2]);
    if ((*line)[v] < 0 || std::size_t((*line)[v]) >= lines || !flat.allFinite()) continue;
    const double height = (x - flat).norm();
    const bool is_free = body.at(x).value >= gap;
    raised[(*line)[v]].push_back(
        {height, is_free ? height : std::clamp(body.at(flat).value - lift * gap, 0.0, height)});
  }
  return raised;
}

/// The share of a line's height for which there is room [-].
double share_of_room(const std::vector<Raised>& line) {
  double most = 0, heights = 0, rooms = 0;
  for (const Raised& v : line) most = std::max(most, v.height);
  for (const Raised& v : line)
    if (v.height >= full * most) heights += v.height, rooms += v.room;
  return heights > 0 ? rooms / heights : 1;
}

}  // namespace

std::optional<Warning> lines_without_room(const io::MeshFile& drawn, const physics::Collider& body,
                                          double gap) {
  const auto record = io::find_wrinkle_record(drawn);
  if (!record) return std::nullopt;
  const auto raised = raised_vertices(drawn, record->lines.size(), body, gap);
  std::string words, first;
  for (std::size_t i = 0; i < raised.size(); ++i) {
    const double share = share_of_room(raised[i]);
    if (share >= least_room) continue;
    if (first.empty()) first = record->lines[i].name;
    const double height = std::abs(record->lines[i].height);
    words += fmt::format("{}'{}' about {:.2g} of {:.3g} mm", words.empty() ? "" : ", ", record->lines[i].name,
                         1000 * share * height, 1000 * height);
  }
  if (words.empty()) return std::nullopt;
  return Warning{"lines_without_room",
                 "the body leaves no room for all of what was drawn; what can stand: " + words +
                     "; draw it no higher, or on a wider garment",
                 first, "height"};
}

}  // namespace furrow::jobs
