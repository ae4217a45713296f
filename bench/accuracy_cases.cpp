// SPDX-License-Identifier: GPL-3.0-or-later
// accuracy_cases FOLDER [patch|oscillations|friction|twist ...] : writes what cases with known answers
// measure into CSV files in the folder; by default all.
#include <algorithm>

#include "bench/accuracy_table.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/patch_test.h"
#include "tests/cases/twisted_ribbon.h"

namespace furrow::bench {

using namespace cases;
using physics::Cloth;

namespace {

void patch_rows(Table& table, const std::string& mesh, double jitter, int seed, const Cloth& sheet) {
  static const std::pair<const char*, Carrier> carriers[] = {{"paper", MembraneLaw::paper},
                                                             {"uniform", MembraneLaw::uniform},
                                                             {"inverse", MembraneLaw::inverse},
                                                             {"van_gelder", MembraneLaw::van_gelder},
                                                             {"constant_strain", std::nullopt}};
  for (const auto& [name, carrier] : carriers) {
    const PatchScore s = patch_test(sheet, 26, carrier);
    table.row(mesh, jitter, seed, name, s.dilation.non_affine, s.dilation.energy, s.stretch.non_affine,
              s.stretch.energy, s.slide.non_affine, s.slide.energy, s.dt_limit);
  }
}

}  // namespace

void write_patch(const std::string& folder) {
  Table table(folder + "/patch_test.csv",
              "Unit square, 26 columns, border affine, inside at rest, small strain. Energies: 1 = membrane "
              "with nu = 1/3. Jitter: uniform +- j h in x and y, then Delaunay.",
              "mesh,jitter[h],seed,law,dilation_non_affine[eps h],dilation_energy[-],"
              "stretch_non_affine[eps h],stretch_energy[-],slide_non_affine[eps h],slide_energy[-],"
              "dt_limit[h sqrt(rho/Y)]");
  patch_rows(table, "right", 0, 0, right_sheet(1, 1, 26, 26));
  patch_rows(table, "right-alternating", 0, 0, right_sheet(1, 1, 26, 26, 0.1, true));
  const int rows = equilateral_rows(1, 1, 26);
  patch_rows(table, "equilateral", 0, 0, triangular_sheet(1, 1, 26, rows));
  for (const double jitter : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3}) {
    for (int seed = 1; seed <= 10; ++seed) {
      const Cloth sheet = triangular_sheet(1, 1, 26, rows, 0.1, jitter, std::uint64_t(seed));
      patch_rows(table, "equilateral", jitter, seed, sheet);
    }
  }
}

void write_twist(const std::string& folder) {
  Table table(folder + "/twisted_ribbon.csv",
              "Length 1, clamped ends; exact: integral over the width of fibres, in engineering strain for "
              "springs, in Green's strain for membranes (nu = 0, width 0.1).",
              "model,tau=theta*W/2/L[-],end_strain[-],across,along,F/(Y*W),M/(Y*W*W/2),force_error[-],"
              "torque_error[-]");
  const auto add = [&](const char* model, const Twist& t, int across, int along, const RibbonLoad& load,
                       const RibbonLoad& exact) {
    table.row(model, t.tau, t.end_strain, across, along, load.force, load.torque,
              load.force / exact.force - 1, load.torque / exact.torque - 1);
  };
  for (const double tau : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    for (const double strain : {0.0, 0.01, 0.02, 0.05}) {
      const Twist twist{tau, strain};
      for (const int n : {10, 20, 40, 80}) {
        add("springs", twist, n, 10 * n, spring_ribbon(twist, n, 10 * n), fibre_ribbon(twist));
      }
      if (tau > 0.1 || strain == 0) continue;  // beyond, the flat helicoid is not where a membrane rests
      for (const int n : {4, 8, 16}) {
        add("membrane", twist, n, 10 * n, membrane_ribbon(twist, 0.1, n, 10 * n),
            fibre_ribbon(twist, FibreStrain::green));
      }
    }
  }
}

}  // namespace furrow::bench

int main(int argc, char** argv) {
  const std::pair<std::string, void (*)(const std::string&)> parts[] = {
      {"patch", furrow::bench::write_patch},
      {"oscillations", furrow::bench::write_oscillations},
      {"friction", furrow::bench::write_friction},
      {"twist", furrow::bench::write_twist}};
  if (argc < 2) {
    std::cerr << "accuracy_cases FOLDER [patch|oscillations|friction|twist ...]\n";
    return 2;
  }
  try {
    for (const auto& [name, write] : parts) {
      const bool wanted = argc == 2 || std::find(argv + 2, argv + argc, name) != argv + argc;
      if (wanted) write(argv[1]);
    }
  } catch (const std::exception& fault) {
    std::cerr << fault.what() << '\n';
    return 1;
  }
}
