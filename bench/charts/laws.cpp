// SPDX-License-Identifier: GPL-3.0-or-later
// What a law for the stiffness of springs costs and what it is worth: longest step against patch test.
#include <cmath>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/patch_test.h"

namespace furrow::bench {
namespace {

using namespace cases;

struct Named {
  const char* name;
  Carrier carrier;
};
constexpr Named carriers[] = {{"paper", MembraneLaw::paper},
                              {"uniform", MembraneLaw::uniform},
                              {"inverse", MembraneLaw::inverse},
                              {"van_gelder", MembraneLaw::van_gelder},
                              {"constant_strain", std::nullopt}};

}  // namespace

void chart_laws(const std::string& folder, Effort effort) {
  Table table(
      folder + "/laws.csv",
      "Patch test on the unit square, 26 columns, means of the seeds. Errors: |energy - 1|; the largest of"
      " three strains; farthest from the affine place. Jitter: uniform +- j h, then Delaunay.",
      "law,jitter[h],seeds,dilation_error[-],largest_energy_error[-],non_affine[strain h],dt_limit[h "
      "sqrt(rho/Y)]");
  const int rows = equilateral_rows(1, 1, 26), seeds = effort == Effort::quick ? 4 : 10;
  for (const auto& [name, carrier] : carriers) {
    for (const double jitter : {0.0, 0.1, 0.2, 0.3}) {
      const int count = jitter > 0 ? seeds : 1;
      double dilation = 0, worst = 0, away = 0, limit = 0;
      for (int seed = 1; seed <= count; ++seed) {
        const PatchScore s =
            patch_test(triangular_sheet(1, 1, 26, rows, 0.1, jitter, std::uint64_t(seed)), 26, carrier);
        const double error = std::abs(s.dilation.energy - 1);
        dilation += error / count;
        worst += std::max({error, std::abs(s.stretch.energy - 1), std::abs(s.slide.energy - 1)}) / count;
        away += s.dilation.non_affine / count;
        limit += s.dt_limit / count;
      }
      table.row(name, jitter, count, dilation, worst, away, limit);
    }
  }
}

}  // namespace furrow::bench
