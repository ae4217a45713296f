// SPDX-License-Identifier: GPL-3.0-or-later
// Implicit steps beside the others: error against processor time of sheets that swing and of a skirt in a
// gust, the energy that steps take out, and what it costs to bring a skirt to rest on a figure.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "bridge/draping/drape.h"
#include "io/scene/fabrics.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "physics/rest/settle.h"
#include "tests/cases/draped.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/garment_pair.h"
#include "tests/cases/plates.h"
#include "tests/cases/swing.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Cloth;
using physics::Integrator;
using physics::Vec3;

using Positions = std::vector<Vec3>;

struct Method {
  const char* name;
  physics::StepperOptions options;
  bool of_limit;                ///< steps are in leapfrog's limit, else in seconds
  std::vector<double> lengths;  ///< the longest first
};

std::vector<Method> methods(bool springs) {
  const std::vector<double> frames{1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480};
  const std::vector<double> short_ones{1.0 / 960, 1.0 / 1920, 1.0 / 3840, 1.0 / 7680, 1.0 / 15360};
  std::vector<Method> list{{"leapfrog", {Integrator::leapfrog}, true, {0.9, 0.45}},
                           {"implicit", {Integrator::implicit}, false, frames},
                           {"tr-bdf2", {Integrator::tr_bdf2}, false, frames}};
  if (springs) list.push_back({"XPBD 1 sweep", {Integrator::xpbd, {1}}, false, short_ones});
  return list;
}

struct Scene {
  std::string name, title;
  Swing swing;
  bool springs;
};

constexpr double side = 0.4, seconds = 0.3;  // m, s

std::vector<int> upper_corners(const Cloth& cloth) {
  std::vector<int> corners;
  for (const double x : {0.0, side}) {
    const auto& all = cloth.particles.x;
    const auto nearer = [&](const Vec3& p, const Vec3& q) {
      return (p - Vec3(x, 0, 0)).squaredNorm() < (q - Vec3(x, 0, 0)).squaredNorm();
    };
    corners.push_back(int(std::min_element(all.begin(), all.end(), nearer) - all.begin()));
  }
  return corners;
}

/// Cotton that lies level and hangs by two corners. Springs have no dashpots here: implicit steps know none.
Scene cotton(const std::string& name, const std::string& title, SheetKind kind) {
  const io::Fabric& fabric = io::fabric_named("cotton");
  Scene scene{name, title, {sheet_of(kind, side, side, 24, fabric.density), {}, seconds}, false};
  Cloth& cloth = scene.swing.cloth;
  cloth.structural.clear();
  add_flat_membrane(cloth, fabric.stretch);
  pin(cloth.particles, upper_corners(cloth));
  add_plate(cloth, physics::isotropic_plate(fabric.rigidity));
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), 0, x.y());
  scene.swing.loads.air_drag = 0.2;
  scene.swing.loads.spring_damping = 0;
  scene.title += ", " + std::to_string(cloth.particles.size()) + " vertices";
  return scene;
}

Scene springs() {
  const Swing swing =
      sheet_swing({.columns = 16, .stiffness = 2e3, .jitter = 0.2, .spring_damping = 0, .seconds = seconds});
  return {"springs", "springs of 2,000 N/m, " + std::to_string(swing.cloth.particles.size()) + " vertices",
          swing, true};
}

/// The median time of three runs; long ones run once.
void write_swing(const Scene& scene, Table& table) {
  const double limit = step_limit(scene.swing);
  const Positions exact = run(scene.swing, {Integrator::rk4}, 0.4 * limit).x;
  for (const Method& m : methods(scene.springs)) {
    for (const double length : m.lengths) {
      const double dt = m.of_limit ? length * limit : length;
      const SwingRun end = run(scene.swing, m.options, dt);
      std::vector<double> cpu{end.cpu_seconds};
      while (cpu.size() < 3 && cpu[0] < 1) cpu.push_back(run(scene.swing, m.options, dt).cpu_seconds);
      std::sort(cpu.begin(), cpu.end());
      const double error = end.diverged ? INFINITY : relative_error(scene.swing, end.x, exact);
      table.row(scene.name, '"' + scene.title + '"', m.name, end.dt, end.dt / limit,
                cpu[cpu.size() / 2] / seconds, error, error * NAN, end.work.open_steps);
    }
  }
}

struct Energies {
  double time;            ///< [s]
  double kinetic, total;  ///< total: with that of elements and of weight; at first 0 [J]
};

/// At each sixtieth of a second of one, of a cloth that nothing damps.
std::vector<Energies> energies_of(const Swing& swing, Integrator integrator, double dt) {
  constexpr int frames = 60;
  const int steps = int(std::ceil(1 / (frames * dt) * (1 - 1e-12)));  // a frame
  physics::ThreadPool pool(1);
  physics::Motion motion(swing.cloth, {.air_drag = 0, .spring_damping = 0}, pool);
  const auto stepper = make_stepper(motion, {integrator});
  physics::Particles p = swing.cloth.particles;
  std::vector<Energies> found;
  double first = 0;
  for (int frame = 0; frame <= frames; ++frame) {
    for (int i = 0; frame > 0 && i < steps; ++i) stepper->step(1.0 / (frames * steps));
    motion.unpack(p);
    Energies e{double(frame) / frames, 0, potential_energy(swing.cloth, p.x)};
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.inv_mass[i] == 0) continue;
      e.kinetic += p.mass[i] * p.v[i].squaredNorm() / 2;
      e.total -= p.mass[i] * motion.loads().gravity.dot(p.x[i]);
    }
    e.total += e.kinetic;
    if (frame == 0) first = e.total;
    e.total -= first;
    found.push_back(e);
  }
  return found;
}

void write_energies(const std::string& folder) {
  Table table(
      folder + "/energy.csv",
      "The sheet of cotton with an inserted line, for 1 s without drag and dashpots, so that its energy "
      "(kinetic, of elements, of weight) should stay. Both over the kinetic energy that leapfrog's run has "
      "at its most.",
      "method,dt[s],time[s],kinetic[-],change[-]");
  const Scene scene = cotton("lined", "", SheetKind::lined);
  const auto leapfrog = energies_of(scene.swing, Integrator::leapfrog, 0.9 * step_limit(scene.swing));
  double most = 0;
  for (const Energies& e : leapfrog) most = std::max(most, e.kinetic);
  const auto write = [&](const char* name, double dt, const std::vector<Energies>& found) {
    for (const Energies& e : found) table.row(name, dt, e.time, e.kinetic / most, e.total / most);
  };
  write("leapfrog", 0.9 * step_limit(scene.swing), leapfrog);
  for (const double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) {
    write("implicit", dt, energies_of(scene.swing, Integrator::implicit, dt));
    write("tr-bdf2", dt, energies_of(scene.swing, Integrator::tr_bdf2, dt));
  }
}

/// A garment in cotton and its body.
struct Dressed {
  GarmentPair pair;
  geometry::Mesh mesh;  ///< as it is worn
  Cloth worn;           ///< at rest, nothing moves
  double gap;           ///< [m]
};

/// A garment of cut quads, where the shared meshes lie beside the project (see CONTRIBUTING.md); else our
/// own.
GarmentPair skirt_and_body() {
  const char* set = std::getenv("FURROW_SHARED");
  const std::filesystem::path shared = set ? set : FURROW_SOURCE_DIR "/../shared";
  const std::filesystem::path pair = shared / "meshes/pairs/mh_female";
  if (std::filesystem::exists(pair)) return read_pair(pair / "skirt.obj", pair / "body.obj");
  return read_pair(FURROW_MESHES "/skirt.obj", FURROW_MESHES "/mannequin.obj");
}

Dressed dressed() {
  Dressed d{skirt_and_body(), {}, {}, 0};
  bridge::DrapeOptions options;
  options.refinements = d.pair.garment.number_of_vertices() < 1000 ? 1 : 0;
  options.settle.friction = 0.4;
  options.settle.gap = d.gap = gap_of(d.pair, options.refinements);
  d.mesh = d.pair.garment;
  bridge::drape(d.mesh, d.worn, &d.pair.field, options,
                make_cotton(d.pair, vertex_at_top(d.mesh), bridge::Bending::plate));
  for (Vec3& v : d.worn.particles.v) v.setZero();
  return d;
}

double way(const Cloth& start, const Positions& end) {
  double square = 0, mass = 0;
  for (std::size_t i = 0; i < end.size(); ++i) {
    square += start.particles.mass[i] * (end[i] - start.particles.x[i]).squaredNorm();
    mass += start.particles.mass[i];
  }
  return std::sqrt(square / mass);
}

/// Air of 12 m/s from the front, for 0.4 s.
struct Gust {
  Dressed d = dressed();
  physics::World world;
  physics::SimulateOptions options;

  Gust() {
    world.collider = &d.pair.field;
    world.wind.velocity = Vec3(0, 0, -12);
    options.seconds = 0.4;
    options.friction = 0.4;
    options.contact_gap = d.gap;
    options.spring_damping = 0;
  }
  struct Run {
    Positions x;
    physics::SimulateReport report;
  };
  Run run(Cloth cloth, Integrator integrator, std::optional<double> dt) {
    options.integrator = integrator;
    options.dt = dt;
    const physics::SimulateReport report = physics::simulate(cloth, world, options);
    return {cloth.particles.x, report};
  }
};

void write_gust(Table& table) {
  Gust gust;
  const Cloth& worn = gust.d.worn;
  const Gust::Run exact = gust.run(worn, Integrator::leapfrog, {});
  char title[100];
  std::snprintf(title, sizeof title, "skirt of %d vertices in a gust, moves by %.0f mm",
                int(worn.particles.size()), 1e3 * way(worn, exact.x));
  const auto write = [&](const char* name, const Gust::Run& r) {
    const bool whole = r.report.outcome == physics::Outcome::finished;
    const double error = whole ? relative_error({worn, {}, 0}, r.x, exact.x) : INFINITY;
    const double apart = whole ? 1e3 * median_surface_distance(gust.d.mesh, r.x, exact.x) : INFINITY;
    table.row("skirt", '"' + std::string(title) + '"', name, r.report.dt, r.report.dt / exact.report.dt_limit,
              r.report.cpu_seconds / gust.options.seconds, error, apart, r.report.open_steps);
  };
  write("leapfrog", exact);
  Cloth beside = worn;
  for (std::size_t i = 0; i < worn.particles.size(); ++i) {
    if (worn.particles.inv_mass[i] == 0) continue;
    beside.particles.x[i] += 1e-6 * Eigen::Array3d(i + 1, 2 * i + 1, 3 * i + 1).sin().matrix();
  }
  write("leapfrog begun 1 um beside", gust.run(beside, Integrator::leapfrog, {}));
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120})
    write("implicit", gust.run(worn, Integrator::implicit, dt));
  for (const double dt : {1.0 / 60, 1.0 / 120}) write("tr-bdf2", gust.run(worn, Integrator::tr_bdf2, dt));
}

void write_rests(const std::string& folder) {
  Table table(
      folder + "/rests.csv",
      "meshes/skirt.obj in cotton (triangles, a plate), held at its top, on the mannequin, friction 0, "
      "from where it lies. settle: until the residual force is 1e-3 of a vertex's weight; in time: "
      "drag 4 1/s, until no vertex moves by more than 1e-5 of the size in 1/4 s. One thread, processor "
      "time. Distance: median between the surfaces, to settle's.",
      "method,dt[s],cpu[s],simulated[s],residual[-],at rest,energy[J],distance[mm]");
  const GarmentPair pair = read_pair(FURROW_MESHES "/skirt.obj", FURROW_MESHES "/mannequin.obj");
  geometry::Mesh mesh = pair.garment;
  const Cloth start = make_cotton(pair, vertex_at_top(mesh), bridge::Bending::plate)(mesh);
  Cloth worn = start;
  physics::SettleOptions options;
  options.friction = 0;
  options.gap = gap_of(pair, 0);
  const double started = thread_seconds();
  const physics::SettleReport report = physics::settle(worn, &pair.field, options);
  const double cpu = thread_seconds() - started;
  const Positions& rest = worn.particles.x;
  table.row("settle", NAN, cpu, 0, report.residual, report.converged ? "yes" : "no",
            potential_energy(worn, rest), 0);
  RestCase c;
  c.cloth = start;
  c.body = &pair.field;
  c.size = 1;
  c.still = 1e-5;
  c.options.seconds = 60;
  c.options.friction = 0;
  c.options.contact_gap = options.gap;
  c.options.air_drag = 4;
  const auto write = [&](const char* name, Integrator integrator, std::optional<double> dt) {
    c.options.integrator = integrator;
    c.options.dt = dt;
    const Rest r = come_to_rest(c);
    table.row(name, r.dt, r.cpu_seconds, r.seconds, r.residual, r.at_rest ? "yes" : "no",
              potential_energy(start, r.x), 1e3 * median_surface_distance(mesh, r.x, rest));
  };
  write("leapfrog", Integrator::leapfrog, {});
  write("implicit", Integrator::implicit, 1.0 / 60);
  write("tr-bdf2", Integrator::tr_bdf2, 1.0 / 60);
}

}  // namespace

void chart_implicit(const std::string& folder, Effort) {
  Table table(
      folder + "/implicit.csv",
      "Sheets of 0.4 m that lie level, hang by two corners and swing for 0.3 s (cotton: triangles, "
      "a plate), and a skirt in cotton on a body, held at its top, from rest, in air of 12 m/s for 0.4 s. "
      "No dashpots. Error: RMS distance from RK4 at 0.4 of leapfrog's limit, of the skirt "
      "from leapfrog, over that of the way; median: between the surfaces. One thread, processor time. "
      "open: steps that were not solved.",
      "scene,title,method,dt[s],dt/limit[-],cpu[s/s],error[-],median[mm],open");
  for (const Scene& scene : {springs(), cotton("even", "cotton, even mesh", SheetKind::equilateral),
                             cotton("lined", "cotton with an inserted line", SheetKind::lined)})
    write_swing(scene, table);
  write_gust(table);
  write_energies(folder);
  write_rests(folder);
}

}  // namespace furrow::bench
