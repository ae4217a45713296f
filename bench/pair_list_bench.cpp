// SPDX-License-Identifier: GPL-3.0-or-later
// What the detection of pairs costs: two wavy layers of cloth that lie on each other everywhere, at a reach
// (range and margins) of a tenth of the mean edge and more. Processor time of one thread, the best of five.
// pair_list_bench: a line a size and reach.
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

/// Two layers, the second of another mesh, half a thickness more than that apart.
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
double best_of_five(const Work& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const double start = seconds();
    work();
    best = std::min(best, seconds() - start);
  }
  return 1e3 * best;
}

}  // namespace

int main() {
  std::puts("triangles,reach_in_edges,list_ms,pairs,crossings_ms,impact_ns");
  for (const int columns : {54, 155}) {
    const double h = 1.0 / columns, thickness = 0.05 * h;
    const physics::Cloth cloth = two_layers(columns, 1.2 * thickness);
    const physics::PairMesh mesh = physics::pair_mesh(cloth, thickness);
    const auto& x = cloth.particles.x;
    for (const double reach : {0.1, 0.3, 0.5, 1.0}) {
      std::size_t pairs = 0;
      const double margin = 0.5 * (reach * h - thickness);
      const double list = best_of_five([&] {
        physics::PairList made(mesh);
        made.near(x, {}, margin);
        pairs = made.size();
      });
      const double crossings = best_of_five([&] { physics::edge_face_crossings(mesh, x); });
      physics::PairList list_of_all(mesh);
      std::vector<Vec3> way(x.size());
      for (std::size_t i = 0; i < x.size(); ++i) way[i] = Vec3(0, 0, i % 3 ? margin : -margin);
      const auto all = list_of_all.near(x, way, 0);
      double sum = 0;
      const double impacts = best_of_five([&] {
        for (const physics::ListedPair& p : all) {
          physics::MovingPair moving{p.key.edges == 1, {}, {}};
          for (std::size_t i = 0; i < 4; ++i) {
            moving.x[i] = x[std::size_t(p.vertices[i])];
            moving.move[i] = Vec3(0, 0, p.vertices[i] % 3 ? 1e-2 * h : -1e-2 * h);
          }
          sum += physics::time_of_impact(moving, p.range);
        }
      });
      std::printf("%zu,%.1f,%.1f,%zu,%.1f,%.0f\n", mesh.triangles.size(), reach, list, pairs, crossings,
                  pairs && sum > 0 ? 1e6 * impacts / double(all.size()) : 0.0);
    }
  }
}
