// SPDX-License-Identifier: MIT
#include "physics/rest/prestress.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <memory>

#include "physics/base/require.h"
#include "physics/cloth/carried_angle.h"
#include "physics/cloth/check_cloth.h"
#include "physics/cloth/dihedral.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/kinds.h"
#include "physics/contact/residual_force.h"
#include "physics/plate/plate_bending.h"
#include "physics/plate/recouple.h"
#include "physics/rest/balance_forces.h"
#include "physics/rest/invert_elements.h"
#include "physics/rest/rigid_imbalance.h"
#include "physics/rest/stiffness_work.h"

namespace furrow::physics {
namespace {

constexpr double least_imbalance = 1e-9;  // of gravity
constexpr int most_plate_rounds = 6;      // of a cloth with plates

using Forces = std::vector<Vec3>;

/// The kinds of invert_elements.h.
template <class Element>
constexpr bool is_inverted = std::same_as<Element, Spring> || std::same_as<Element, MembraneTriangle> ||
                             std::same_as<Element, Tension> || std::same_as<Element, Hinge>;

void check(const Cloth& cloth, const PrestressOptions& o, std::span<const Vec3> loads) {
  constexpr const char* me = "prestress";
  if (!o.gravity.allFinite()) refuse(me, "gravity is not finite");
  require(me, "friction", o.friction, o.friction >= 0, ">= 0");
  require(me, "gap", o.gap, o.gap > 0, "> 0");
  require(me, "max_strain", o.max_strain, o.max_strain > 0 && o.max_strain <= 0.15, "in (0, 0.15]");
  require(me, "max_compression", o.max_compression, o.max_compression >= 0 && o.max_compression <= 0.15,
          "in [0, 0.15]");
  require(me, "max_angle", o.max_angle, o.max_angle > 0 && o.max_angle <= 3, "in (0, 3]");
  require(me, "tolerance", o.tolerance, o.tolerance > 0, "> 0");
  require(me, "max_iterations", o.max_iterations, o.max_iterations >= 1, ">= 1");
  check_cloth(cloth, me);
  check_loads(cloth, loads, me);
  for_each_kind(cloth, [&](const auto& kind, auto...) {
    if (!is_inverted<KindOf<decltype(kind)>> && !kind.empty())
      refuse(me, "the cloth has elements of a kind whose rest state cannot be solved for");
  });
  for (const auto& energy : cloth.energies)
    if (!dynamic_cast<const PlateBending*>(energy.get()))
      refuse(me, "energies of a caller's own have no rest state to change; give their forces as loads");
}

std::vector<ContactPoint> contacts_of(const Particles& p, const Collider* collider, double gap) {
  std::vector<ContactPoint> contacts;
  for (std::size_t i = 0; collider && i < p.size(); ++i) {
    if (!(p.inv_mass[i] > 0)) continue;
    const SignedDistance field = collider->smooth_at(p.x[i]);
    if (field.value <= gap + contact_tolerance && field.gradient.norm() > 0)
      contacts.push_back({int(i), field.gradient.normalized()});
  }
  return contacts;
}

/// Pieces that the load moves, with a contact or without one.
std::vector<RigidImbalance> moved(const Cloth& cloth, const Forces& load,
                                  std::span<const ContactPoint> contacts, bool touching, double g) {
  std::vector<RigidImbalance> pieces = rigid_imbalances(cloth, load);
  std::vector<char> touches(cloth.particles.size());
  for (const ContactPoint& c : contacts) touches[c.particle] = 1;
  std::erase_if(pieces, [&](const RigidImbalance& r) {
    const bool any = std::any_of(r.piece.begin(), r.piece.end(), [&](int i) { return touches[i]; });
    return any != touching || !(r.largest > least_imbalance * g);
  });
  return pieces;
}

void invert_springs(const Particles& p, std::span<const double> tension, std::vector<Spring>& springs,
                    PrestressReport& report) {
  for (std::size_t i = 0; i < springs.size(); ++i) {
    Spring& s = springs[i];
    const double l = (p.x[s.b] - p.x[s.a]).norm();
    s.rest_length = rest_length_for(l, s.stiffness, tension[i]).value();  // the bounds see to it
    report.max_strain = std::max(report.max_strain, std::abs(l - s.rest_length) / s.rest_length);
  }
}

void invert_tension(const Particles& p, std::span<const double> pull, std::vector<Tension>& tension,
                    PrestressReport& report) {
  for (std::size_t i = 0; i < tension.size(); ++i) {
    Tension& t = tension[i];
    const double l = (p.x[t.b] - p.x[t.a]).norm();
    t.rest_length = rest_length_for(t, l, pull[i]).value();  // the bounds see to it
    report.max_strain = std::max(report.max_strain, std::abs(l - t.rest_length) / t.rest_length);
  }
}

/// Whether the law has an answer.
bool invert_triangle(const std::array<Vec3, 3>& x, const Eigen::Vector3d& tension, MembraneTriangle& t) {
  if (!t.threads.any()) {
    const auto lengths = rest_lengths_for(x, t.lambda, t.mu, tension);
    if (lengths) t.rest_lengths = *lengths;
    return lengths.has_value();
  }
  const std::array<double, 3> lying{(x[2] - x[1]).norm(), (x[0] - x[2]).norm(), (x[1] - x[0]).norm()};
  const auto rest = rest_of_woven(x, t, carried_angle(t.threads.angle, t.rest_lengths, lying), tension);
  if (rest) t.rest_lengths = rest->lengths, t.threads.angle = rest->angle;
  return rest.has_value();
}

void invert_triangles(const Particles& p, const ClampedForces& f, std::vector<MembraneTriangle>& triangles,
                      PrestressReport& report) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    MembraneTriangle& t = triangles[i];
    const std::array<Vec3, 3> x{p.x[t.vertices[0]], p.x[t.vertices[1]], p.x[t.vertices[2]]};
    // The law has an answer to all that the bounds allow, unless Poisson's ratio is near 1; then to less.
    for (Eigen::Vector3d tension = f.membrane[i]; !invert_triangle(x, tension, t);) tension *= 0.8;
    for (int e = 0; e < 3; ++e) {
      const double l = (x[(e + 2) % 3] - x[(e + 1) % 3]).norm(), rest = t.rest_lengths[e];
      report.max_strain = std::max(report.max_strain, std::abs(l - rest) / rest);
    }
  }
}

void invert_hinges(const ClampedForces& f, Cloth& cloth, PrestressReport& report) {
  const std::vector<Vec3>& x = cloth.particles.x;
  for (std::size_t i = 0; i < cloth.hinges.size(); ++i) {
    Hinge& h = cloth.hinges[i];
    const auto& v = h.vertices;
    const double theta = dihedral_angle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
    h.rest_angle = rest_angle_for(cloth.hinge_law, h.stiffness, theta, f.hinges[i]).value();
    report.max_angle = std::max(report.max_angle, std::abs(bend(theta, h.rest_angle)));
  }
}

/// Plates are solved for without a bound: one that bends farther is cut, and what is then out of balance is
/// the residual.
void invert_plates(const ClampedForces& f, double most, Cloth& cloth, PrestressReport& report) {
  const std::vector<Vec3>& x = cloth.particles.x;
  int place = 0;
  for (std::size_t i = 0; i < cloth.energies.size(); ++i) {
    const auto& own = dynamic_cast<const PlateBending&>(*cloth.energies[i]);
    Plate plate = own.plate();
    plate.at_rest.clear();
    for (std::size_t h = 0; h < plate.hinges.size(); ++h, ++place) {
      const auto& v = plate.hinges[h].vertices;
      const double by = std::clamp(f.coupled[i][h], -most, most);
      if (by != f.coupled[i][h]) report.coupled.push_back(place);
      plate.hinges[h].rest_angle = bend(dihedral_angle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]), by);
      report.max_angle = std::max(report.max_angle, std::abs(by));
    }
    cloth.energies[i] = std::make_shared<PlateBending>(std::move(plate), own, own.origin());
  }
}

void invert(const ClampedForces& f, Cloth& cloth, PrestressReport& report) {
  invert_springs(cloth.particles, f.structural, cloth.structural, report);
  invert_springs(cloth.particles, f.bending, cloth.bending, report);
  invert_tension(cloth.particles, f.tension, cloth.tension, report);
  invert_triangles(cloth.particles, f, cloth.membrane, report);
  invert_hinges(f, cloth, report);
  std::size_t place = 0;
  const auto list = [&](std::size_t n, std::vector<int>& active) {
    for (std::size_t i = 0; i < n; ++i) {
      if (f.scale[place++] < 1) active.push_back(int(i));
    }
  };
  list(cloth.structural.size(), report.structural);
  list(cloth.bending.size(), report.bending);
  list(cloth.tension.size(), report.tension);
  list(cloth.membrane.size(), report.membrane);
  list(cloth.hinges.size(), report.hinges);
}

/// What a solve came to.
struct Solved {
  PrestressReport report;
  Forces way;                 ///< of the balance, where the next one begins [m]
  bool free_factors = false;  ///< of Balance
};

/// One solve, with the plates as they are. before: of a problem that hardly differs, or empty.
Solved balance_once(Cloth& cloth, const PrestressOptions& o, const Collider* collider,
                    std::span<const Vec3> loads, const Solved& before) {
  const Particles& p = cloth.particles;
  const double g = o.gravity.norm() > 0 ? o.gravity.norm() : standard_gravity;
  const std::vector<ContactPoint> contacts = contacts_of(p, collider, o.gap);
  const FreeStiffness* const matrix = o.work->stiffness.get();
  ClampedElements system(cloth,
                         {o.max_strain, std::min(o.max_compression, o.max_strain), o.max_angle, o.friction},
                         contacts, o.work);
  Forces load(p.size(), Vec3::Zero());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!(p.inv_mass[i] > 0)) continue;
    load[i] = o.gravity / p.inv_mass[i];
    if (!loads.empty()) load[i] += loads[i];
  }
  PrestressReport report;
  report.imbalance = moved(cloth, load, contacts, false, g);
  for (const RigidImbalance& r : report.imbalance) remove_rigid_load(cloth, r, load);
  const bool serve = before.free_factors && o.work->stiffness.get() == matrix;
  Balance balance = balance_forces(p, system, load, {g, o.tolerance, o.max_iterations, serve}, before.way);
  report.iterations = balance.iterations;
  report.factorisations = balance.factorisations;
  if (!contacts.empty()) {
    for (RigidImbalance& r : moved(cloth, balance.net, contacts, true, g))
      report.imbalance.push_back(std::move(r));
  }
  invert(balance.forces, cloth, report);
  invert_plates(balance.forces, o.max_angle, cloth, report);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    report.touching.push_back(contacts[i].particle);
    report.contact_force.push_back(balance.forces.contact[i]);
  }
  report.residual = residual_force(cloth, o.gravity, collider, o.friction, o.gap, loads);
  return {std::move(report), std::move(balance.way), balance.free_factors};
}

}  // namespace

PrestressReport prestress(Cloth& cloth, const PrestressOptions& options, const Collider* collider,
                          std::span<const Vec3> loads) {
  check(cloth, options, loads);
  StiffnessWork own;
  PrestressOptions o = options;
  if (!o.work) o.work = &own;
  Cloth work = cloth;
  Solved last = balance_once(work, o, collider, loads, {});
  PrestressReport& report = last.report;
  for (int round = 1; recouple(work); ++round) {  // a plate is made of the rest lengths that were solved for
    const double left = residual_force(work, o.gravity, collider, o.friction, o.gap, loads);
    if (left <= std::max(o.tolerance, 1.1 * report.residual) || round == most_plate_rounds) {
      report.residual = left;
      break;
    }
    Solved next = balance_once(work, o, collider, loads, last);
    next.report.iterations += report.iterations;
    next.report.factorisations += report.factorisations;
    last = std::move(next);
  }
  cloth = std::move(work);
  return std::move(last.report);
}

}  // namespace furrow::physics
