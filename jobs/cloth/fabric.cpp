// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/fabric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bridge/arrays/couple_bending.h"
#include "geometry/mesh/errors.h"
#include "geometry/rest/warp_directions.h"
#include "io/scene/scene_file.h"
#include "jobs/cloth/prepare_garment.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/pins.h"
#include "physics/rest/give_way.h"
#include "physics/rest/settle.h"

namespace furrow::jobs {
namespace {

using geometry::Mesh, geometry::Point, geometry::Vertex;
using physics::Cloth, physics::Vec3;
using std::numbers::pi;

constexpr double gravity = 9.81, disc_radius = 0.15, support_radius = 0.09;

/// The vertices of a ring, by their angle / 2 pi.
struct Ring {
  int first, count;
  double turned;
  double at(int i) const { return (i + turned) / count; }
  Vertex vertex(int i) const { return Vertex(Mesh::size_type(first + ((i % count) + count) % count)); }
};

void zip(Mesh& mesh, const Ring& inner, const Ring& outer) {
  int i = 0, j = int(std::floor(inner.at(0) * outer.count - outer.turned));
  const int end_i = inner.count, end_j = j + outer.count;
  while (i < end_i || j < end_j) {
    const bool out = i == end_i || (j < end_j && outer.at(j + 1) <= inner.at(i + 1));
    mesh.add_face(inner.vertex(i), outer.vertex(j), out ? outer.vertex(j + 1) : inner.vertex(i + 1));
    out ? ++j : ++i;
  }
}

/// Rings at equal distances, each turned against its neighbours, so that no direction is preferred; y is up.
Mesh disc_mesh(int rings) {
  Mesh mesh;
  mesh.add_vertex(Point(0, 0, 0));
  Ring inner{0, 1, 0};
  for (int k = 1; k <= rings; ++k) {
    const Ring ring{int(mesh.num_vertices()), int(std::lround(2 * pi * k)),
                    std::fmod(k * std::numbers::phi, 1)};
    for (int i = 0; i < ring.count; ++i) {
      const double r = disc_radius * k / rings, angle = 2 * pi * ring.at(i);
      mesh.add_vertex(Point(r * std::cos(angle), 0, -r * std::sin(angle)));
    }
    if (k > 1) zip(mesh, inner, ring);
    for (int i = 0; k == 1 && i < ring.count; ++i)
      mesh.add_face(Vertex(0), ring.vertex(i), ring.vertex(i + 1));
    inner = ring;
  }
  return mesh;
}

/// Rows of squares, each cut along the other diagonal than its neighbours.
Mesh strip_mesh(double length, double width, int columns, int rows) {
  Mesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) mesh.add_vertex(Point(length * c / columns, 0, -width * r / rows));
  const auto at = [&](int r, int c) { return Vertex(Mesh::size_type(r * (columns + 1) + c)); };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const Vertex a = at(r, c), b = at(r, c + 1), d = at(r + 1, c), e = at(r + 1, c + 1);
      (r + c) % 2 ? mesh.add_face(a, b, d) : mesh.add_face(a, b, e);
      (r + c) % 2 ? mesh.add_face(b, e, d) : mesh.add_face(a, e, d);
    }
  return mesh;
}

/// Flat cloth at rest, the particles named by `held` pinned. The material outlives nothing.
struct Specimen {
  io::MeshFile file;
  bridge::GatherOptions options;
  Cloth cloth;
};

template <class Held>
Specimen specimen(Mesh mesh, const io::SceneMaterial& material, double warp_angle, const Held& held) {
  Specimen s;
  s.file.mesh = std::move(mesh);
  geometry::set_warp_along(s.file.mesh, {std::cos(warp_angle), 0, -std::sin(warp_angle)});
  complete_garment(s.file, material);
  s.options = spring_options(s.file, material);
  s.cloth = bridge::gather(s.file.mesh, s.options);
  std::vector<int> pins;
  for (std::size_t i = 0; i < s.cloth.particles.size(); ++i)
    if (held(s.cloth.particles.x[i])) pins.push_back(int(i));
  physics::pin(s.cloth.particles, pins);
  physics::stiffen_clamps(s.cloth);
  bridge::couple_bending(s.file.mesh, s.options, s.cloth);
  return s;
}

double from_axis(const Vec3& x) { return std::hypot(x.x(), x.z()); }

/// Where the triangle meets the line z: from, to; from > to if it does not.
std::array<double, 2> crossing(const std::array<const Vec3*, 3>& corners, double z) {
  std::array<double, 2> span{1, 0};
  bool first = true;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = *corners[std::size_t(i)], &q = *corners[std::size_t((i + 1) % 3)];
    if ((p.z() > z) == (q.z() > z)) continue;
    const double x = p.x() + (z - p.z()) / (q.z() - p.z()) * (q.x() - p.x());
    span = first ? std::array{x, x} : std::array{std::min(span[0], x), std::max(span[1], x)};
    first = false;
  }
  return span;
}

/// Of the union of the triangles, seen from above, on 2000 lines [m^2].
double shadow_area(const Cloth& cloth) {
  constexpr int lines = 2000;
  const auto& x = cloth.particles.x;
  const double low = -1.2 * disc_radius, step = -2 * low / lines;
  std::vector<std::vector<std::array<double, 2>>> spans(lines);
  for (const auto& [a, b, c] : cloth.triangles) {
    const auto [least, most] = std::minmax({x[a].z(), x[b].z(), x[c].z()});
    for (int i = std::max(0, int((least - low) / step - 0.5)); i < lines && low + (i + 0.5) * step <= most;
         ++i)
      if (const auto span = crossing({&x[a], &x[b], &x[c]}, low + (i + 0.5) * step); span[0] < span[1])
        spans[std::size_t(i)].push_back(span);
  }
  double area = 0;
  for (auto& line : spans) {
    std::sort(line.begin(), line.end());
    double end = -std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : line) {
      area += step * std::max(0.0, to - std::max(from, end));
      end = std::max(end, to);
    }
  }
  return area;
}

double coefficient_of(const Cloth& cloth) {
  const double held = pi * support_radius * support_radius, all = pi * disc_radius * disc_radius;
  return (shadow_area(cloth) - held) / (all - held);
}

/// The strongest harmonic, 2 to 20, of the rim's distance from the axis; the rim is the last ring.
int nodes_of(const Cloth& cloth, int rings) {
  const std::size_t n = std::size_t(std::lround(2 * pi * rings)), first = cloth.particles.size() - n;
  int strongest = 2;
  double most = -1;
  for (int m = 2; m <= 20; ++m) {
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k < n; ++k)
      sum += from_axis(cloth.particles.x[first + k]) * std::polar(1.0, -2 * pi * m * double(k) / double(n));
    if (std::abs(sum) > most) most = std::abs(sum), strongest = m;
  }
  return strongest;
}

double energy_of(const Cloth& cloth) {
  const auto& p = cloth.particles;
  double energy = physics::potential_energy(cloth, p.x);
  for (std::size_t i = 0; i < p.size(); ++i) energy += p.mass[i] * gravity * p.x[i].y();
  return energy;
}

void check_disc(const DiscJob& job) {
  if (job.rings < 10 || job.rings > 100 || job.rings % 5)
    throw std::invalid_argument("`rings`: " + std::to_string(job.rings) +
                                " does not fit; take a multiple of 5 from 10 to 100");
  if (!(job.bending_friction >= 0 && std::isfinite(job.bending_friction)))
    throw std::invalid_argument("`bending_friction` takes a number >= 0");
  if (job.folds.empty()) throw std::invalid_argument("drape_disc: no start");
  if (!job.material.density) throw std::invalid_argument("drape_disc: the material has no density");
}

}  // namespace

DiscReport drape_disc(const DiscJob& job, Listener& listener) {
  check_disc(job);
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  const Specimen flat = specimen(disc_mesh(job.rings), job.material, 0,
                                 [](const Vec3& x) { return from_axis(x) < support_radius + 1e-9; });
  DiscReport report;
  report.vertices = flat.cloth.particles.size();
  report.least = std::numeric_limits<double>::infinity();
  report.most = -report.least;
  const ProgressScope progress(listener, "draping a disc");
  for (const int folds : job.folds) {
    progress(double(report.starts) / double(job.folds.size()));
    Cloth cloth = flat.cloth;
    auto& p = cloth.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.inv_mass[i] > 0)
        p.x[i].y() = -0.2 * (from_axis(p.x[i]) - support_radius) *
                     (1 + std::cos(folds * std::atan2(p.x[i].z(), p.x[i].x()) + 0.3));
    physics::SettleOptions settling;
    settling.gravity = {0, -gravity, 0};
    settling.max_iterations = 2000;
    const physics::SettleReport settled =
        job.bending_friction > 0
            ? physics::settle_giving_way(cloth, nullptr, job.bending_friction, settling).settle
            : physics::settle(cloth, nullptr, settling);
    if (settled.stopped) throw physics::Cancelled("drape_disc: cancelled");
    const bool rested = settled.converged;
    ++report.starts, report.rested += rested;
    const double energy = energy_of(cloth), coefficient = coefficient_of(cloth);
    if (rested)
      report.least = std::min(report.least, coefficient), report.most = std::max(report.most, coefficient);
    if (report.starts > 1 && !(rested && energy < report.energy)) continue;
    report.energy = energy, report.coefficient = coefficient, report.nodes = nodes_of(cloth, job.rings);
    report.mesh = flat.file.mesh;
    bridge::scatter(p, report.mesh);
  }
  if (report.rested == 0) report.least = report.most = report.coefficient;
  return report;
}

SwatchReport pull_swatch(const io::SceneMaterial& material, double angle, double strain) {
  constexpr double length = 0.2, width = 0.06;
  const double turn = angle * pi / 180;
  Specimen s = specimen(strip_mesh(length, width, 40, 12), material, turn,
                        [&](const Vec3& x) { return x.x() < 1e-9 || x.x() > length - 1e-9; });
  auto& x = s.cloth.particles.x;
  for (Vec3& p : x) p.x() *= 1 + strain;
  physics::SettleOptions settling;
  settling.gravity = Vec3::Zero();
  settling.tolerance = 1e-3;
  SwatchReport report;
  report.rested = physics::settle(s.cloth, nullptr, settling).converged;
  std::vector<Vec3> force(x.size(), Vec3::Zero());
  physics::add_forces(s.cloth, x, force);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i].x() > length * (1 + strain) - 1e-9) report.force -= force[i].x() / width;
  report.modulus = report.force / strain;
  if (material.is_woven())
    report.wanted = physics::strip_modulus(
        {*material.warp_stretch, *material.weft_stretch, *material.thread_shear, material.thread_poisson},
        turn);
  else
    report.wanted = s.options.stretch;
  report.mesh = s.file.mesh;
  bridge::scatter(s.cloth.particles, report.mesh);
  return report;
}

namespace {

io::SceneMaterial stiffer(io::SceneMaterial m, double factor) {
  m.rigidity *= factor;
  for (auto* b : {&m.warp_rigidity, &m.weft_rigidity, &m.bias_rigidity})
    if (*b) **b *= factor;
  return m;
}

}  // namespace

RigidityFit fit_rigidity(const DiscJob& job, double measured, Listener& listener) {
  RigidityFit best{1, std::numeric_limits<double>::infinity(), job.material};
  const auto at = [&](double factor) {
    DiscJob trial = job;
    trial.material = stiffer(job.material, factor);
    const double found = drape_disc(trial, listener).coefficient;
    if (std::abs(found - measured) < std::abs(best.coefficient - measured))
      best = {factor, found, trial.material};
    return found;
  };
  double low = 1. / 32, high = 32;
  const double least = at(low), most = at(high);
  if (!(least <= measured && measured <= most))
    throw std::invalid_argument("`drape`: no rigidity drapes so: a thirty-second of this cloth's gives " +
                                std::to_string(least) + ", 32 times it " + std::to_string(most));
  while (high / low > 1.02) {
    const double middle = std::sqrt(low * high);
    (at(middle) < measured ? low : high) = middle;
  }
  return best;
}

io::SceneMaterial material_of_settings(const Json& settings) {
  return io::read_scene(io::document_of(Json{{"material", settings}}, "fabric"), {}).material;
}

namespace {

/// A figure of a table, > 0.
double figure(const io::TomlDocument& table, const std::string& kind, const std::string& key) {
  const Json& all = table.root->at(kind);
  const double value = all.contains(key) && all[key].is_number() ? all[key].get<double>() : NAN;
  if (!(value > 0) || !std::isfinite(value))
    throw geometry::ContentError(table.place(kind) + ": " + kind + "." + key +
                                 " is missing or not above 0; docs/threads.md lists the figures");
  return value;
}

/// That of strips at 45 degrees, where it was measured; else as of a sheet with B_t = sqrt(B1 B2) / 2.
double bias_or_usual(double measured, double warp, double weft) {
  return measured > 0 ? measured : 4 / (2 / std::sqrt(warp * weft) + 1 / warp + 1 / weft);
}

}  // namespace

Json fabric_from_table(const io::TomlDocument& table) {
  const bool kes = table.root->contains("kes"), fast = table.root->contains("fast");
  if (kes == fast)
    throw geometry::ContentError(table.name +
                                 ": a table has either [kes] or [fast]; docs/threads.md lists both");
  const std::string kind = kes ? "kes" : "fast";
  const auto at = [&](const std::string& key) { return figure(table, kind, key); };
  const auto maybe = [&](const std::string& key) { return table.root[kind].contains(key) ? at(key) : 0.0; };
  Json m;
  double warp, weft, bias;
  if (kes) {  // gf/cm = 0.980665 N/m; B: gf cm^2/cm = 9.80665e-5 N m; G: gf/(cm degree); EMT: % at 500 gf/cm
    m["density"] = at("W") / 100;  // mg/cm^2
    m["warp_stretch"] = 490.3325 / (at("EMT_warp") / 100);
    m["weft_stretch"] = 490.3325 / (at("EMT_weft") / 100);
    m["thread_shear"] = at("G") * 0.980665 * 180 / pi;
    warp = 9.80665e-5 * at("B_warp"), weft = 9.80665e-5 * at("B_weft");
    bias = 9.80665e-5 * maybe("B_bias");
  } else {  // W: g/m^2; C: bending length, mm; E100: % at 98.1 N/m; EB5: % on the bias at 4.9 N/m
    const double weight = at("W") / 1000;
    const auto rigidity = [&](double c) { return weight * 9.807 * std::pow(c / 1000, 3); };
    m["density"] = weight;
    m["warp_stretch"] = 98.0665 / (at("E100_warp") / 100);
    m["weft_stretch"] = 98.0665 / (at("E100_weft") / 100);
    m["thread_shear"] = 123 / at("EB5");
    warp = rigidity(at("C_warp")), weft = rigidity(at("C_weft")), bias = rigidity(maybe("C_bias"));
  }
  m["warp_rigidity"] = warp;
  m["weft_rigidity"] = weft;
  m["bias_rigidity"] = bias_or_usual(bias, warp, weft);
  m["membrane"] = "triangles";
  m["bending_law"] = "plate";
  return m;
}

}  // namespace furrow::jobs
