// SPDX-License-Identifier: GPL-3.0-or-later
// What the cap on forces does where they displace (method S2.7, S2.14): fast_mode FOLDER writes a ball and a
// cloth at the start, then without the cap and with it, as OBJ files. `scripts/pictures cap` draws them.
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include "physics/rest/settle.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/tension_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr const char* outcomes[] = {"converged", "limit cycle", "unfinished", "stopped", "diverged"};

/// The whole weight divided by the number of particles (method S2.5).
void weigh_evenly(Particles& p) {
  const double sum = std::accumulate(p.mass.begin(), p.mass.end(), 0.0);
  p.mass.assign(p.size(), sum / double(p.size()));
  p.inv_mass.assign(p.size(), double(p.size()) / sum);
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
        cap ? "on" : "off", outcomes[std::size_t(report.outcome)], report.passes, report.residual,
        report.capped, report.touching, cloth.particles.size(), shown);
    write_obj(folder + (cap ? "/on.obj" : "/off.obj"), last, cloth.triangles);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 2) return scene(arguments[1]), 0;
  std::fprintf(stderr, "usage: fast_mode FOLDER\n");
  return 2;
}
