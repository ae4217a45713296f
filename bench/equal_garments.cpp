// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the fast fit (physics/rest/settle.h) and leapfrog bring a garment to the same rest, without
// friction and with its top border loop held: a table (CSV).
//   equal_garments [OPTIONS] GARMENT BODY [GARMENT BODY …]
//     --refinements 1  of all garments (Loop)      --drag 12     of leapfrog [1/s]
//     --seconds 20     leapfrog's at most          --depth 1e-6  of the exact contact, see below [m]
//     --starts 2       starts of both, see below  --limit-steps 200  between two estimates of its limit
// Both begin where the last level of `furrow drape` begins. Of further starts the last is the garment as it
// lies in its file; those between are the first, disturbed once more. settle() runs to 1e-5 of a vertex's
// weight, leapfrog to 1e-2, or until it gets no nearer. `exact`: settle() with contact_depth, as
// `furrow drape --contact-depth`, since leapfrog's contact bears no depth.
//   U: of elements. E: U and weight, this from the height of the rest that is compared with, where so E is U.
// freed: E of the start less E of that rest. Distances are between the surfaces, both ways.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/refine/subdivide.h"
#include "physics/body/collider.h"
#include "physics/cloth/elements.h"
#include "physics/contact/residual_force.h"
#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "tests/cases/draped.h"
#include "tests/cases/garment_pair.h"

namespace furrow::bench {
namespace {

using physics::Cloth, physics::Vec3;

struct Arguments {
  std::map<std::string, double> options{{"--refinements", 1}, {"--drag", 12},  {"--seconds", 20},
                                        {"--depth", 1e-6},    {"--starts", 2}, {"--limit-steps", 200}};
  std::vector<std::string> files;
  double operator[](const char* name) const { return options.at(name); }
};

/// One garment on its body.
struct Scene {
  std::string name;
  const physics::Collider* body;
  double gap;            ///< [m]
  geometry::Mesh shape;  ///< for its faces
  const Arguments& arguments;
};

struct Rest {
  std::string name;
  Cloth cloth;
  double work = 0;  ///< iterations or seconds
};

double elastic_energy(const Cloth& cloth) { return potential_energy(cloth, cloth.particles.x); }
/// E of a less E of b.
double energy_over(const Cloth& a, const Cloth& b) {
  double e = elastic_energy(a) - elastic_energy(b);
  for (std::size_t i = 0; i < a.particles.size(); ++i)
    e += 9.81 * a.particles.mass[i] * (a.particles.x[i] - b.particles.x[i]).y();
  return e;
}

/// contact_depth: of settle().
Rest settled(const std::string& name, const Scene& scene, const Cloth& start,
             double contact_depth = physics::SettleOptions{}.contact_depth) {
  Rest rest{name, start};
  physics::SettleOptions o;
  o.friction = 0;
  o.gap = scene.gap;
  o.contact_depth = contact_depth;
  o.tolerance = 1e-5;
  o.max_iterations = 500;
  rest.work = physics::settle(rest.cloth, scene.body, o).iterations;
  return rest;
}

Rest exact(const std::string& name, const Scene& scene, const Cloth& start) {
  return settled(name, scene, start, scene.arguments["--depth"]);
}

/// Whether a motion must go on: until 1e-2, or until it gets no nearer.
struct Watch {
  const Scene& scene;
  const Cloth& cloth;
  std::vector<Vec3> before;
  double asked = 0, residual = 0;

  bool goes_on(double time) {
    if (time - asked < 0.1) return true;
    const double last = residual, way = cases::farthest(cloth.particles.x, before);
    asked = time;
    before = cloth.particles.x;
    residual = residual_force(cloth, physics::SettleOptions{}.gravity, scene.body, 0, scene.gap);
    return residual > 0.01 && (way > 1e-6 || residual < 0.95 * last);
  }
};

struct Diverged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Rest under leapfrog. Springs are damped in the first second alone: their damping acts on what the last
/// half-kick leaves in the velocities of pressed vertices. Hinges of narrow faces stiffen as cloth folds, so
/// the limit of the step is asked for often.
Rest moved(const std::string& name, const Scene& scene, const Cloth& start) {
  Rest rest{name, start};
  for (Vec3& v : rest.cloth.particles.v) v.setZero();
  physics::SimulateOptions o;
  o.friction = 0;
  o.contact_gap = scene.gap;
  o.air_drag = scene.arguments["--drag"];
  o.limit_steps = int(scene.arguments["--limit-steps"]);
  o.seconds = rest.work = 1;
  const auto must_stay = [&](const physics::SimulateReport& report) {
    if (report.outcome == physics::Outcome::diverged) throw Diverged(scene.name + ": leapfrog diverged");
  };
  must_stay(physics::simulate(rest.cloth, scene.body, o));
  o.spring_damping = 0;
  o.seconds = scene.arguments["--seconds"];
  Watch watch{scene, rest.cloth, rest.cloth.particles.x};
  const auto report =
      physics::simulate(rest.cloth, scene.body, o, [&](const auto& now) { return watch.goes_on(now.time); });
  rest.work += report.time;
  must_stay(report);
  return rest;
}

void print_row(const Scene& scene, int start_number, const Cloth& start, const Rest& a, const Rest& b) {
  const double u = elastic_energy(b.cloth), de = energy_over(a.cloth, b.cloth);
  const auto d = cases::surface_distances(scene.shape, a.cloth.particles.x, b.cloth.particles.x);
  const physics::Certificate c = physics::certify(a.cloth, {.friction = 0, .gap = scene.gap}, scene.body);
  const cases::Depth contact = cases::depth_of(a.cloth, *scene.body, scene.gap);
  std::printf("%s,%zu,%d,%s,%s,%.6g,%.6g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.2g,%d,%d,%.3g,%.3g,%.4g\n",
              scene.name.c_str(), a.cloth.particles.size(), start_number, a.name.c_str(), b.name.c_str(),
              1e3 * elastic_energy(a.cloth), 1e3 * u, 1e3 * de, 100 * de / u,
              100 * de / energy_over(start, b.cloth), 1e3 * d[d.size() / 2], 1e3 * d[d.size() * 95 / 100],
              1e3 * d.back(), c.residual, c.negative_eigenvalues, contact.particles, 1e3 * contact.mean,
              1e3 * contact.largest, a.work);
  std::fflush(stdout);
}

void disturb(Cloth& cloth, double by, unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto random = [&] { return double(engine() >> 11) * 0x1p-52 - 1; };
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const double a = random(), b = random(), c = random();
    if (cloth.particles.inv_mass[i] > 0) cloth.particles.x[i] += by * Vec3(a, b, c);
  }
}

std::vector<Cloth> starts_of(const Scene& scene, const cases::GarmentPair& pair,
                             const bridge::MakeCloth& make) {
  bridge::DrapeOptions o;
  o.refinements = int(scene.arguments["--refinements"]);
  o.settle.friction = 0;
  o.settle.gap = scene.gap;
  geometry::Mesh garment = pair.garment;
  Cloth cloth, first;
  const auto at_start = [&](int level, const physics::SettleProgress&, const Cloth& now) {
    if (level < o.refinements) return true;
    first = now;
    return false;
  };
  const double disturbance = bridge::drape(garment, cloth, scene.body, o, make, at_start).disturbance;
  std::vector<Cloth> starts(std::size_t(scene.arguments["--starts"]), first);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    geometry::Mesh made = scene.shape;
    if (i + 1 == starts.size()) starts[i] = make(made);
    disturb(starts[i], disturbance, unsigned(i) + 1);
    physics::bring_out(starts[i].particles, *scene.body, scene.gap);
  }
  return starts;
}

void compare(const Scene& scene, const std::vector<Cloth>& starts) {
  std::vector<Rest> fast, tight, leapfrog;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto row = [&](const Rest& a, const Rest& b) { print_row(scene, int(i), starts[i], a, b); };
    fast.push_back(settled("settle", scene, starts[i]));
    tight.push_back(exact("exact", scene, starts[i]));
    leapfrog.push_back(moved("leapfrog", scene, starts[i]));
    row(fast[i], leapfrog[i]);
    row(tight[i], leapfrog[i]);
    row(settled("settle from leapfrog", scene, leapfrog[i].cloth), leapfrog[i]);
    row(exact("exact from leapfrog", scene, leapfrog[i].cloth), leapfrog[i]);
    row(moved("leapfrog from settle", scene, fast[i].cloth), fast[i]);
    row(moved("leapfrog from exact", scene, tight[i].cloth), tight[i]);
    if (i == 0) continue;
    for (const auto& all : {fast, tight, leapfrog}) {
      Rest first = all[0];
      first.name += " from start 0";
      row(all[i], first);
    }
  }
}

Arguments arguments_of(int count, char** words) {
  Arguments a;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word.rfind("--", 0) == 0 && !a.options.count(word))
      throw std::invalid_argument("there is no option " + word);
    if (!a.options.count(word)) {
      a.files.push_back(word);
    } else if (++i == count || !((a.options[word] = std::atof(words[i])) >= 0)) {
      throw std::invalid_argument(word + " takes a number >= 0");
    }
  }
  if (a["--starts"] < 1) throw std::invalid_argument("--starts: at least 1");
  if (a.files.empty() || a.files.size() % 2) throw std::invalid_argument("name garments, each with its body");
  return a;
}

void run(const Arguments& a) {
  std::printf(
      "# Rests of settle() and of leapfrog: friction 0, top loop held, cotton, drag %g /s, exact: depth %g "
      "m; "
      "see bench/equal_garments.cpp. Columns from `residual` on tell of `rest`.\n",
      a["--drag"], a["--depth"]);
  std::printf(
      "garment,vertices,start,rest,compared with,U [mJ],U compared with [mJ],dE [mJ],dE/E [%%],dE/freed [%%],"
      "distance median [mm],distance p95 [mm],distance max [mm],residual [-],negative eigenvalues,"
      "in contact,mean depth [mm],deepest [mm],iterations or seconds\n");
  const int refinements = int(a["--refinements"]);
  for (std::size_t i = 0; i < a.files.size(); i += 2) {
    const std::filesystem::path file = a.files[i];
    const cases::GarmentPair pair = cases::read_pair(file, a.files[i + 1]);
    Scene scene{file.parent_path().filename().string() + " " + file.stem().string(), &pair.field,
                cases::gap_of(pair, refinements), pair.garment, a};
    geometry::loop_subdivide(scene.shape, refinements);
    const bridge::MakeCloth make = cases::make_cotton(pair, cases::vertex_at_top(pair.garment));
    try {
      compare(scene, starts_of(scene, pair, make));
    } catch (const Diverged& e) {  // it tells nothing of this garment
      std::printf("# %s\n", e.what());
      std::fprintf(stderr, "equal_garments: %s\n", e.what());
    }
  }
}

}  // namespace
}  // namespace furrow::bench

int main(int count, char** words) {
  try {
    furrow::bench::run(furrow::bench::arguments_of(count, words));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "equal_garments: %s\n", e.what());
    return 2;
  }
}
