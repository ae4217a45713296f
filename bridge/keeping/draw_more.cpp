// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/draw_more.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/couple_bending.h"
#include "bridge/arrays/gather.h"
#include "geometry/mesh/property_names.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/pins.h"
#include "physics/motion/compensation.h"
#include "physics/motion/state_memory.h"

namespace furrow::bridge {
namespace {

using namespace geometry;
using physics::Vec3;

/// Of what is not held.
Vec3 momentum(const physics::Particles& p, const std::set<Vertex>& held) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!held.count(Vertex(static_cast<Vertex::size_type>(i)))) sum += p.mass[i] * p.v[i];
  return sum;
}

/// Shares the momentum that insertion took or brought among the vertices of the changed faces.
void keep_momentum(Mesh& mesh, physics::Particles& p, const Vec3& wanted, std::span<const Face> changed,
                   const std::set<Vertex>& held) {
  std::set<Vertex> around;
  for (Face f : changed)
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      if (!held.count(v)) around.insert(v);
  double mass = 0;
  for (Vertex v : around) mass += p.mass[v];
  if (!(mass > 0)) return;
  const Vec3 change = (wanted - momentum(p, held)) / mass;
  for (Vertex v : around) p.v[v] += change;
  scatter_velocities(p, mesh);
}

/// The options of the springs with the presses of new lines; those of earlier lines stay.
GatherOptions with_lines(GatherOptions springs, std::span<const WrinkledLine> lines, int first_line) {
  LineShapes fresh = line_shapes({}, first_line);
  for (const WrinkledLine& line : lines) {
    fresh.presses.push_back(line.press);
    fresh.widths.push_back(line.width.value_or(unset_value));
  }
  const auto join = [&](std::vector<double>& list, const std::vector<double>& all, double missing) {
    list.resize(static_cast<std::size_t>(first_line), missing);
    list.insert(list.end(), all.begin() + first_line, all.end());
  };
  join(springs.line_presses, fresh.presses, 1);
  join(springs.line_widths, fresh.widths, unset_value);
  return springs;
}

/// The cloth as it will pull: with its plate, held where it is held.
physics::Cloth coupled(physics::Cloth cloth, const Mesh& mesh, const GatherOptions& springs,
                       const std::vector<Vertex>& held) {
  if (springs.bending != Bending::plate) return cloth;
  std::vector<int> pins;
  for (Vertex v : held) pins.push_back(static_cast<int>(v));
  physics::pin(cloth.particles, pins);
  physics::stiffen_clamps(cloth);
  couple_bending(mesh, springs, cloth);
  return cloth;
}

}  // namespace

DrawMoreReport draw_more(Mesh& mesh, physics::SimulateState& state, std::span<const Stroke> strokes,
                         const DrawMoreOptions& options, const StageObserver& observer) {
  if (!(options.fade > 0))
    throw std::invalid_argument("draw_more: fade = " + std::to_string(options.fade) + " s is not > 0");
  const physics::Cloth before = gather(mesh, options.springs);
  Mesh work = mesh;
  ensure_map(work, attribute::velocity);
  DrawMoreReport report;
  report.wrinkle = wrinkle(work, strokes, options.wrinkle, observer);
  const GatherOptions springs = with_lines(options.springs, report.wrinkle.lines, options.wrinkle.first_line);
  physics::Cloth after = gather(work, springs);
  const std::vector<Vertex> pinned(options.wrinkle.held.begin(), options.wrinkle.held.end());
  const std::set<Vertex> held(pinned.begin(), pinned.end());
  const auto& changed = report.wrinkle.insertion.changed_faces;
  report.momentum_before = momentum(before.particles, held);
  keep_momentum(work, after.particles, report.momentum_before,
                std::vector<Face>(changed.begin(), changed.end()), held);
  report.momentum_after = momentum(after.particles, held);
  report.mean_strain = physics::strain_statistics(before).mean;

  const std::vector<Vec3> jump = physics::force_jump(coupled(before, mesh, options.springs, pinned),
                                                     coupled(after, work, springs, pinned));
  physics::carry_memory(before, after, state);
  for (const Vec3& f : jump) report.largest_jump = std::max(report.largest_jump, f.norm());
  physics::add(state.compensation, jump, state.time);
  state.compensation.time_constant = options.fade;  // of what is left of earlier jumps, too
  state.planned = false;
  state.homes.clear();
  mesh = std::move(work);
  return report;
}

}  // namespace furrow::bridge
