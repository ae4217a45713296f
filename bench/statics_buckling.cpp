// SPDX-License-Identifier: GPL-3.0-or-later
// Strips that buckle, and how high they stand behind that.
#include <cmath>
#include <numbers>

#include "bench/statics_table.h"
#include "tests/physics/cloth/strips.h"

namespace furrow::bench {

using namespace furrow::tests;
using physics::Vec3;

void buckling() {
  struct Theory {
    const char* what;
    Vec3 direction;
    double below, above, gamma, target;
  };
  // Greenhill's 7.8373 and Timoshenko's lateral threshold; the lattice bends with nu = -1/3.
  const Theory theories[] = {
      {"self-buckling Gamma (EI = D(1-nu^2) b)", {-1, 0, 0}, 6, 8.5, 7.837347438943 * 8 / 9, 0.05},
      {"self-buckling Gamma (EI = D b)", {-1, 0, 0}, 6, 8.5, 7.837347438943, 0},
      {"lateral buckling Gamma (EI = D b)", {0, -1, 0}, 18, 24, 20.9901076079, 0.05},
      {"lateral buckling Gamma (EI = D(1-nu^2) b)", {0, -1, 0}, 18, 24, 19.7896632365, 0}};
  for (const double ratio : {0.05, 0.1}) {
    for (const int columns : {4, 6, 8}) {
      StripOptions o;
      o.columns = columns;
      o.rows = int(std::lround(columns / ratio / std::sqrt(0.75)));
      const Strip strip = equilateral_strip(o);
      for (const Theory& t : theories) {
        const double gamma = critical_gamma(strip, t.direction, t.below, t.above);
        print({t.what,
               "equilateral",
               ratio,
               o.rows,
               columns,
               gamma,
               t.gamma,
               gamma / t.gamma - 1,
               t.target,
               {},
               0});
      }
    }
  }
}

void postbuckled() {
  for (const auto& [e, height] : {std::pair{0.01, 0.0634627217646},
                                  {0.1, 0.194924311376},
                                  {0.3, 0.314312612956},
                                  {0.5, 0.373306427445}}) {
    for (const int rows : {16, 32, 64}) {
      StripOptions o;
      o.rows = rows;
      o.far_clamp = true;
      Strip strip = equilateral_strip(o);
      for (Vec3& x : strip.cloth.particles.x) {
        const double s = std::clamp(x.x() / o.length, 0.0, 1.0);
        x += o.length * Vec3(-e * s, 0, 0.5 * height * (1 - std::cos(2 * std::numbers::pi * s)));
      }
      Row row{"post-buckled height/L", "equilateral", e, rows, o.columns};
      rest(strip.cloth, down_to(1e-6, Vec3::Zero()), row);
      row.measured = strip.middle(std::size_t(rows) / 2 + 1).z() / o.length;
      row.reference = height;
      row.error = row.measured / height - 1;
      row.target = 0.01;
      print(row);
    }
  }
}

}  // namespace furrow::bench
