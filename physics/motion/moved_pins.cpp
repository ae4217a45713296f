// SPDX-License-Identifier: MIT
#include "physics/motion/moved_pins.h"

#include <stdexcept>
#include <string>

namespace furrow::physics {
std::vector<Vec3> homes_of(std::span<const MovedPins> pins, const Particles& particles, double time) {
  std::vector<Vec3> homes;
  std::vector<char> taken(particles.size());
  for (const MovedPins& group : pins) {
    check(group.motion);
    const Pose now = pose(group.motion, time);
    for (const int i : group.particles) {
      const std::string name = "moved pins: particle " + std::to_string(i);
      if (i < 0 || std::size_t(i) >= particles.size()) {
        throw std::invalid_argument(name + " is not among " + std::to_string(particles.size()));
      }
      if (particles.inv_mass[std::size_t(i)] != 0) throw std::invalid_argument(name + " is not pinned");
      if (taken[std::size_t(i)]++) throw std::invalid_argument(name + " is named twice");
      homes.push_back(now.to_body(particles.x[std::size_t(i)]));
    }
  }
  return homes;
}

void PinLeader::attach(const PackedCloth& packed) {
  std::vector<int> place(packed.particle.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[std::size_t(packed.particle[i])] = int(i);
  places_.clear();
  for (const MovedPins& group : pins_)
    for (const int i : group.particles) places_.push_back(place[std::size_t(i)]);
}

void PinLeader::begin_step(PackedCloth& packed, double to, double dt) {
  targets_.resize(homes_.size());
  std::size_t next = 0;
  for (const MovedPins& group : pins_) {
    const Pose at_end = pose(group.motion, to);
    for (std::size_t k = 0; k < group.particles.size(); ++k, ++next) {
      const Vec3 target = at_end.to_world(homes_[next]);
      const Vec4& x = packed.x[std::size_t(places_[next])];
      const Vec3 v = (target - Vec3(x.x, x.y, x.z)) / dt;
      packed.v[std::size_t(places_[next])] = {v.x(), v.y(), v.z(), 0};
      targets_[next] = target;
    }
  }
}

std::vector<Vec3> PinLeader::velocities(double time, double over) const {
  std::vector<Vec3> velocities;
  for (const MovedPins& group : pins_) {
    const Pose sooner = pose(group.motion, time - over), later = pose(group.motion, time + over);
    for (std::size_t k = 0; k < group.particles.size(); ++k) {
      const Vec3& home = homes_[velocities.size()];
      velocities.push_back((later.to_world(home) - sooner.to_world(home)) / (2 * over));
    }
  }
  return velocities;
}

void PinLeader::arrive(PackedCloth& packed) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    packed.x[std::size_t(places_[i])] = {targets_[i].x(), targets_[i].y(), targets_[i].z(), 0};
  }
}

void PinLeader::unpack(const PackedCloth& packed, Particles& particles) const {
  if (targets_.empty()) return;  // no step yet
  for (const int place : places_) {
    const Vec4 &x = packed.x[std::size_t(place)], &v = packed.v[std::size_t(place)];
    const auto to = std::size_t(packed.particle[std::size_t(place)]);
    particles.x[to] = Vec3(x.x, x.y, x.z);
    particles.v[to] = Vec3(v.x, v.y, v.z);
  }
}

}  // namespace furrow::physics
