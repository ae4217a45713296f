// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/oscillations.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "physics/cloth/membrane.h"
#include "physics/motion/leapfrog_step.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/gravity.h"
#include "tests/cases/modes.h"

namespace furrow::cases {
namespace {

using physics::Cloth;
using physics::Vec3;

using std::numbers::pi;

void add_particle(Cloth& cloth, const Vec3& x, double mass, bool held) {
  cloth.particles.x.push_back(x);
  cloth.particles.v.push_back(Vec3::Zero());
  cloth.particles.mass.push_back(mass);
  cloth.particles.inv_mass.push_back(held ? 0 : 1 / mass);
}

void hold_border(Cloth& cloth) {
  for (const EdgeApexes& e : edges_of(cloth.triangles)) {
    if (e.left >= 0 && e.right >= 0) continue;
    for (const int i : {e.a, e.b}) cloth.particles.inv_mass[i] = 0;
  }
}

/// Sum of the displacements' squares [m^2].
double spread(const physics::PackedCloth& now, const std::vector<Vec3>& rest) {
  double sum = 0;
  for (int i = 0; i < now.particles(); ++i) {
    const auto& x = now.x[i];
    sum += (Vec3(x.x, x.y, x.z) - rest[now.particle[i]]).squaredNorm();
  }
  return sum;
}

bool grows(const Cloth& start, const std::vector<Vec3>& rest, double dt, int steps) {
  physics::ThreadPool pool(1);
  physics::Motion motion(start, {.gravity = Vec3::Zero()}, pool);
  const double most = 1e12 * spread(motion.cloth(), rest);
  for (int i = 0; i < steps; ++i) {
    leapfrog_step(motion, dt);
    if (i % 50 == 49 && !(spread(motion.cloth(), rest) < most)) return true;
  }
  return !(spread(motion.cloth(), rest) < most);
}

}  // namespace

Cloth walled_chain(int masses, double mass, double k) {
  Cloth cloth;
  for (int i = 0; i <= masses + 1; ++i) add_particle(cloth, {double(i), 0, 0}, mass, i == 0 || i > masses);
  for (int i = 0; i <= masses; ++i) cloth.structural.push_back({i, i + 1, 1, k});
  return cloth;
}

std::vector<double> walled_chain_frequencies(int masses, double mass, double k) {
  std::vector<double> f;
  for (int j = 1; j <= masses; ++j) {
    f.push_back(std::sqrt(k / mass) / pi * std::sin(j * pi / (2 * (masses + 1))));
  }
  return f;
}

Cloth hanging_chain(int links, double length) {
  Cloth cloth;
  const double l = length / links, mass = 1.0 / links, k = 1e4 * gravity / length;
  add_particle(cloth, Vec3::Zero(), mass, true);
  for (int i = 1; i <= links; ++i) {
    add_particle(cloth, {0, -i * l, 0}, mass, false);
    const double tension = (links + 1 - i) * mass * gravity;
    cloth.structural.push_back({i - 1, i, l - tension / k, k});
  }
  return cloth;
}

std::vector<double> hanging_chain_frequencies(int links, double length, int count) {
  Eigen::VectorXd diagonal(links), off(links - 1);
  for (int i = 0; i < links; ++i) diagonal[i] = 2 * i + 1;
  for (int i = 1; i < links; ++i) off[i - 1] = i;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, off, Eigen::EigenvaluesOnly);
  std::vector<double> f;
  for (int i = 0; i < count; ++i) {
    f.push_back(std::sqrt(gravity * links / length * solver.eigenvalues()[i]) / (2 * pi));
  }
  return f;
}

Cloth drum(double tension, double density, double width, double height, int columns, double jitter) {
  Cloth cloth =
      triangular_sheet(width, height, columns, equilateral_rows(width, height, columns), density, jitter);
  cloth.structural.clear();
  const double young = 100 * tension, poisson = 0.3;
  add_flat_membrane(cloth, young, poisson);
  // Stretched by s in both directions: S = Y/(1 - nu) (s^2 - 1)/2 and Cauchy's tension (force over present
  // length) is S F F^T / det F = S.
  const double s = std::sqrt(1 + 2 * tension * (1 - poisson) / young);
  for (auto& t : cloth.membrane) {
    for (double& l : t.rest_lengths) l /= s;
  }
  hold_border(cloth);
  return cloth;
}

double drum_frequency(double tension, double density, double width, double height, int p, int q) {
  return 0.5 * std::sqrt(tension / density) * std::hypot(p / width, q / height);
}

Cloth supported_plate(double rigidity, double density, double side, int columns, double jitter) {
  Cloth cloth = triangular_sheet(side, side, columns, equilateral_rows(side, side, columns), density, jitter);
  cloth.structural.clear();
  add_flat_hinges(cloth, rigidity);
  hold_border(cloth);
  return cloth;
}

double supported_plate_frequency(double rigidity, double density, double side) {
  return pi / (side * side) * std::sqrt(rigidity / density);
}

Cloth cantilever(double rigidity, double density, double length, double width, int rows, double jitter) {
  const double row = length / rows;
  const int columns = std::max(1, int(std::lround(width / (row / std::sqrt(0.75)))));
  Cloth cloth = triangular_sheet(width, length + row, columns, rows + 1, density, jitter);
  cloth.structural.clear();
  std::vector<char> at_clamp(cloth.particles.size(), 0);
  for (std::size_t i = 0; i < at_clamp.size(); ++i) {
    Vec3& x = cloth.particles.x[i];
    // Jitter leaves the border alone, so the clamped row is put back into line.
    const int columns_before = int(i) - (columns + 1);  // place in row 1, of columns + 2
    if (columns_before >= 0 && columns_before < columns + 2) x.y() = row;
    at_clamp[i] = std::abs(x.y() - row) < 1e-9 * row;
    if (x.y() < 1.0001 * row) cloth.particles.inv_mass[i] = 0;
  }
  add_flat_hinges(cloth, rigidity, at_clamp);
  return cloth;
}

double cantilever_frequency(double rigidity, double density, double length) {
  constexpr double beta = 1.8751040687119611;  // cos beta cosh beta = -1
  return beta * beta / (2 * pi * length * length) * std::sqrt(rigidity / density);
}

std::vector<double> computed_frequencies(const Cloth& cloth, int axis, int count) {
  const Unknowns unknowns(cloth, {axis == 0, axis == 1, axis == 2});
  const Eigen::VectorXd omega =
      lowest_frequencies(stiffness(cloth, cloth.particles.x, unknowns), masses(cloth, unknowns), count);
  std::vector<double> f;
  for (const double w : omega) f.push_back(w / (2 * pi));
  return f;
}

LeapfrogRun run_oscillator(double z, int steps) {
  Cloth cloth;
  add_particle(cloth, Vec3::Zero(), 1, true);
  add_particle(cloth, {2, 0, 0}, 1, false);  // along its axis a spring is linear: q = x - 1
  cloth.structural.push_back({0, 1, 1, 1});
  cloth.particles.x[1].x() = 1.5;
  physics::ThreadPool pool(1);
  physics::Motion motion(cloth, {.gravity = Vec3::Zero()}, pool);
  const int place = motion.cloth().particle[0] == 1 ? 0 : 1;
  std::vector<double> q{0.5};
  LeapfrogRun run{0, 1, 1};
  for (int i = 0; i < steps; ++i) {
    leapfrog_step(motion, z);
    q.push_back(motion.cloth().x[place].x - 1);
    const double v = motion.cloth().v[place].x, energy = (q.back() * q.back() + v * v) / 0.25;
    run.energy_least = std::min(run.energy_least, energy);
    run.energy_most = std::max(run.energy_most, energy);
  }
  // Times at which q falls through 0, where it is a sine of theta a step: first and last, theta by iteration.
  std::vector<int> falls;
  for (int i = 0; i < steps; ++i) {
    if (q[i] > 0 && q[i + 1] <= 0) falls.push_back(i);
  }
  if (falls.size() < 2) throw std::invalid_argument("run_oscillator: too few steps for a period");
  const double turns = 2 * pi * double(falls.size() - 1);
  double theta = turns / (falls.back() - falls.front());
  for (int round = 0; round < 100; ++round) {
    const auto time = [&](int i) {
      return i + std::atan2(q[i] * std::sin(theta), q[i] * std::cos(theta) - q[i + 1]) / theta;
    };
    theta = turns / (time(falls.back()) - time(falls.front()));
  }
  run.frequency_ratio = theta / z;
  return run;
}

double located_limit(const Cloth& cloth, double omega_max, int steps, const std::array<bool, 3>& axes) {
  Cloth start = cloth;
  for (std::size_t i = 0; i < start.particles.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (start.particles.inv_mass[i] > 0 && axes[c]) {
        start.particles.x[i][c] += 1e-9 * std::sin(double(3 * i + c) * 12.9898 + double(i % 5));
      }
    }
  }
  double low = 0.9, high = 1.1;
  while (high - low > 1e-4) {
    const double middle = (low + high) / 2;
    (grows(start, cloth.particles.x, middle * 2 / omega_max, steps) ? high : low) = middle;
  }
  return (low + high) / 2;
}

}  // namespace furrow::cases
