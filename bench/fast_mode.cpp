// SPDX-License-Identifier: GPL-3.0-or-later
// Fitting by x += alpha f (method S2.6, S2.7) where it is stable, and what the cap on forces does.
//   fast_mode map > fast_mode.csv;  gnuplot bench/fast_mode.gp  draws it.
//   fast_mode scene FOLDER: a ball and a cloth at the start, then without the cap and with it, as OBJ files;
//   Picture: furrow render start.obj off.obj on.obj --body ball.obj --strip --no-lines --eye 0.55,0.35,0.95
//   --target 0,0,0 --size 700,600 --captions "start,no cap: after 3 passes,cap: after 51792 passes" -o
//   fast-cap.png
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <string>

#include "physics/cloth/pins.h"
#include "physics/rest/settle.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/tension_cloths.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// The whole weight divided by the number of particles (method S2.5).
void weigh_evenly(Particles& p) {
  const double sum = std::accumulate(p.mass.begin(), p.mass.end(), 0.0);
  p.mass.assign(p.size(), sum / double(p.size()));
  p.inv_mass.assign(p.size(), double(p.size()) / sum);
}

/// Hangs from its first particle, at rest lengths.
Cloth chain() {
  Cloth cloth;
  for (int i = 0; i <= 20; ++i) {
    add_particle(cloth, {0, -0.05 * i, 0}, 0.005);
    if (i > 0) cloth.tension.push_back({i - 1, i, 0.05, 10, 0});
  }
  pin(cloth.particles, std::vector<int>{0});
  return cloth;
}

/// Hangs from its first row, at rest lengths, a little off its plane.
Cloth hanging_sheet() {
  Cloth cloth = with_tension(sheet(8, 9, 0.03), 1, 0.3);
  cloth.bending.clear();
  Noise noise(5);
  for (Vec3& x : cloth.particles.x) x.z() = 1e-5 * noise();
  std::vector<int> top(8);
  std::iota(top.begin(), top.end(), 0);
  weigh_evenly(cloth.particles);
  pin(cloth.particles, top);
  return cloth;
}

/// alpha that makes alpha c e / L = 1, e the largest strain where the cloth hangs in balance.
double unit_rate(Cloth cloth) {
  const Settled report = find_rest(cloth, down_to(1e-4));
  std::fprintf(stderr, "balance: residual %g, %s\n", report.residual,
               report.stable ? "stable" : "not stable");
  double most = 0;
  for (const Tension& t : cloth.tension) {
    const double e = (cloth.particles.x[t.b] - cloth.particles.x[t.a]).norm() / t.rest_length - 1;
    most = std::max(most, t.stretch * e / t.rest_length);
  }
  return 1 / most;
}

void try_caps(const char* name, const Cloth& cloth, double unit, double stretched) {
  for (int k = 0; k <= 16; ++k) {
    const double number = 0.04 * std::pow(2, k / 4.0);
    for (const double cap : {1.05, 1.5, 2.0, 5.0, 10.0, 30.0, 100.0, 1000.0, 0.0}) {
      Cloth copy = cloth;
      for (Vec3& x : copy.particles.x) x.y() *= stretched;
      DisplaceOptions options;
      options.rate = number * unit;
      options.max_passes = 50000;
      options.tolerance = 0.02;
      options.cap = cap > 0;
      options.limit = options.replacement = cap;
      const DisplaceReport report = displace_by_force(copy, nullptr, options);
      std::printf("%s,%g,%d,%.6g,%g,%d,%.6g,%s\n", name, stretched, k, number, cap, report.passes,
                  report.residual, name_of(report.outcome));
    }
  }
}

void map() {
  std::printf("# cloth,start's length / rest [-],column,alpha c e / L [-],");
  std::printf("limit = replacement [mean weights; 0: no cap],passes,residual [-],end\n");
  for (const double stretched : {1.0, 1.6}) {
    try_caps("chain", chain(), unit_rate(chain()), stretched);
    try_caps("sheet", hanging_sheet(), unit_rate(hanging_sheet()), stretched);
  }
}

void write_obj(const std::string& path, const std::vector<Vec3>& x,
               const std::vector<std::array<int, 3>>& triangles) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) {
    std::perror(path.c_str());
    std::exit(1);
  }
  for (const Vec3& p : x) std::fprintf(file, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
  for (const auto& t : triangles) std::fprintf(file, "f %d %d %d\n", t[0] + 1, t[1] + 1, t[2] + 1);
  std::fclose(file);
}

/// A cloth of 36 cm over a ball of 20 cm, bulging and stretched by 40 %: far from rest.
void scene(const std::string& folder) {
  constexpr int columns = 25, rows = 29;
  constexpr double edge = 0.015, radius = 0.1, stretch = 0.6;  // m, m, N
  const TriangleMesh mesh = sphere_mesh(radius, 64, 32);
  Cloth rest = with_tension(sheet(columns, rows, edge, 0.1, 1, 1000, 0), stretch, stretch / 3);
  rest.bending.clear();
  const Vec3 middle(edge * columns / 2, -edge * std::sqrt(0.75) * (rows - 1) / 2, 0);
  for (Vec3& x : rest.particles.x) x = Vec3(x.x() - middle.x(), radius + 0.01, middle.y() - x.y());
  add_hinges(rest, 1e-6);
  rest.hinge_law = HingeLaw::cosine;
  weigh_evenly(rest.particles);
  DisplaceOptions options;
  options.rate = edge / (12 * stretch * 0.05);  // stable while strains stay below 5 %, at least
  options.tolerance = 0.05;
  options.max_passes = 100000;
  const Sphere ball(Vec3::Zero(), radius);
  write_obj(folder + "/ball.obj", mesh.vertices, mesh.triangles);
  Cloth start = rest;
  for (Vec3& x : start.particles.x)
    x = Vec3(1.4 * x.x(), x.y() - 2 * (x.x() * x.x() + x.z() * x.z()), 1.4 * x.z());
  write_obj(folder + "/start.obj", start.particles.x, start.triangles);
  for (const bool cap : {false, true}) {
    Cloth cloth = start;
    options.cap = cap;
    // A run that diverges is shown as it was before it went farther than 3 m.
    std::vector<Vec3> last = cloth.particles.x;
    int shown = 0;
    const SettleObserver observer = [&](const SettleProgress& now) {
      double far = 0;
      for (const Vec3& x : cloth.particles.x) far = std::max(far, x.norm());
      if (!(far < 3)) return true;
      last = cloth.particles.x;
      shown = now.iteration;
      return true;
    };
    const DisplaceReport report = displace_by_force(cloth, &ball, options, observer);
    std::printf(
        "cap %s: %s after %d passes, residual %g, %lld forces replaced, %d of %zu touch, shown after %d\n",
        cap ? "on" : "off", name_of(report.outcome), report.passes, report.residual, report.capped,
        report.touching, cloth.particles.size(), shown);
    write_obj(folder + (cap ? "/on.obj" : "/off.obj"), last, cloth.triangles);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 2 && !std::strcmp(arguments[1], "map")) return map(), 0;
  if (count == 3 && !std::strcmp(arguments[1], "scene")) return scene(arguments[2]), 0;
  std::fprintf(stderr, "usage: fast_mode map | fast_mode scene FOLDER\n");
  return 2;
}
