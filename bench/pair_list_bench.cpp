// SPDX-License-Identifier: GPL-3.0-or-later
// What the detection of pairs costs: two wavy layers of cloth that lie on each other everywhere, and three
// edges apart, at a reach (range and margins) of a tenth of the mean edge and more: the first list of a
// cloth, and one that is made anew. Processor time of one thread, the best of seven. pair_list_bench: a line
// a size, distance and reach.
#include <cmath>
#include <cstdio>
#include <ctime>

#include "physics/pairs/edge_face_crossings.h"
#include "physics/pairs/pair_list.h"
#include "physics/pairs/time_of_impact.h"
#include "tests/cases/flat_meshes.h"

namespace {

using namespace furrow;
using physics::Vec3;

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Two layers, the second of another mesh.
physics::Cloth two_layers(int columns, double apart) {
  physics::Cloth cloth;
  for (const int layer : {0, 1}) {
    const physics::Cloth sheet = cases::triangular_sheet(
        1, 1, columns, cases::equilateral_rows(1, 1, columns), 0.1, 0.2, 1 + unsigned(layer));
    const int first = int(cloth.particles.size());
    for (std::size_t i = 0; i < sheet.particles.size(); ++i) {
      const Vec3& x = sheet.particles.x[i];
      cloth.particles.x.push_back(
          x + Vec3(0, 0, 0.02 * std::sin(9 * x.x()) * std::cos(7 * x.y()) + layer * apart));
      cloth.particles.v.push_back(Vec3::Zero());
      cloth.particles.mass.push_back(sheet.particles.mass[i]);
      cloth.particles.inv_mass.push_back(sheet.particles.inv_mass[i]);
    }
    for (const auto& t : sheet.triangles)
      cloth.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return cloth;
}

template <class Work>
double best_of_seven(const Work& work) {
  double best = 1e9;
  for (int i = 0; i < 7; ++i) {
    const double start = seconds();
    work();
    best = std::min(best, seconds() - start);
  }
  return 1e3 * best;
}

/// The way that pairs may go, for all of a list [ns a pair].
double impact_time(const physics::PairMesh& mesh, const std::vector<Vec3>& x, double h, double margin) {
  physics::PairList list(mesh);
  std::vector<Vec3> way(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) way[i] = Vec3(0, 0, i % 3 ? margin : -margin);
  const auto all = list.near(x, way, 0);
  double sum = 0;
  const double milliseconds = best_of_seven([&] {
    for (const physics::ListedPair& p : all) {
      physics::MovingPair moving{p.key.edges == 1, {}, {}};
      for (std::size_t i = 0; i < 4; ++i) {
        moving.x[i] = x[std::size_t(p.vertices[i])];
        moving.move[i] = Vec3(0, 0, p.vertices[i] % 3 ? 1e-2 * h : -1e-2 * h);
      }
      sum += physics::time_of_impact(moving, p.range);
    }
  });
  return sum > 0 ? 1e6 * milliseconds / double(all.size()) : 0;
}

void measure(int columns, bool touching, double reach) {
  const double h = 1.0 / columns, thickness = 0.05 * h;
  const physics::Cloth cloth = two_layers(columns, touching ? 1.2 * thickness : 3 * h);
  const physics::PairMesh mesh = physics::pair_mesh(cloth, thickness);
  const auto& x = cloth.particles.x;
  const double margin = 0.5 * (reach * h - thickness);
  const double first = best_of_seven([&] { physics::PairList(mesh).near(x, {}, margin); });
  physics::PairList list(mesh);
  list.near(x, {}, margin);
  std::vector<Vec3> moved = x;
  const double again = best_of_seven([&] {
    for (Vec3& p : moved) p.z() += h;
    list.near(moved, {}, margin);
  });
  const double crossings = best_of_seven([&] { physics::edge_face_crossings(mesh, x); });
  std::printf("%zu,%s,%.1f,%.1f,%.1f,%zu,%.1f,%.0f\n", mesh.triangles.size(), touching ? "touching" : "apart",
              reach, first, again, list.size(), crossings, touching ? impact_time(mesh, x, h, margin) : 0.0);
}

}  // namespace

int main() {
  std::puts("triangles,layers,reach_in_edges,first_ms,again_ms,pairs,crossings_ms,impact_ns");
  for (const int columns : {54, 155})
    for (const bool touching : {true, false})
      for (const double reach : {0.1, 0.3, 0.5, 1.0}) measure(columns, touching, reach);
}
