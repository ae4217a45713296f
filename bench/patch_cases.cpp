// SPDX-License-Identifier: GPL-3.0-or-later
// patch_cases annulus|drape : what triangles lock by and patches do not (docs/bending.md), as CSV:
//   annulus                        Sze's slit annulus, five loads, six meshes of 60 x 10 and of 120 x 20
//   drape RINGS STRETCH JITTER FOLDS...   Cusick's disc, c = 13.1 mm, on a plate
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "bench/cpu_seconds.h"
#include "physics/rest/certificate.h"
#include "physics/rest/settle.h"
#include "tests/cases/cusick.h"
#include "tests/cases/slit_annulus.h"

using namespace furrow;
using namespace furrow::cases;

namespace {

void annulus(int columns, int rows) {
  for (const SheetKind kind : {SheetKind::one_diagonal, SheetKind::by_row, SheetKind::union_jack,
                               SheetKind::cut_jittered, SheetKind::equilateral, SheetKind::jittered}) {
    for (const bool patches : {false, true}) {
      SlitAnnulus plate = slit_annulus(kind, columns, rows, patches);
      for (const AnnulusLift& wanted : annulus_lifts) {
        const double begin = bench::cpu_seconds();
        const AnnulusRest rest = lift(plate, wanted.share);
        std::cout << name_of(kind) << ',' << columns << ',' << (patches ? "patches" : "triangles") << ','
                  << wanted.share << ',' << 100 * (rest.inner / wanted.inner - 1) << ','
                  << 100 * (rest.outer / wanted.outer - 1) << ',' << rest.iterations << ','
                  << rest.factorisations << ',' << rest.converged << ',' << bench::cpu_seconds() - begin
                  << '\n';
      }
    }
  }
}

void drape(CusickOptions o) {
  Cusick specimen = cusick_specimen(o);
  physics::SettleOptions settling;
  settling.gravity = {0, 0, -cusick_gravity};
  settling.max_iterations = 2000;
  const double begin = bench::cpu_seconds();
  const physics::SettleReport report = physics::settle(specimen.cloth, nullptr, settling);
  const double seconds = bench::cpu_seconds() - begin;
  const physics::Certificate certificate = physics::certify(specimen.cloth, {.gravity = settling.gravity});
  std::cout << o.rings << ',' << o.young << ',' << o.jitter << ',' << o.folds << ','
            << (o.patches ? "patches" : "triangles") << ',' << drape_coefficient(specimen) << ','
            << drape_nodes(specimen) << ',' << drape_energy(specimen) << ',' << report.iterations << ','
            << report.factorisations << ',' << report.converged << ',' << certificate.negative_eigenvalues
            << ',' << seconds << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "annulus") {
    std::cout
        << "mesh,columns,membrane,load[-],inner lift off[%],outer lift off[%],iterations,factorisations,"
           "converged,CPU[s]\n";
    annulus(60, 10);
    annulus(120, 20);
  } else if (argc >= 6 && std::string_view(argv[1]) == "drape") {
    CusickOptions o;
    o.rings = std::atoi(argv[2]), o.young = std::atof(argv[3]), o.jitter = std::atof(argv[4]);
    o.bending_length = 0.0131, o.plate = true;
    std::cout << "rings,Y[N/m],jitter[h],folds at the start,membrane,DC[-],nodes,energy[J],iterations,"
                 "factorisations,converged,negative eigenvalues,CPU[s]\n";
    for (const bool patches : {false, true})
      for (int i = 5; i < argc; ++i) {
        o.patches = patches, o.folds = std::atoi(argv[i]);
        drape(o);
      }
  } else {
    std::cerr << "patch_cases annulus | drape RINGS STRETCH JITTER FOLDS...\n";
    return 2;
  }
}
