// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/hand_on_cloth.h"

#include <algorithm>
#include <vector>

namespace furrow::jobs {
namespace {

using physics::Vec3;

constexpr double hold_radius = 0.03, weight_at = 0.05;  // [m]
constexpr double usual_gravity = 9.81;                  // [m/s^2]

Vec3 vector_of(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

/// Of all that moves [N]; pins bear themselves.
double weight_of(const physics::Particles& particles) {
  double mass = 0;
  for (const double inverse : particles.inv_mass)
    if (inverse > 0) mass += 1 / inverse;
  return usual_gravity * mass;
}

}  // namespace

/// E = 1/2 k sum |x_i - (h + d_i)|^2 , h where the hand is, d_i where particle i lay from the vertex.
class HandOnCloth::Tether : public physics::Energy {
 public:
  Tether(const physics::Particles& particles, const Grip& grip)
      : vertex_(grip.vertex), to_(vector_of(grip.to)) {
    const Vec3 centre = particles.x.at(std::size_t(grip.vertex));
    for (std::size_t i = 0; i < particles.size(); ++i)
      if ((particles.x[i] - centre).norm() <= hold_radius) held_.push_back({int(i), particles.x[i] - centre});
    stiffness_ = weight_of(particles) / weight_at / double(held_.size());
  }
  int vertex() const { return vertex_; }
  void follow(const Grip& grip) { to_ = vector_of(grip.to); }

  double energy(std::span<const Vec3> x) const override {
    double sum = 0;
    for (const Held& h : held_)
      sum += 0.5 * stiffness_ * (x[std::size_t(h.i)] - to_ - h.beside).squaredNorm();
    return sum;
  }
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override {
    for (const Held& h : held_)
      force[std::size_t(h.i)] -= stiffness_ * (x[std::size_t(h.i)] - to_ - h.beside);
  }
  bool add_stiffness(std::span<const Vec3>, physics::Stiffness,
                     const physics::BlockSink& sink) const override {
    const physics::Mat3 block = stiffness_ * physics::Mat3::Identity();
    for (const Held& h : held_) sink(h.i, h.i, block);
    return true;
  }

 private:
  struct Held {
    int i;
    Vec3 beside;  ///< d_i
  };
  int vertex_;
  Vec3 to_;
  std::vector<Held> held_;
  double stiffness_ = 0;  ///< k [N/m]
};

HandOnCloth::HandOnCloth(const Hand& hand, physics::Cloth& cloth) : hand_(hand), cloth_(cloth) {}
HandOnCloth::~HandOnCloth() = default;

bool HandOnCloth::asks_for_renewal(double time) {
  if (!hand_) return false;
  wanted_ = hand_(time);
  const int vertices = int(cloth_.particles.size());
  if (wanted_ && (wanted_->vertex < 0 || wanted_->vertex >= vertices)) wanted_.reset();
  const bool same = wanted_ ? tether_ && tether_->vertex() == wanted_->vertex : !tether_;
  if (same && tether_) tether_->follow(*wanted_);
  return !same;
}

bool HandOnCloth::renew() {
  const bool same = wanted_ ? tether_ && tether_->vertex() == wanted_->vertex : !tether_;
  if (same) return false;
  std::erase(cloth_.energies, tether_);
  tether_.reset();
  if (wanted_) {
    tether_ = std::make_shared<Tether>(cloth_.particles, *wanted_);
    cloth_.energies.push_back(tether_);
  }
  return true;
}

}  // namespace furrow::jobs
