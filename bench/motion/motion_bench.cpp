// SPDX-License-Identifier: GPL-3.0-or-later
// Implicit steps beside leapfrog, as a table (CSV): a garment of cotton at rest on its body, in a gust of 12
// m/s^2 (drag 2 1/s, wind of 6 m/s) that ends at 0.4 s.
//   motion_bench [OPTIONS] GARMENT BODY
//     --refinements 1,2  how often it is refined (Loop); a T-shirt of 3,150 and 12,414 vertices
//     --seconds 0.6,0.2  of motion, for each refinement
//     --leapfrog 0.6,0.2 of these, that leapfrog runs: where that is all of it, errors are told, too
//     --schemes implicit,tr-bdf2
//     --threads 1
//     --hinges           in place of a plate
//     --self             contact of the cloth with itself, in a run beside that without
//     --spin 0.5         no wind: the top loop is held, and within 0.3 s body and loop turn that fast [1/s]
// A row for each scheme: processor seconds a simulated second, how many times fewer than leapfrog's in the
// same run, counts a step, distance from leapfrog's end, how deep the cloth ends in the gap, what energy the
// steps took (less than 0: made), and shares of the processor time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "io/scene/fabrics.h"
#include "physics/motion/simulate.h"
#include "tests/cases/garment_pair.h"

namespace furrow::bench {
namespace {

using physics::Integrator;
using physics::Vec3;

struct Arguments {
  std::vector<double> refinements{1, 2}, seconds{0.6, 0.2}, leapfrog{0.6, 0.2};
  int threads = 1;
  bool self = false;
  double spin = 0;  // [1/s]; 0: a gust
  bridge::Bending bending = bridge::Bending::plate;
  std::string schemes = "implicit,tr-bdf2";
  std::vector<std::string> files;
};

struct Scheme {
  std::string name;
  Integrator integrator;
  double dt;  ///< [s]; 0: its own
  bool self = false;
};

struct Run {
  physics::SimulateReport report;
  std::vector<Vec3> x;
  double seconds = 0;  ///< simulated
  double cost() const { return report.cpu_seconds / seconds; }
};

struct Garment {
  std::string name;
  physics::Cloth cloth;  ///< at rest
  double gap, friction;
  double spin;  ///< of body and what is pinned [1/s]; 0: a gust in its place
};

Garment at_rest(const cases::GarmentPair& pair, const std::string& name, int refinements,
                const Arguments& a) {
  Garment result{name, {}, cases::gap_of(pair, refinements), io::fabric_named("cotton").friction, a.spin};
  bridge::DrapeOptions options;
  options.refinements = refinements;
  options.settle.friction = result.friction;
  options.settle.gap = result.gap;
  options.settle.threads = a.threads;
  geometry::Mesh mesh = pair.garment;
  const std::optional<int> held = a.spin > 0 ? std::optional<int>(cases::vertex_at_top(mesh)) : std::nullopt;
  bridge::drape(mesh, result.cloth, &pair.field, options, cases::make_cotton(pair, held, a.bending));
  return result;
}

/// A gust of air, or a body that turns with what is pinned.
physics::World world_of(const Garment& garment, const physics::Collider& body) {
  physics::World world;
  world.collider = &body;
  if (garment.spin == 0) {
    world.wind.velocity = Vec3(0, 0, 6);
    world.wind.gusts = {{0, 1}, {0.4, 1}, {0.4001, 0}};
    return world;
  }
  world.body_motion.spin =
      physics::Spin{Vec3::Zero(), Vec3::UnitY(), 2 * std::numbers::pi * garment.spin, 0, 0.3};
  physics::MovedPins pins{{}, world.body_motion};
  const physics::Particles& p = garment.cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(p.inv_mass[i] > 0)) pins.particles.push_back(int(i));
  world.pins.push_back(std::move(pins));
  return world;
}

/// How deep what can move ends in the gap, by the body where it stands then [mm].
double deepest(const Garment& garment, const physics::Collider& body, const Run& run) {
  const physics::Pose pose = physics::pose(world_of(garment, body).body_motion, run.seconds);
  double least = 1;
  for (std::size_t i = 0; i < run.x.size(); ++i)
    if (garment.cloth.particles.inv_mass[i] > 0)
      least = std::min(least, body.at(pose.to_body(run.x[i])).value);
  return 1e3 * (garment.gap - least);
}

Run run(const Garment& garment, const physics::Collider& body, const Scheme& scheme, double seconds,
        int threads) {
  const physics::World world = world_of(garment, body);
  physics::SimulateOptions o;
  o.seconds = seconds;
  o.integrator = scheme.integrator;
  if (scheme.dt > 0) o.dt = scheme.dt;
  o.friction = garment.friction;
  o.contact_gap = garment.gap;
  o.threads = threads;
  o.times = true;
  o.self.on = scheme.self;
  physics::Cloth cloth = garment.cloth;
  Run result;
  result.report = physics::simulate(cloth, world, o);
  result.x = cloth.particles.x;
  result.seconds = seconds;
  return result;
}

/// Root of the mean square of distances, and the median [mm].
std::string apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<double> d;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    d.push_back((a[i] - b[i]).norm());
    sum += d.back() * d.back();
  }
  std::nth_element(d.begin(), d.begin() + std::ptrdiff_t(d.size() / 2), d.end());
  char text[64];
  std::snprintf(text, sizeof text, "%.2f,%.2f", 1e3 * std::sqrt(sum / double(a.size())),
                1e3 * d[d.size() / 2]);
  return text;
}

void print(const Garment& garment, const physics::Collider& body, const Scheme& scheme, const Run& run,
           const Run& leapfrog) {
  const physics::SimulateReport& r = run.report;
  const physics::EnergyBalance& e = r.energy;
  const bool comparable = run.seconds == leapfrog.seconds;
  std::printf("%s,%zu,%s,%.3g,%.3g,%.3f,%.1f,%.2f,%.2f,%lld,%s,%s,%.3g,%.2f,%.3g", garment.name.c_str(),
              run.x.size(), scheme.name.c_str(), r.dt, run.seconds, run.cost(), leapfrog.cost() / run.cost(),
              double(r.iterations) / double(r.steps), double(r.factorisations) / double(r.steps),
              static_cast<long long>(r.open_steps), comparable ? apart(run.x, leapfrog.x).c_str() : ",",
              apart(run.x, garment.cloth.particles.x).c_str(), 1e3 * r.kinetic_energy,
              deepest(garment, body, run), 1e3 * e.to_steps());
  double all = 0;
  for (const double t : r.times) all += t;
  for (const double t : r.times) std::printf(",%.0f", 100 * t / all);
  std::printf("\n");
  std::fflush(stdout);
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> list;
  std::istringstream in(text);
  for (std::string item; std::getline(in, item, ',');) list.push_back(std::stod(item));
  return list;
}

Arguments arguments_of(int count, char** words) {
  Arguments a;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--self") {
      a.self = true;
    } else if (word == "--hinges") {
      a.bending = bridge::Bending::hinge;
    } else if (word.rfind("--", 0) != 0) {
      a.files.push_back(word);
    } else if (word == "--schemes" && i + 1 < count) {
      a.schemes = words[++i];
    } else {
      if (++i == count) throw std::invalid_argument(word + " takes a value");
      const std::vector<double> value = numbers(words[i]);
      if (word == "--refinements")
        a.refinements = value;
      else if (word == "--seconds")
        a.seconds = value;
      else if (word == "--leapfrog")
        a.leapfrog = value;
      else if (word == "--threads")
        a.threads = int(value.at(0));
      else if (word == "--spin")
        a.spin = value.at(0);
      else
        throw std::invalid_argument("unknown option " + word);
    }
  }
  if (a.files.size() != 2) throw std::invalid_argument("motion_bench [OPTIONS] GARMENT BODY");
  if (a.seconds.size() != a.refinements.size() || a.leapfrog.size() != a.refinements.size())
    throw std::invalid_argument("--seconds and --leapfrog take a number for each refinement");
  return a;
}

void measure(const Arguments& a) {
  const cases::GarmentPair pair = cases::read_pair(a.files[0], a.files[1], a.threads);
  const std::string name = std::filesystem::path(a.files[0]).stem().string();
  std::printf(
      "garment,vertices,scheme,dt_s,seconds,cpu_per_second,times_cheaper,iterations_a_step,"
      "factorisations_a_step,open_steps,rms_to_leapfrog_mm,median_mm,way_rms_mm,way_median_mm,"
      "kinetic_mJ,deepest_in_gap_mm,lost_to_steps_mJ");
  for (std::size_t i = 0; i < physics::work_parts; ++i)
    std::printf(",%s", physics::name_of(physics::WorkPart(i)));
  std::printf("\n");
  for (std::size_t i = 0; i < a.refinements.size(); ++i) {
    const Garment garment = at_rest(pair, name, int(a.refinements[i]), a);
    const Scheme reference{"leapfrog", Integrator::leapfrog, 0};
    const Run leapfrog = run(garment, pair.field, reference, a.leapfrog[i], a.threads);
    print(garment, pair.field, reference, leapfrog, leapfrog);
    std::vector<Scheme> schemes{{"implicit", Integrator::implicit, 1.0 / 60},
                                {"tr-bdf2", Integrator::tr_bdf2, 1.0 / 60}};
    if (a.self)
      schemes.insert(schemes.begin() + 1, {"implicit, self-contact", Integrator::implicit, 1.0 / 60, true});
    for (const Scheme& scheme : schemes)
      if (a.schemes.find(scheme.name.substr(0, scheme.name.find(','))) != std::string::npos)
        print(garment, pair.field, scheme, run(garment, pair.field, scheme, a.seconds[i], a.threads),
              leapfrog);
  }
}

}  // namespace
}  // namespace furrow::bench

int main(int count, char** words) {
  try {
    furrow::bench::measure(furrow::bench::arguments_of(count, words));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 2;
  }
}
