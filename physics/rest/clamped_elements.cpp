// SPDX-License-Identifier: MIT
#include "physics/rest/clamped_elements.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "physics/base/require.h"
#include "physics/cloth/carried_angle.h"
#include "physics/cloth/dihedral.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/tension_forces.h"

namespace furrow::physics {
namespace {

constexpr double body_stiffness = 10;   // over the mean diagonal
constexpr double largest_shift = 1e20;  // 1/s^2

/// The same plate, at rest as it lies.
std::shared_ptr<const Energy> flat_to_itself(const Energy* energy, std::span<const Vec3> x) {
  const auto* own = dynamic_cast<const PlateBending*>(energy);
  if (!own)
    refuse("prestress",
           "energies of a caller's own have no rest state to change; give their forces as loads");
  Plate plate = own->plate();
  plate.at_rest.clear();
  for (Hinge& h : plate.hinges) {
    const auto& v = h.vertices;
    h.rest_angle = dihedral_angle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
  }
  return std::make_shared<PlateBending>(std::move(plate), *own, own->origin());
}

/// The cloth with its rest state as it lies; tension becomes linear.
Cloth at_rest(Cloth cloth) {
  const std::vector<Vec3>& x = cloth.particles.x;
  for (Tension t : cloth.tension) {
    t.rest_length = (x[t.b] - x[t.a]).norm();
    cloth.bending.push_back({t.a, t.b, t.rest_length, tension_slope(t, working_strain)});
  }
  cloth.tension.clear();
  for (auto* springs : {&cloth.structural, &cloth.bending})
    for (Spring& s : *springs) s.rest_length = (x[s.b] - x[s.a]).norm();
  for (MembraneTriangle& t : cloth.membrane) {
    const std::array<double, 3> before = t.rest_lengths;
    for (int i = 0; i < 3; ++i)
      t.rest_lengths[i] = (x[t.vertices[(i + 2) % 3]] - x[t.vertices[(i + 1) % 3]]).norm();
    if (t.threads.any()) t.threads.angle = carried_angle(t.threads.angle, before, t.rest_lengths);
  }
  for (Hinge& h : cloth.hinges) {
    const auto& v = h.vertices;
    h.rest_angle = dihedral_angle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
  }
  for (auto& energy : cloth.energies) energy = flat_to_itself(energy.get(), x);
  cloth.hinge_law = HingeLaw::linear;
  return cloth;
}

/// Young's modulus times thickness of the softest strip that can be cut from the triangle's cloth [N/m].
double least_modulus(const MembraneTriangle& t) {
  if (!(t.mu > 0)) return 0;
  const double plane = t.lambda + 2 * t.mu;
  if (!t.threads.any()) return 4 * t.mu * (t.lambda + t.mu) / plane;
  // 1 / Y = (1 - s)^2 a + s^2 b + s (1 - s) c,  s = sin^2 of the angle to the warp: greatest at an end or
  // where its derivative is 0.
  const double c11 = plane + t.threads.warp, c22 = plane + t.threads.weft,
               q = c11 * c22 - t.lambda * t.lambda;
  if (!(q > 0)) return 0;
  const double a = c22 / q, b = c11 / q, c = 1 / t.mu - 2 * t.lambda / q, bend = a + b - c;
  double compliance = std::max(a, b);
  if (const double s = (2 * a - c) / (2 * bend); bend < 0 && s > 0 && s < 1)
    compliance = std::max(compliance, (1 - s) * (1 - s) * a + s * s * b + s * (1 - s) * c);
  return 1 / compliance;
}

struct Clamped {
  double force, potential, scale;
};
/// A spring of stiffness k by q whose force stays within [low, high]; beyond, its energy goes on as a line.
Clamped clamped(double k, double q, double low, double high) {
  const double force = k * q;
  if (force <= high && force >= low) return {force, 0.5 * force * q, 1};
  const double limit = force > high ? high : low;
  return {limit, limit * q - 0.5 * limit * limit / k, 0};
}

/// The point of Coulomb's cone about n next to p.
Vec3 onto_cone(const Vec3& p, const Vec3& n, double friction) {
  const double normal = p.dot(n);
  const Vec3 side = p - normal * n;
  const double slip = side.norm();
  if (slip <= friction * normal) return p;
  if (normal <= -friction * slip) return Vec3::Zero();
  const double along = (normal + friction * slip) / (1 + friction * friction);
  return slip > 0 ? Vec3(along * (n + friction / slip * side)) : Vec3(along * n);
}

}  // namespace

ClampedElements::ClampedElements(const Cloth& cloth, const ElementLimits& limits,
                                 std::span<const ContactPoint> contacts, StiffnessWork* work)
    : rest_(at_rest(cloth)),
      now_(rest_),
      contacts_(contacts.begin(), contacts.end()),
      friction_(limits.friction),
      stiffness_(stiffness_for(rest_, false, work)) {
  add_bars(rest_.structural, limits);
  add_bars(std::span(rest_.bending).first(cloth.bending.size()), limits);
  tension_begin_ = bars_.size();
  add_tension(cloth, limits);
  add_plates(rest_, limits.strain);
  add_bends(cloth, limits.angle);
  add_coupled();
  if (contacts_.empty()) return;
  stiffness_->assemble(rest_, rest_.particles.x, Stiffness::positive_part);
  contact_stiffness_ = body_stiffness * stiffness_->mean_diagonal();
  if (!(contact_stiffness_ > 0)) contact_stiffness_ = 1;  // a cloth without stiffness
}

void ClampedElements::add_bars(std::span<const Spring> springs, const ElementLimits& limits) {
  for (const Spring& s : springs) {
    const double k = s.stiffness, l = s.rest_length;
    const Vec3 d = rest_.particles.x[s.b] - rest_.particles.x[s.a];
    if (!(l > 0)) refuse("prestress", "a spring has no length");
    bars_.push_back({s.a, s.b, d / l, k, -k * l * limits.compression / (1 - limits.compression),
                     k * l * limits.strain / (1 + limits.strain)});
  }
}

/// A law that cannot push has its lower limit at 0.
void ClampedElements::add_tension(const Cloth& cloth, const ElementLimits& limits) {
  for (std::size_t i = 0; i < cloth.tension.size(); ++i) {
    const Tension& t = cloth.tension[i];
    const Spring& s = rest_.bending[cloth.bending.size() + i];
    if (!(s.rest_length > 0)) refuse("prestress", "a tension has no length");
    bars_.push_back({s.a, s.b, (rest_.particles.x[s.b] - rest_.particles.x[s.a]) / s.rest_length, s.stiffness,
                     tension_law(t, -limits.compression).force, tension_law(t, limits.strain).force});
  }
}

void ClampedElements::add_plates(const Cloth& cloth, double strain) {
  for (const MembraneTriangle& t : cloth.membrane) {
    if (!(t.mu > 0) && (t.lambda != 0 || t.threads.any()))
      refuse("prestress", "a membrane triangle has lambda = ", std::to_string(t.lambda), " but mu = 0");
    Plate p{t.vertices, {}, {}, 0};
    const MembraneConstants constants = membrane_constants(t);
    p.quadratic = constants.quadratic;
    p.reach = strain * std::sqrt(constants.area * least_modulus(t));
    for (int i = 0; i < 3; ++i)
      p.edge[i] = cloth.particles.x[t.vertices[(i + 2) % 3]] - cloth.particles.x[t.vertices[(i + 1) % 3]];
    plates_.push_back(p);
  }
}

void ClampedElements::add_bends(const Cloth& cloth, double angle) {
  const auto& x = cloth.particles.x;
  for (const Hinge& h : cloth.hinges) {
    const auto& v = h.vertices;
    const Dihedral d = dihedral(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
    const double high = hinge_moment(cloth.hinge_law, h.stiffness, angle).moment;
    bends_.push_back({v, d.gradient, h.stiffness, high});
  }
}

void ClampedElements::add_coupled() {
  const auto& x = rest_.particles.x;
  for (const auto& energy : rest_.energies) {
    Coupled coupled{static_cast<const PlateBending*>(energy.get()), {}};
    for (const Hinge& h : coupled.plate->plate().hinges) {
      const auto& v = h.vertices;
      coupled.gradient.push_back(dihedral(x[v[0]], x[v[1]], x[v[2]], x[v[3]]).gradient);
    }
    coupled_.push_back(std::move(coupled));
  }
}

void ClampedElements::respond_bars(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const {
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const Bar& b = bars_[i];
    const Clamped c = clamped(b.stiffness, b.direction.dot(w[b.b] - w[b.a]), b.low, b.high);
    (i < rest_.structural.size() ? f.structural
     : i < tension_begin_        ? f.bending
                                 : f.tension)
        .push_back(c.force);
    f.potential += c.potential;
    f.scale.push_back(c.scale);
    force[b.a] += c.force * b.direction;
    force[b.b] -= c.force * b.direction;
  }
}

void ClampedElements::respond_plates(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const {
  for (const Plate& p : plates_) {
    Eigen::Vector3d d;
    for (int i = 0; i < 3; ++i)
      d[i] = 2 * p.edge[i].dot(w[p.vertices[(i + 2) % 3]] - w[p.vertices[(i + 1) % 3]]);
    Eigen::Vector3d tension = p.quadratic * d;
    const double size = std::sqrt(std::max(0.0, d.dot(tension)));
    const double scale = size > p.reach ? p.reach / size : 1;
    tension *= scale;
    f.potential += scale < 1 ? p.reach * (size - 0.5 * p.reach) : 0.5 * size * size;
    f.scale.push_back(scale);
    f.membrane.push_back(tension);
    for (int i = 0; i < 3; ++i) {
      const Vec3 pull = 2 * tension[i] * p.edge[i];
      force[p.vertices[(i + 1) % 3]] += pull;
      force[p.vertices[(i + 2) % 3]] -= pull;
    }
  }
}

void ClampedElements::respond_bends(std::span<const Vec3> w, std::span<Vec3> force, ClampedForces& f) const {
  for (const Bend& b : bends_) {
    double q = 0;
    for (int i = 0; i < 4; ++i) q += b.gradient[i].dot(w[b.vertices[i]]);
    const Clamped c = clamped(b.stiffness, q, -b.high, b.high);
    f.hinges.push_back(c.force);
    f.potential += c.potential;
    f.scale.push_back(c.scale);
    for (int i = 0; i < 4; ++i) force[b.vertices[i]] -= c.force * b.gradient[i];
  }
}

void ClampedElements::respond_coupled(std::span<const Vec3> w, std::span<Vec3> force,
                                      ClampedForces& f) const {
  for (const Coupled& c : coupled_) {
    const std::vector<Hinge>& hinges = c.plate->plate().hinges;
    std::vector<double> bends(hinges.size());
    for (std::size_t h = 0; h < hinges.size(); ++h)
      for (std::size_t i = 0; i < 4; ++i) bends[h] += c.gradient[h][i].dot(w[hinges[h].vertices[i]]);
    const std::vector<double> moment = c.plate->moments_of(bends, f.potential);
    for (std::size_t h = 0; h < hinges.size(); ++h)
      for (std::size_t i = 0; i < 4; ++i) force[hinges[h].vertices[i]] -= moment[h] * c.gradient[h][i];
    f.coupled.push_back(std::move(bends));
  }
}

void ClampedElements::respond_contacts(std::span<const Vec3> w, std::span<Vec3> force,
                                       ClampedForces& f) const {
  for (const ContactPoint& c : contacts_) {
    const Vec3 wanted = -contact_stiffness_ * w[c.particle], z = onto_cone(wanted, c.normal, friction_);
    f.contact.push_back(z);
    f.potential += 0.5 * z.squaredNorm() / contact_stiffness_;
    f.scale.push_back(z == wanted ? 1 : z.isZero(0) ? 0 : 0.5);
    force[c.particle] += z;
  }
}

ClampedForces ClampedElements::respond(std::span<const Vec3> w, std::span<Vec3> force) const {
  ClampedForces f;
  f.scale.reserve(bars_.size() + plates_.size() + bends_.size() + contacts_.size());
  respond_bars(w, force, f);
  respond_plates(w, force, f);
  respond_bends(w, force, f);
  respond_coupled(w, force, f);
  respond_contacts(w, force, f);
  return f;
}

/// The derivative of onto_cone() times the stiffness.
Mat3 ClampedElements::contact_stiffness(const ContactPoint& contact, const Vec3& w) const {
  const Vec3 p = -w, &n = contact.normal, z = onto_cone(p, n, friction_);
  if (z == p) return contact_stiffness_ * Mat3::Identity();
  if (z.isZero(0)) return Mat3::Zero();
  const Vec3 ray = z.normalized(), side = p - p.dot(n) * n;
  const double slip = side.norm();
  Mat3 k = ray * ray.transpose();
  if (slip > 0 && friction_ > 0) {
    const Vec3 t = side / slip;
    k += z.dot(t) / slip * (Mat3::Identity() - n * n.transpose() - t * t.transpose());
  }
  return contact_stiffness_ * k;
}

void ClampedElements::factorise(const ClampedForces& at, std::span<const Vec3> w, double shift) {
  std::size_t i = 0;
  for (auto [now, rest] : {std::pair{&now_.structural, &rest_.structural}, {&now_.bending, &rest_.bending}})
    for (std::size_t s = 0; s < now->size(); ++s) (*now)[s].stiffness = at.scale[i++] * (*rest)[s].stiffness;
  for (std::size_t t = 0; t < now_.membrane.size(); ++t, ++i) {
    const MembraneTriangle& rest = rest_.membrane[t];
    now_.membrane[t].lambda = at.scale[i] * rest.lambda;
    now_.membrane[t].mu = at.scale[i] * rest.mu;
    now_.membrane[t].threads.warp = at.scale[i] * rest.threads.warp;
    now_.membrane[t].threads.weft = at.scale[i] * rest.threads.weft;
  }
  for (std::size_t h = 0; h < now_.hinges.size(); ++h)
    now_.hinges[h].stiffness = at.scale[i++] * rest_.hinges[h].stiffness;
  stiffness_->assemble(now_, now_.particles.x, Stiffness::positive_part);
  for (const ContactPoint& c : contacts_) stiffness_->add(c.particle, contact_stiffness(c, w[c.particle]));
  for (double added = shift;; added *= 100) {
    const Particles& p = now_.particles;
    for (std::size_t v = 0; v < p.size(); ++v) {
      if (p.inv_mass[v] > 0) stiffness_->add(int(v), added / p.inv_mass[v] * Mat3::Identity());
    }
    if (stiffness_->factorise_definite()) return;
    if (!(added < largest_shift)) refuse("prestress", "a stiffness is not finite");
  }
}

}  // namespace furrow::physics
