// SPDX-License-Identifier: GPL-3.0-or-later
// What must not move an equilibrium, and by how much it does.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "geometry/mesh/border_loops.h"
#include "io/mesh/mesh_file.h"
#include "physics/cloth/elements.h"
#include "tests/cases/draped.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/hanging_chains.h"
#include "tests/physics/rest/settled.h"

namespace furrow::bench {
namespace {

using namespace cases;
using physics::Integrator;
using physics::Vec3;

constexpr double move_target = 1e-3;      // of the size
constexpr double energy_target = 0.01;    // of the elements' energy
constexpr double distance_target = 3e-3;  // m
constexpr double seconds = 120;           // given up after them

struct Method {
  const char* name;
  Integrator integrator;
  int sweeps = 10;

  RestCase operator()(RestCase c) const {
    c.options.integrator = integrator;
    c.options.xpbd.iterations = sweeps;
    if (is_unconditionally_stable(integrator)) c.options.dt = c.second * default_dt(integrator);
    return c;
  }
};
constexpr Method methods[] = {
    {"leapfrog", Integrator::leapfrog},       {"RK4", Integrator::rk4},
    {"implicit", Integrator::implicit},       {"XPBD 100 sweeps", Integrator::xpbd, 100},
    {"XPBD 10 sweeps", Integrator::xpbd, 10}, {"XPBD 1 sweep", Integrator::xpbd, 1}};

enum class Change { rotated, permuted, units, half_step, tenfold_damping };
constexpr std::pair<const char*, Change> changes[] = {{"rotated", Change::rotated},
                                                      {"permuted", Change::permuted},
                                                      {"other units", Change::units},
                                                      {"half the step", Change::half_step},
                                                      {"tenfold damping", Change::tenfold_damping}};

struct Subject {
  std::string name;
  std::function<DrapedCase(std::optional<Change>)> make;  ///< changes of settings change nothing here
  std::optional<geometry::Mesh> garment;                  ///< none: judged by the farthest particle
  /// Whether `quick` measures a method at all, and its answer to the changes, too.
  std::function<bool(const Method&)> quick, quick_changes;
};

bool always(const Method&) { return true; }
bool without_sweeps(const Method& m) { return m.integrator != Integrator::xpbd; }

DrapedCase changed(const RestCase& c, std::optional<Change> change) {
  if (change == Change::rotated) return {nullptr, rotated(c)};
  if (change == Change::permuted) return {nullptr, permuted(c)};
  if (change == Change::units) return {nullptr, in_small_units(c)};
  return {nullptr, c};
}

DrapedCase changed(const Drape& d, std::optional<Change> change) {
  if (change == Change::rotated) return draped(rotated(d));
  if (change == Change::permuted) return draped(permuted(d));
  if (change == Change::units) return draped(through_millimetres(d));
  return draped(d);
}

Subject chain() {
  RestCase c;
  c.cloth = tests::hanging_chain();
  c.size = tests::chain_span;
  c.options.seconds = seconds;
  return {"chain", [c](auto change) { return changed(c, change); }, {}, always, always};
}

Subject cantilever() {
  tests::StripOptions o;
  o.rows = 12, o.columns = 3, o.rigidity = 1e-4;
  RestCase c;
  c.cloth = tests::equilateral_strip(o).cloth;
  c.size = o.length;
  c.options.seconds = seconds;
  c.options.air_drag = 6;
  c.options.gravity = {0, 0, -tests::gravity_for(10, o.density, o.length, o.rigidity)};
  return {"cantilever", [c](auto change) { return changed(c, change); }, {}, without_sweeps, without_sweeps};
}

/// Held at the waist of a figure that leans back by 20 degrees, so that it lies on one side.
Drape skirt() {
  const std::string meshes = FURROW_SOURCE_DIR "/meshes/";
  Drape d;
  d.garment = io::read_mesh(meshes + "skirt.obj").mesh;
  d.body = io::read_mesh(meshes + "mannequin.obj").mesh;
  const auto loops = geometry::border_loops(d.garment);
  for (geometry::Vertex v : loops[geometry::find_border_loop(loops, "top")].vertices) {
    d.held.push_back(int(v));
  }
  d.springs.structural_stiffness = d.springs.stretch = 300;
  d.springs.rigidity = 1e-4;
  d.options.gravity = 9.81 * Vec3(0, -std::cos(0.35), -std::sin(0.35));
  d.options.seconds = seconds;
  d.options.friction = 0;
  d.options.contact_gap = 0.004;
  d.options.air_drag = 4;
  return d;
}

Subject skirt_of_plates() {
  Drape d = skirt();
  d.springs.membrane = bridge::Membrane::triangles;
  d.springs.bending = bridge::Bending::hinge;
  const auto first = [](const Method& m) { return m.integrator == Integrator::leapfrog; };
  const auto explicit_ones = [](const Method& m) { return !is_unconditionally_stable(m.integrator); };
  return {"skirt of hinges", [d](auto change) { return changed(d, change); }, d.garment, explicit_ones,
          first};
}

Subject skirt_of_springs() {
  const Drape d = skirt();
  const auto some = [](const Method& m) {
    return m.integrator == Integrator::leapfrog || (m.integrator == Integrator::xpbd && m.sweeps <= 10);
  };
  return {"skirt of springs", [d](auto change) { return changed(d, change); }, d.garment, some, some};
}

bool has_hinges(const RestCase& c) { return !c.cloth.hinges.empty(); }

class Chart {
 public:
  Chart(const std::string& folder, Effort effort)
      : table_(
            folder + "/metamorphic.csv",
            "How far equilibria move that should not. moved: farthest particle, over the size (chain: span; "
            "cantilever: length; skirt: twice the farthest from the middle). energy: of the elements, "
            "relative "
            "change. distance: median between the surfaces, both ways. Targets: moved 1e-3 (chain, "
            "cantilever); "
            "|energy| 0.01 and distance 3 mm (skirts). Compared with the same method unchanged; other "
            "integrator: with leapfrog; Newton: with settle().",
            "subject,change,method,dt[s],moved[-],energy[-],distance[m],passes,residual[weight],contacts,"
            "simulated[s],cpu[s]"),
        effort_(effort) {}

  void write(const Subject& subject) {
    const DrapedCase base = subject.make(std::nullopt);
    std::vector<DrapedCase> changed;
    for (const auto& [name, change] : changes) changed.push_back(subject.make(change));
    Rest first;
    for (const Method& m : methods) {
      if (m.integrator == Integrator::xpbd && has_hinges(base.rest)) continue;
      const bool quick = effort_ == Effort::quick;
      if (quick && !subject.quick(m)) continue;
      const Rest rest = come_to_rest(m(base.rest));
      if (&m == methods) first = rest;
      if (&m != methods) row(subject, base.rest, "other integrator", m, rest, first);
      if (!base.rest.body) row(subject, base.rest, "Newton", m, rest, newton(base.rest));
      if (quick && !subject.quick_changes(m)) continue;
      for (std::size_t i = 0; i < changed.size(); ++i) {
        const auto [name, change] = changes[i];
        RestCase c = m(changed[i].rest);
        if (change == Change::half_step) c = with_half_step(c);
        if (change == Change::tenfold_damping) c = with_tenfold_damping(c);
        row(subject, base.rest, name, m, come_to_rest(c), rest);
      }
    }
  }

 private:
  static Rest newton(const RestCase& c) {
    physics::Cloth cloth = c.cloth;
    const tests::Settled report = tests::find_rest(cloth, tests::down_to(1e-6, c.options.gravity));
    Rest rest;
    rest.x = cloth.particles.x;
    rest.at_rest = report.converged && report.stable;
    return rest;
  }

  void row(const Subject& subject, const RestCase& c, const char* change, const Method& method,
           const Rest& rest, const Rest& other) {
    const double moved = farthest(rest.x, other.x) / c.size;
    const double energy = potential_energy(c.cloth, rest.x) / potential_energy(c.cloth, other.x) - 1;
    const double apart = subject.garment ? median_surface_distance(*subject.garment, rest.x, other.x) : NAN;
    const bool near = subject.garment ? std::abs(energy) <= energy_target && apart <= distance_target
                                      : moved <= move_target;
    const bool at_rest = rest.at_rest && other.at_rest;
    table_.row(subject.name, change, method.name, rest.dt, moved, energy, apart,
               !at_rest ? "not at rest"
               : near   ? "yes"
                        : "no",
               rest.residual, rest.contacts, rest.seconds, rest.cpu_seconds);
  }

  Table table_;
  Effort effort_;
};

}  // namespace

void chart_metamorphic(const std::string& folder, Effort effort) {
  Chart table(folder, effort);
  for (const Subject& subject : {chain(), cantilever(), skirt_of_plates(), skirt_of_springs()}) {
    table.write(subject);
  }
}

}  // namespace furrow::bench
