// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/simulate.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <thread>

#include "bridge/gather.h"
#include "bridge/scatter.h"
#include "cli/body.h"
#include "cli/common.h"
#include "cli/pins.h"
#include "cli/simulate_report.h"
#include "cli/subcommands.h"
#include "geometry/bending_springs.h"
#include "geometry/masses.h"
#include "geometry/property_names.h"
#include "geometry/rest_metric.h"
#include "geometry/stiffness.h"
#include "geometry/wrinkle.h"
#include "io/wrinkle_record.h"
#include "physics/push_out.h"

namespace furrow::cli {
namespace {

struct SimulateArguments : CommonArguments {
  std::string in;
  BodyArguments body;
  PinArguments pins;
  std::optional<double> density, dt;
  double structural = 1000, bending = 10, gravity = 9.81;
  bool force_dt = false;
  std::string integrator = "leapfrog";
  physics::SimulateOptions options;
};

bool has_masses(const geometry::Mesh& mesh) {
  const auto mass = geometry::find_map(mesh, geometry::kMass);
  const auto known = [&](geometry::Vertex v) { return mesh.is_isolated(v) || std::isfinite((*mass)[v]); };
  return mass && std::all_of(mesh.vertices().begin(), mesh.vertices().end(), known);
}

/// Masses, rest lengths and bending springs where the file has none: the shape as it is, at rest.
io::WrinkleRecord complete(io::MeshFile& file, const SimulateArguments& a) {
  using namespace geometry;
  Mesh& mesh = file.mesh;
  ensure_rest_lengths(mesh);
  ensure_bending_springs(mesh);
  io::WrinkleRecord record = io::find_wrinkle_record(file).value_or(io::WrinkleRecord{});
  if (!(record.density > 0)) record.density = WrinkleOptions{}.density;
  if (a.density || !has_masses(mesh)) lump_masses(mesh, a.density.value_or(record.density));
  if (!(record.mean_structural_length > 0)) record.mean_structural_length = mean_rest_length(mesh);
  if (!(record.mean_bending_length > 0)) record.mean_bending_length = mean_bending_rest_length(mesh);
  return record;
}

physics::SimulateOptions to_options(const SimulateArguments& a) {
  physics::SimulateOptions o = a.options;
  o.gravity = {0, -a.gravity, 0};
  o.dt = a.dt;
  o.step_rule = a.force_dt ? physics::StepRule::forced : physics::StepRule::limited;
  o.integrator =
      a.integrator == "euler" ? physics::Integrator::explicit_euler : physics::Integrator::leapfrog;
  return o;
}

/// The simulation does not move pins, so those that start inside the body are put on its surface.
void take_pins_out(physics::Cloth& cloth, const std::vector<int>& pins, const BodyCollider& body,
                   const CommonArguments& common) {
  constexpr double kOutside = 1e-6;  // [m], so that rounding leaves none inside
  const physics::PushOutReport report = physics::push_out(cloth.particles.x, pins, body.exact, kOutside);
  if (report.moved)
    warn(std::to_string(report.moved) + " pinned vertices were inside the body; moved onto it, by " +
             std::to_string(1000 * report.farthest) + " mm at most",
         common);
  if (report.still_inside)
    warn(std::to_string(report.still_inside) + " of them could not be brought out", common);
}

int finish(const physics::SimulateReport& report, const SimulateArguments& a) {
  if (report.outcome == physics::Outcome::diverged) {
    std::cerr << "error: the simulation diverged at " << report.time << " s with steps of " << report.dt
              << " s (stable below " << report.dt_limit << " s); nothing was written; "
              << (a.integrator == "euler" ? "explicit Euler always does in the end: use leapfrog"
                  : a.dt                  ? "leave --dt away"
                                          : "look for pins or cloth that start deep inside the body")
              << "\n";
    return kNotConverged;
  }
  if (report.outcome == physics::Outcome::stopped_by_observer) {
    warn("interrupted at " + std::to_string(report.time) + " s; the state reached is in " + a.out, a);
    return kInterrupted;
  }
  return kOk;
}

int simulate(SimulateArguments a) {
  check_output(a.out);
  if (a.body.path.empty() && !a.body.field.empty())
    throw UsageError("--field needs the --body that it was made for");
  io::MeshFile file = read_garment(a.in, a);
  const io::WrinkleRecord record = complete(file, a);
  physics::Cloth cloth = bridge::gather(
      file.mesh, {a.structural, a.bending, record.mean_structural_length, record.mean_bending_length});
  const std::vector<int> pins = pin(cloth, file, a.pins);
  std::optional<BodyCollider> body;
  if (!a.body.path.empty()) {
    body = load_body(a.body, a);
    a.options.contact_gap = contact_gap(a.options.contact_gap, *body, file.mesh);
    take_pins_out(cloth, pins, *body, a);
  }
  const std::vector<double> heights = line_heights_by_id(file.mesh);
  catch_interrupts();
  physics::SimulateReport report;
  {
    Progress progress("simulating", a);
    report = physics::simulate(cloth, body ? &body->field : nullptr, to_options(a),
                               [&](const physics::SimulateProgress& p) {
                                 progress.show(p.time / a.options.seconds);
                                 return !interrupted();
                               });
  }
  if (report.outcome != physics::Outcome::diverged) {
    bridge::scatter(cloth.particles, file.mesh);
    write_mesh(file, a);
  }
  print_report(to_json(report, file, record, heights, body, a.options.contact_gap), a);
  return finish(report, a);
}

void add_physics_options(CLI::App& sub, SimulateArguments& a) {
  physics::SimulateOptions& o = a.options;
  sub.add_option("--seconds", o.seconds, "time to simulate [s]")->capture_default_str();
  sub.add_option("--density", a.density, "mass of the cloth [kg/m^2]; default that of the file, else 0.15");
  sub.add_option("--stiffness", a.structural, "k_std of the structural springs [N/m]")->capture_default_str();
  sub.add_option("--bending", a.bending, "k_std of the bending springs [N/m]")->capture_default_str();
  sub.add_option("--damping", o.spring_damping, "damping of each spring, as a share of critical")
      ->capture_default_str();
  sub.add_option("--drag", o.air_drag, "air drag [1/s]")->capture_default_str();
  sub.add_option("--gravity", a.gravity, "acceleration downwards [m/s^2]")->capture_default_str();
  sub.add_option("--friction", o.friction, "Coulomb friction with the body")->capture_default_str();
  sub.add_option(
         "--gap", o.contact_gap,
         "distance that the cloth keeps from the body [m]; raised to what the mesh and the field need")
      ->capture_default_str();
  sub.add_option("--dt", a.dt, "time step [s]; default 0.9 of the limit");
  sub.add_flag("--force-dt", a.force_dt, "take a --dt above the stability limit");
  sub.add_option("--integrator", a.integrator, "leapfrog, or euler (the baseline that diverges)")
      ->check(CLI::IsMember({"leapfrog", "euler"}))
      ->capture_default_str();
  o.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  sub.add_option("--threads", o.threads, "threads; the result does not depend on them")
      ->check(CLI::Range(1, 256));
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<SimulateArguments>();
  CLI::App* sub = app.add_subcommand(
      "simulate",
      "Let a garment hang, fall and rest on a body\n\n"
      "  furrow simulate sheet.ply --pin-box -0.5,0,-1,-0.5,1,1 -o hung.ply\n"
      "  furrow simulate wrinkled.ply --body body.obj -o worn.ply\n"
      "  furrow simulate skirt.ply --body body.obj --pin-loop top --seconds 3 -o worn.ply");
  sub->add_option("mesh", a->in, "garment to read; PLY of furrow wrinkle brings rest lengths and masses")
      ->required();
  sub->add_option("-o,--output", a->out, "mesh to write: obj, ply, off or stl; - is OBJ to standard output")
      ->required();
  add_body_options(*sub, a->body);
  add_pin_options(*sub, a->pins);
  add_physics_options(*sub, *a);
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = simulate(*a); });
}

}  // namespace furrow::cli
