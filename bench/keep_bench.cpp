// SPDX-License-Identifier: GPL-3.0-or-later
// Drawn ridges on a hanging sheet, as tables (CSV). keep_bench [vertices…]: what is left of them after some
// seconds, with rest states solved for and copied. keep_bench --times [vertices…]: what the solve costs.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>

#include "physics/cloth/dihedral.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/pins.h"
#include "physics/cloth/struts.h"
#include "physics/motion/simulate.h"
#include "physics/plate/press.h"
#include "physics/rest/certificate.h"
#include "physics/rest/clamped_elements.h"
#include "physics/rest/prestress.h"
#include "physics/rest/rigid_imbalance.h"

namespace furrow::bench {
namespace {

using namespace furrow::physics;

constexpr double width = 0.6, height = 0.8, density = 0.15, young = 300;            // m, m, kg/m^2, N/m
constexpr double ridge_height = 0.01, ridge_half_width = 0.03, ridge_length = 0.4;  // m
constexpr double seconds = 2.5, air_drag = 4;                                       // s, 1/s
const Vec3 gravity(0, -9.81, 0);

struct Ridge {
  Vec3 from, to;
  double distance(const Vec3& x) const {
    const Vec3 p(x.x(), x.y(), 0), along = to - from;
    const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - from - t * along).norm();
  }
  bool beside_middle(const Vec3& x) const {  // of its length, so that its ends do not count
    const double t = (Vec3(x.x(), x.y(), 0) - from).dot(to - from) / (to - from).squaredNorm();
    return t > 0.25 && t < 0.75;
  }
};
Ridge ridge_about(const Vec3& centre, const Vec3& direction) {
  const Vec3 half = 0.5 * ridge_length * direction.normalized();
  return {centre - half, centre + half};
}
const Ridge ridges[] = {ridge_about({0.3, -0.12, 0}, {1, 0, 0}), ridge_about({0.12, -0.46, 0}, {0, 1, 0}),
                        ridge_about({0.4, -0.46, 0}, {1, 1, 0})};

double area(const std::vector<Vec3>& x, int a, int b, int c) {
  return 0.5 * (x[b] - x[a]).cross(x[c] - x[a]).norm();
}

/// A flat sheet of equilateral triangles, springs after Van Gelder, hinges of rigidity B, its top row pinned.
Cloth flat_sheet(int vertices, double rigidity) {
  const double edge = std::sqrt(width * height / (vertices * std::sqrt(0.75)));
  const int columns = int(width / edge) + 1, rows = int(height / (edge * std::sqrt(0.75))) + 1;
  Cloth cloth;
  Particles& p = cloth.particles;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      p.x.push_back({edge * (c + 0.5 * (r % 2)), -edge * std::sqrt(0.75) * r, 0});
  p.v.assign(p.size(), Vec3::Zero());
  p.mass.assign(p.size(), 0);
  std::map<std::pair<int, int>, int> tips;
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const int a = r * columns + c, b = a + 1, d = a + columns, e = d + 1;
      if (r % 2 == 0) cloth.triangles.insert(cloth.triangles.end(), {{a, d, b}, {b, d, e}});
      if (r % 2 == 1) cloth.triangles.insert(cloth.triangles.end(), {{a, d, e}, {a, e, b}});
    }
  }
  for (const auto& t : cloth.triangles) {
    for (int i = 0; i < 3; ++i) {
      tips[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
      p.mass[t[i]] += density * area(p.x, t[0], t[1], t[2]) / 3;
    }
  }
  std::map<std::pair<int, int>, double> beside;
  for (const auto& [e, tip] : tips)
    beside[std::minmax(e.first, e.second)] += area(p.x, e.first, e.second, tip);
  for (const auto& [e, sum] : beside) {
    const auto [a, b] = e;
    const double l = (p.x[b] - p.x[a]).norm();
    cloth.structural.push_back({a, b, l, young * sum / (l * l)});
    const auto left = tips.find({a, b}), right = tips.find({b, a});
    if (left == tips.end() || right == tips.end()) continue;
    cloth.hinges.push_back({{a, b, left->second, right->second}, 0, rigidity * l * l / sum});
  }
  for (const double m : p.mass) p.inv_mass.push_back(1 / m);
  for (int c = 0; c < columns; ++c) pin(p, std::vector<int>{c});
  return cloth;
}

void draw(Cloth& cloth) {
  for (Vec3& x : cloth.particles.x)
    for (const Ridge& r : ridges) x.z() += ridge_height * std::max(0.0, 1 - r.distance(x) / ridge_half_width);
}

/// Mean height of a ridge's crest over the cloth beside it; `flat`: positions before drawing.
double height_of(const Ridge& ridge, const std::vector<Vec3>& flat, const std::vector<Vec3>& x) {
  double crest = 0, base = 0;
  int crests = 0, bases = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!ridge.beside_middle(flat[i])) continue;
    const double d = ridge.distance(flat[i]) / ridge_half_width;
    if (d < 0.35) crest += x[i].z(), ++crests;
    if (d > 1 && d < 1.5) base += x[i].z(), ++bases;
  }
  return crest / crests - base / bases;
}

/// Usual practice: rest lengths and angles as drawn.
void copy_shape(Cloth& cloth) {
  const auto& x = cloth.particles.x;
  for (Spring& s : cloth.structural) s.rest_length = (x[s.b] - x[s.a]).norm();
  for (Hinge& h : cloth.hinges)
    h.rest_angle = dihedral_angle(x[h.vertices[0]], x[h.vertices[1]], x[h.vertices[2]], x[h.vertices[3]]);
}

double milliseconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();  // of the processor: one thread, and machines are shared
  work();
  return 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The least of five [ms].
double least(const std::function<void()>& work) {
  double best = milliseconds(work);
  for (int i = 1; i < 5; ++i) best = std::min(best, milliseconds(work));
  return best;
}

/// What the solve for the rest state and its parts cost, and the certificate beside it.
void print_times(int vertices) {
  Cloth cloth = flat_sheet(vertices, 1e-4);
  draw(cloth);
  balance_rigidly(cloth, gravity);
  std::vector<Vec3> net(cloth.particles.size(), Vec3(0, 0, 1));
  FreeStiffness k(cloth);
  const double assembly = least([&] { k.assemble(cloth, cloth.particles.x, Stiffness::positive_part); });
  k.factorise_definite();
  const double factor = least([&] { k.factorise_definite(); });
  const double solve = least([&] { k.solve(net); });
  const double both = least([&] {
    FreeStiffness fresh(cloth);
    fresh.assemble(cloth, cloth.particles.x, Stiffness::positive_part);
    fresh.factorise_definite();
  });
  const double whole = least([&] {
    Cloth copy = cloth;
    prestress(copy);
  });
  prestress(cloth);
  const double certificate = least([&] { certify(cloth); });
  std::printf("%zu,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f\n", cloth.particles.size(), assembly, factor, solve,
              both - assembly - factor, whole, certificate);
}

void print_kept(Cloth cloth, const std::vector<Vec3>& flat, const Certificate& c) {
  const std::vector<Vec3> drawn = cloth.particles.x;
  SimulateOptions o;
  o.seconds = seconds;
  o.air_drag = air_drag;
  const SimulateReport run = simulate(cloth, nullptr, o);
  double drift = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    drift = std::max(drift, (cloth.particles.x[i] - drawn[i]).norm());
  std::printf(",%.2g,%d,%.3g", c.residual, c.negative_eigenvalues, c.smallest_eigenvalue);
  for (const Ridge& r : ridges) {
    std::printf(",%.1f", 100 * height_of(r, flat, cloth.particles.x) / height_of(r, flat, drawn));
  }
  std::printf(",%.3f,%.1f\n", 1e3 * drift, run.seconds);
  std::fflush(stdout);
}

void row(int vertices, double rigidity) {
  Cloth cloth = flat_sheet(vertices, rigidity);
  const std::vector<Vec3> flat = cloth.particles.x;
  draw(cloth);
  balance_rigidly(cloth, gravity);
  const auto begin = [&](const char* how, double angle) {
    std::printf("%zu,%g,%s,%.2f", cloth.particles.size(), rigidity, how, angle * 57.29577951308232);
  };
  Cloth copy = cloth;
  copy_shape(copy);
  begin("copy", 0);
  print_kept(copy, flat, certify(copy));
  std::vector<int> patch;
  for (std::size_t i = 0; i < flat.size(); ++i)
    for (const Ridge& r : ridges)
      if (r.distance(flat[i]) < 1.2 * ridge_half_width) patch.push_back(int(i));
  const auto try_it = [&](const char* how, double pressed, double struts) {
    Cloth solved = cloth;
    press(solved, patch, pressed);
    if (struts > 0) add_struts(solved, patch, {struts});
    const PrestressReport report = prestress(solved);
    const Certificate c = certify(solved);
    begin(how, report.max_angle);
    print_kept(solved, flat, c);
    return c.stable();
  };
  if (try_it("prestress", 1, 0)) return;
  try_it("struts of 3 N/m", 1, 3);
  try_it("pressed x10", 10, 0) || try_it("pressed x30", 30, 0) || try_it("pressed x100", 100, 0);
}

}  // namespace
}  // namespace furrow::bench

int main(int argc, char** argv) {
  const bool times = argc > 1 && std::string(argv[1]) == "--times";
  std::vector<int> sizes;
  for (int i = times ? 2 : 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {2000, 10000};
  if (times) {
    std::printf("# best of 5, one thread, processor time [ms]\n");
    std::printf("vertices,assembly,numeric factor,solve,symbolic factor,whole prestress(),certificate\n");
    for (const int n : sizes) furrow::bench::print_times(n);
    return 0;
  }
  std::printf(
      "vertices,B [N m],rest state,max angle [deg],residual,negative eigenvalues,smallest eigenvalue "
      "[1/s^2],horizontal kept [%%],vertical,diagonal,drift [mm],simulation [s]\n");
  for (const int n : sizes)
    for (const double b : {1e-4, 3e-5, 1e-5}) furrow::bench::row(n, b);
}
