// SPDX-License-Identifier: GPL-3.0-or-later
// cusick FOLDER : Cusick's drape test over the bending length, by settle(), with both laws of hinges:
//   cusick.csv           every start;  gnuplot bench/cusick.gp  draws it
//   cusick_studies.csv   what mesh, stretch, shear and clamp change
//   drape_16.obj ...     drapes of the lowest energy
// The elastic curve beside it comes from another program (static solver of its own, orthotropic membrane with
// Y = 450, G = 50 N/m, 1321 vertices).
#include "tests/cases/cusick.h"

#include <string>

#include "bench/accuracy_table.h"
#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "physics/rest/settle.h"

using namespace furrow;
using namespace furrow::cases;
using physics::HingeLaw;

namespace {

struct Drape {
  Cusick specimen;
  physics::SettleReport report;
  physics::Certificate certificate;
  double coefficient, energy;
};

enum class Way { settled, moved };

/// moved: first leapfrog's damped motion, 6 s; settle starts from its end.
Drape drape(const CusickOptions& options, Way way = Way::settled) {
  Drape d{cusick_specimen(options), {}, {}, 0, 0};
  if (way == Way::moved) {
    physics::SimulateOptions motion;
    motion.gravity = {0, 0, -cusick_gravity};
    motion.seconds = 6;
    motion.air_drag = 4;
    motion.spring_damping = 0.1;
    physics::simulate(d.specimen.cloth, nullptr, motion);
  }
  physics::SettleOptions settling;
  settling.gravity = {0, 0, -cusick_gravity};
  settling.max_iterations = 2000;
  d.report = physics::settle(d.specimen.cloth, nullptr, settling);
  physics::CertificateOptions certifying;
  certifying.gravity = settling.gravity;
  d.certificate = physics::certify(d.specimen.cloth, certifying);
  d.specimen.support = CusickOptions{}.support;  // where the discs end, whatever is held
  d.coefficient = drape_coefficient(d.specimen);
  d.energy = drape_energy(d.specimen);
  return d;
}

void write(bench::Table& table, const std::string& what, const CusickOptions& o, const Drape& d) {
  table.row(what, o.law == HingeLaw::linear ? "linear" : "cosine", 1000 * o.bending_length,
            d.specimen.cloth.particles.size(), o.folds, d.coefficient, drape_nodes(d.specimen), d.energy,
            d.report.residual, d.report.iterations, d.report.factorisations, d.report.converged,
            d.certificate.negative_eigenvalues, d.certificate.frequency);
}

constexpr const char* heading =
    "what,law,c[mm],vertices,folds at the start,DC[-],nodes,energy[J],residual[-],iterations,"
    "factorisations,converged,negative eigenvalues,frequency[Hz]";

void write_obj(const std::string& path, const physics::Cloth& cloth) {
  std::ofstream file(path);
  for (const auto& x : cloth.particles.x) file << "v " << x.x() << ' ' << x.z() << ' ' << -x.y() << '\n';
  for (const auto& [a, b, c] : cloth.triangles) file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

void curve(const std::string& folder) {
  bench::Table table(folder + "/cusick.csv",
                     "Specimen 30 cm, discs 18 cm, 0.18 kg/m^2, Y = 450 N/m, nu = 0.3", heading);
  for (const HingeLaw law : {HingeLaw::linear, HingeLaw::cosine}) {
    const std::vector<double> lengths = law == HingeLaw::linear
                                            ? std::vector<double>{10, 12.5, 16, 20, 25, 32}
                                            : std::vector<double>{10, 16, 20, 25, 32, 40, 50, 64, 80};
    for (const double c : lengths) {
      CusickOptions moving;
      moving.law = law;
      moving.bending_length = c / 1000;
      write(table, "moved", moving, drape(moving, Way::moved));
      double lowest = 0;
      for (const int folds : {5, 6, 7, 8, 9}) {
        CusickOptions o;
        o.law = law;
        o.bending_length = c / 1000;
        o.folds = folds;
        const Drape d = drape(o);
        write(table, "settled", o, d);
        if (law == HingeLaw::cosine || !d.report.converged || d.energy >= lowest) continue;
        lowest = d.energy;
        write_obj(folder + "/drape_" + std::to_string(int(c)) + ".obj", d.specimen.cloth);
      }
    }
  }
}

void studies(const std::string& folder) {
  bench::Table table(folder + "/cusick_studies.csv", "As cusick.csv but for what the first column says",
                     heading);
  const auto add = [&](const std::string& what, const CusickOptions& base) {
    for (const double c : {12.5, 20.0, 32.0}) {
      for (const int folds : base.folds == 0 ? std::vector{0} : std::vector{6, 7, 8}) {
        CusickOptions o = base;
        o.bending_length = c / 1000;
        o.folds = folds;
        write(table, what, o, drape(o));
      }
    }
  };
  for (const HingeLaw law : {HingeLaw::linear, HingeLaw::cosine}) {
    for (const int rings : {10, 15, 20, 25, 30}) {
      CusickOptions o;
      o.rings = rings;
      o.law = law;
      add(std::to_string(rings) + " rings", o);
    }
  }
  for (const auto& [young, rings] :
       {std::pair{130.0, 20}, {1000.0, 20}, {1000.0, 30}, {2000.0, 20}, {2000.0, 30}}) {
    CusickOptions o;  // Y = 130: shear stiffness 50 N/m
    o.young = young;
    o.rings = rings;
    add("Y = " + std::to_string(int(young)), o);
  }
  for (const double poisson : {0.0, 0.5}) {
    CusickOptions o;
    o.poisson = poisson;
    add(poisson == 0 ? "nu = 0" : "nu = 0.5", o);
  }
  CusickOptions plain;
  plain.stiff_clamp = false;
  add("clamp hinges not doubled", plain);
  CusickOptions inside;  // held one ring further in, as if no ring lay on the edge; DC of the same discs
  inside.support = 0.0825;
  add("held at 82.5 mm", inside);
  CusickOptions flat;
  flat.folds = 0;
  add("no folds at the start", flat);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "cusick FOLDER [curve|studies]\n";
    return 2;
  }
  const std::string what = argc > 2 ? argv[2] : "";
  if (what != "studies") curve(argv[1]);
  if (what != "curve") studies(argv[1]);
}
