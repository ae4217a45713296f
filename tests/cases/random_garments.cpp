// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/random_garments.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "bridge/arrays/couple_bending.h"
#include "bridge/arrays/gather.h"
#include "bridge/arrays/store_rest_state.h"
#include "geometry/fold/line_height.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/sheet.h"
#include "physics/cloth/pins.h"
#include "tests/cases/safe_rule.h"

namespace furrow::cases {
namespace {

using geometry::Point;
using physics::Vec3;

/// The same numbers on every machine.
struct Random {
  std::mt19937_64 engine;
  explicit Random(std::uint64_t seed) : engine(seed) {}
  double operator()(double from, double to) { return from + (to - from) * double(engine() >> 11) * 0x1p-53; }
  double log(double from, double to) { return std::exp((*this)(std::log(from), std::log(to))); }
  bool chance(double share) { return (*this)(0, 1) < share; }
};

/// A sheet, or a cone that is cut open: the place of a point so far across and so high.
struct Cut {
  double width = 0.46, height = 0.46, waist = 0, hem = 0;  // [m]; waist, hem: radii; 0: a sheet
  Point at(double across, double y) const {
    if (waist == 0) return {across, y, 0};
    const double radius = hem + (waist - hem) * y / height, angle = 2 * std::numbers::pi * across / width;
    return {radius * std::sin(angle), y, radius * std::cos(angle)};
  }
};

/// Rows of a closed tube, every other one shifted by half an edge.
geometry::Mesh skirt(const Cut& cut, double edge) {
  const int around = int(std::lround(cut.width / edge)),
            up = int(std::lround(cut.height / (edge * std::numbers::sqrt3 / 2)));
  geometry::Mesh mesh;
  for (int j = 0; j <= up; ++j)
    for (int i = 0; i < around; ++i)
      mesh.add_vertex(cut.at((i + 0.5 * (j % 2)) * cut.width / around, cut.height * j / up));
  const auto v = [&](int i, int j) { return geometry::Vertex(unsigned(j * around + (i + around) % around)); };
  for (int j = 0; j < up; ++j) {
    const int shift = j % 2;
    for (int i = 0; i < around; ++i) {
      mesh.add_face(v(i, j), v(i + 1, j), v(i + shift, j + 1));
      mesh.add_face(v(i + 1, j), v(i + 1 + shift, j + 1), v(i + shift, j + 1));
    }
  }
  return mesh;
}

void jitter(geometry::Mesh& mesh, double amount, Random& random) {
  for (const geometry::Vertex v : mesh.vertices()) {
    if (mesh.is_border(v)) continue;
    const double dx = random(-amount, amount), dy = random(-amount, amount);
    mesh.point(v) = {mesh.point(v).x() + dx, mesh.point(v).y() + dy, 0};
  }
}

void make_cloth(RandomGarment& g, const Cut& cut, Random& random) {
  if (g.kind == "skirt")
    g.mesh = skirt(cut, g.edge);
  else
    g.mesh = geometry::equilateral_sheet(cut.width, cut.height, g.edge);
  if (g.kind == "jittered") jitter(g.mesh, 0.25 * g.edge, random);
  for (const geometry::Vertex v : g.mesh.vertices()) {
    const bool corner = std::abs(g.mesh.point(v).x()) > cut.width / 2 - 1e-6;
    if (g.mesh.point(v).y() > cut.height - 1e-6 && (g.kind != "corners" || corner)) g.pins.push_back(int(v));
  }
}

/// Where a line begins, in the cut [m], and its first direction [rad].
struct Begin {
  double x, y, direction;
};

Begin begin_of(const RandomLine& line, const Cut& cut, Random& random) {
  if (line.kind == LineKind::hem)
    return {random(-cut.width / 3, cut.width / 3), 0, std::numbers::pi / 2 + random(-0.3, 0.3)};
  const double x = random(-cut.width / 2, cut.width / 2), y = random(0, cut.height);
  return {x, y, random(0, 2 * std::numbers::pi)};
}

/// A line that keeps off the border, or begins there.
geometry::Stroke stroke_of(const RandomLine& line, const Cut& cut, Random& random) {
  constexpr double border = 0.03;  // [m]
  const int steps = int(std::ceil(line.length / 0.005));
  for (;;) {
    geometry::Stroke stroke;
    stroke.height = line.height;
    auto [x, y, first] = begin_of(line, cut, random);
    const bool over_hem = line.kind == LineKind::hem;
    bool inside = true;
    for (int i = 0; i <= steps && inside; ++i) {
      inside = (y > border || over_hem) && y < cut.height - border &&
               (cut.waist > 0 || std::abs(x) < cut.width / 2 - border);
      stroke.points.push_back(cut.at(x, y));
      const double direction = first + line.turn * i / steps;
      x += line.length / steps * std::cos(direction);
      y += line.length / steps * std::sin(direction);
    }
    if (inside) return stroke;
  }
}

}  // namespace

physics::Cloth RandomGarment::cloth() const {
  physics::Cloth cloth = bridge::gather(mesh, springs);
  physics::pin(cloth.particles, pins);
  physics::stiffen_clamps(cloth);
  bridge::couple_bending(mesh, springs, cloth);
  return cloth;
}

std::vector<double> RandomGarment::base() const {
  std::vector<double> result;
  for (const RandomLine& line : lines) result.push_back(line.base);
  return result;
}

namespace {

RandomLine plain_line(Random& random) {
  RandomLine line;
  line.length = random(0.1, 0.5);
  line.turn = random.chance(0.5) ? random(-1.5, 1.5) : 0;
  line.height = random(0.003, 0.015) * (random.chance(0.5) ? 1 : -1);
  return line;
}

RandomLine ornate_line(int number, Random& random) {
  RandomLine line;
  line.kind = std::array{LineKind::hem, LineKind::curve, LineKind::ring}[std::size_t(number) % 3];
  const bool ring = line.kind == LineKind::ring;
  const bool hem = line.kind == LineKind::hem;
  line.length = ring ? random(0.3, 0.5) : hem ? random(0.1, 0.2) : random(0.15, 0.35);
  line.turn = ring ? 2 * std::numbers::pi : hem ? 0 : random.chance(0.5) ? 3 : -3;
  line.height = random(0.003, 0.012) * (random.chance(0.5) ? 1 : -1);
  return line;
}

}  // namespace

RandomGarment random_garment(std::uint64_t seed, int lines, double edge, bool ornate) {
  constexpr const char* kinds[] = {"sheet", "jittered", "skirt", "corners"};
  Random random(seed);
  RandomGarment g;
  g.kind = kinds[int(random(0, 4))];
  g.edge = random(g.kind == std::string("skirt") ? 0.025 : 0.018, 0.03);
  if (edge > 0) g.edge = edge;
  Cut cut;
  if (g.kind == "skirt") cut = {2 * std::numbers::pi * 0.16, 0.32, 0.12, 0.2};
  make_cloth(g, cut, random);
  g.springs.membrane = random.chance(0.75) ? bridge::Membrane::triangles : bridge::Membrane::van_gelder;
  g.springs.bending = bridge::Bending::hinge;
  g.springs.rigidity = random.log(1e-6, 1e-4);
  g.springs.stretch = random.log(100, 1000);
  std::vector<geometry::Stroke> strokes;
  for (int i = 0; i < lines; ++i) {
    const RandomLine line = ornate ? ornate_line(i, random) : plain_line(random);
    strokes.push_back(stroke_of(line, cut, random));
    g.lines.push_back(line);
  }
  const geometry::WrinkleReport report = geometry::wrinkle(g.mesh, strokes, tests::safe_rule());
  for (int i = 0; i < lines; ++i) g.lines[i].base = report.lines[i].base_height;
  g.springs.mean_structural_length = report.mean_structural_length;
  g.springs.mean_bending_length = report.mean_bending_length;
  return g;
}

std::vector<double> heights_of(const RandomGarment& garment) {
  std::vector<double> heights(garment.lines.size(), NAN);
  for (const geometry::LineHeight& h : geometry::line_heights(garment.mesh))
    heights[h.line] = h.height - garment.lines[h.line].base;
  return heights;
}

std::vector<double> heights_after(const RandomGarment& garment, physics::Cloth cloth,
                                  const physics::SimulateOptions& run, std::uint64_t seed, double seconds,
                                  double gust) {
  RandomGarment stored = garment;
  physics::soften_clamps(cloth);
  bridge::scatter(cloth.particles, stored.mesh);
  bridge::store_rest_state(cloth, stored.springs, stored.mesh);
  cloth = stored.cloth();
  Random random(seed);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const Vec3 way(random(-1, 1), random(-1, 1), random(-1, 1));
    if (cloth.particles.inv_mass[i] > 0) cloth.particles.x[i] += 1e-4 * way.normalized();
  }
  physics::SimulateOptions options = run;
  options.seconds = seconds;
  options.dt_factor = run.dt_factor / 2;
  options.air_drag = run.air_drag / 2;
  physics::simulate(cloth, nullptr, options);
  if (gust > 0)
    for (const Vec3& side : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0)}) {
      options.gravity = run.gravity + gust * side;
      options.seconds = 0.4;
      physics::simulate(cloth, nullptr, options);
      options.gravity = run.gravity;
      options.seconds = side.x() < 0 ? 5 : 1;  // what swings has no height of its own
      physics::simulate(cloth, nullptr, options);
    }
  bridge::scatter(cloth.particles, stored.mesh);
  return heights_of(stored);
}

}  // namespace furrow::cases
