// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a table (CSV) of strips and chains at rest against theory: statics_cases > statics.csv
#include <cmath>
#include <cstdio>

#include "bench/statics_table.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/hanging_chains.h"

namespace furrow::bench {
namespace {

using namespace furrow::tests;

void catenaries() {
  for (const double unevenness : {0.0, 0.7}) {
    Cloth chain = hanging_chain(32, unevenness);
    const auto exact = exact_chain(chain);
    Row row{"catenary node [m]", unevenness > 0 ? "uneven" : "even", 32, 32, 0, 0, 0, 0, 1e-5};
    rest(chain, down_to(1e-6), row);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double error = (chain.particles.x[i] - Vec3(exact[i].x(), exact[i].y(), 0)).norm();
      row.error = std::max(row.error, error);
    }
    print(row);
  }
  for (const int n : {4, 8, 16, 32, 64, 128, 256}) {
    Cloth chain = hanging_chain(n, 0);
    Row row{"catenary sag [m]", "even", double(n), n, 0, 0, 0.505865838778};
    rest(chain, down_to(1e-6), row);
    row.measured = -chain.particles.x[n / 2].y();
    row.error = row.measured - row.reference;
    print(row);
  }
}

void ladders() {
  for (const double gamma : {1.0, 10.0, 25.0, 100.0}) {
    for (const int links : {10, 20, 40, 80, 160}) {
      LadderOptions o;
      o.links = links;
      Strip strip = ladder(o);
      const double gravity = gravity_for(gamma, o.density, o.length, o.rigidity);
      Row row{"ladder tip H/L", "ladder", gamma, links, 1};
      rest(strip.cloth, down_to(1e-4, {0, 0, -gravity}), row);
      row.measured = -strip.tip().z() / o.length;
      row.reference = heavy_elastica(gamma).height;
      row.error = row.measured - row.reference;
      if (links == 40) row.target = gamma > 1 ? 1e-3 : 1e-4;
      print(row);
      row.what = "ladder H/L";
      row.error = row.measured / row.reference - 1;
      print(row);
    }
  }
}

/// H/W of a cantilever.
Row cantilever(const StripOptions& o, double gamma) {
  Strip strip = equilateral_strip(o);
  const double gravity = gravity_for(gamma, o.density, o.length, o.rigidity);
  Row row{"cantilever H/W", "equilateral", gamma, o.rows, o.columns};
  rest(strip.cloth, down_to(1e-5, {0, 0, -gravity}), row);
  const Elastica exact = heavy_elastica(gamma);
  row.measured = -strip.tip().z() / strip.tip().x();
  row.reference = exact.height / exact.width;
  row.error = row.measured / row.reference - 1;
  return row;
}

double largest_error(double gamma) { return gamma >= 10 ? 0.01 : gamma >= 5 ? 0.02 : 0.04; }

void cantilevers() {
  for (const double gamma : {1.0, 5.0, 10.0, 25.0, 100.0}) {
    for (const auto& [rows, columns] : {std::pair{8, 4}, {16, 4}, {16, 8}, {32, 8}, {64, 16}}) {
      StripOptions o;
      o.rows = rows;
      o.columns = columns;
      Row row = cantilever(o, gamma);
      if (columns == 4 ? rows == 16 : columns == 16) row.target = largest_error(gamma);
      print(row);
      if (rows > 16) continue;
      o.clamp_factor = 1;
      row = cantilever(o, gamma);
      row.mesh = "equilateral, plain clamp";
      print(row);
    }
    StripOptions stiff;  // so that free edges curl less
    stiff.rows = 32;
    stiff.columns = 8;
    stiff.young = 20000;
    Row row = cantilever(stiff, gamma);
    row.mesh = "equilateral, membrane 20 kN/m";
    row.target = largest_error(gamma);
    print(row);
  }
}

/// Mean over seeds 1, 2, ...
Row mean_cantilever(StripOptions o, double gamma, int seeds) {
  Row mean{"", "", gamma, o.rows, o.columns};
  mean.report.converged = true;
  for (o.seed = 1; o.seed <= std::uint64_t(seeds); ++o.seed) {
    const Row row = cantilever(o, gamma);
    mean.measured += row.measured / seeds;
    mean.error += row.error / seeds;
    mean.reference = row.reference;
    mean.report.converged = mean.report.converged && row.report.converged;
    mean.seconds += row.seconds;
  }
  return mean;
}

void jittered() {
  for (const double gamma : {1.0, 5.0, 10.0, 25.0, 100.0}) {
    for (const auto& [name, scale] :
         {std::pair{"jitter 0.2 edges", 1.0}, {"jitter 0.2 cells", std::sqrt(0.75)}}) {
      for (const auto& [rows, columns] : {std::pair{16, 4}, {16, 8}, {64, 16}}) {
        StripOptions o;
        o.rows = rows;
        o.columns = columns;
        o.jitter = 0.2 * scale;
        Row row = mean_cantilever(o, gamma, 5);
        row.what = "cantilever H/W of 5 seeds";
        row.mesh = name;
        row.target = gamma >= 10 ? 0.05 : 0.1;
        print(row);
        if (rows > 16) continue;
        row = mean_cantilever(o, gamma, 30);
        row.what = "cantilever H/W of 30 seeds";
        row.mesh = name;
        print(row);
      }
    }
  }
}

/// Springs across edges: drops, and the slope of the drop against the load.
void third_power() {
  double last = 0;
  for (const double gamma : {1e-3, 1e-2, 1e-1, 10.0, 30.0, 100.0}) {
    StripOptions o;
    o.young = 1e5;
    Strip strip = equilateral_strip(o);
    const double edge = strip.width / o.columns, spring = 1000;
    replace_hinges_by_springs(strip, spring);
    const Elastica exact = heavy_elastica(gamma, 3);
    for (Vec3& x : strip.cloth.particles.x) {
      if (x.x() > 0) x.z() = -exact.height * o.length * std::pow(x.x() / o.length, 5.0 / 3);
    }
    const double rigidity = 0.0608929 * spring * std::pow(edge, 4);
    const double gravity = gamma * rigidity / (o.density * std::pow(o.length, 5));
    const double residual = gamma < 0.01 ? 1 : gamma < 1 ? 0.02 : 1e-4;  // round-off hides less
    Row row{"springs across edges H/L", "equilateral", gamma, o.rows, o.columns};
    rest(strip.cloth, down_to(residual, {0, 0, -gravity}), row);
    row.measured = -strip.tip().z() / o.length;
    row.reference = exact.height;
    row.error = row.measured / row.reference - 1;
    print(row);
    if (last > 0 && gamma < 1) {
      const double slope = std::log10(row.measured / last);
      print({"springs across edges slope",
             "equilateral",
             gamma,
             o.rows,
             o.columns,
             slope,
             1.0 / 3,
             slope - 1.0 / 3,
             0.01,
             {},
             0});
    }
    last = row.measured;
  }
}

}  // namespace
}  // namespace furrow::bench

int main() {
  using namespace furrow::bench;
  print_header();
  catenaries();
  ladders();
  cantilevers();
  jittered();
  third_power();
  buckling();
  postbuckled();
}
