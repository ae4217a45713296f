// SPDX-License-Identifier: MIT
#include "physics/plate/plate_forces.h"

#include <algorithm>

#include "physics/cloth/dihedral_lanes.h"

namespace furrow::physics {
namespace {

using FourHinges = PlateLayout::FourHinges;
using Answer = PlateLayout::Answer;

/// Bends, and of each hinge the gradients at both tips with the feet in their last lanes.
FURROW_VECTOR_CLONES
void bend_hinges(const FourHinges* hinges, const Vec4* x, double* bend, Vec4* tips, int n) {
  for (int i = 0; i < n; ++i) {
    FourBends b;
    bends_of(hinges[i].vertex, x, b);
    Lanes phi;
    bend_of(b.angle, at(hinges[i].rest_angle), phi);
    *(UnalignedLanes*)(bend + 4 * i) = phi;
    for (int j = 0; j < 4; ++j) {
      *(Lanes*)(tips + 8 * i + 2 * j) = Lanes{b.tip_a.x[j], b.tip_a.y[j], b.tip_a.z[j], b.foot_a[j]};
      *(Lanes*)(tips + 8 * i + 2 * j + 1) = Lanes{b.tip_b.x[j], b.tip_b.y[j], b.tip_b.z[j], b.foot_b[j]};
    }
  }
}

/// moment[h] += share . (A D) (sum of share times bend); returns the energy.
FURROW_VECTOR_CLONES
double answer_curvatures(const Answer* answers, const int* begin, const int* hinge, const Vec4* share,
                         const double* bend, double* moment, int triangles) {
  double energy = 0;
  for (int t = 0; t < triangles; ++t) {
    Lanes k{};
    for (int e = begin[t]; e < begin[t + 1]; ++e) k += *(const Lanes*)(share + e) * bend[hinge[e]];
    k -= *(const Lanes*)&answers[t].at_rest;
    const Vec4* const column = answers[t].column;
    const Lanes s = (*(const Lanes*)(column)*k[0] + *(const Lanes*)(column + 1) * k[1]) +
                    *(const Lanes*)(column + 2) * k[2];
    energy += 0.5 * ((k[0] * s[0] + k[1] * s[1]) + k[2] * s[2]);
    for (int e = begin[t]; e < begin[t + 1]; ++e) {
      const Lanes p = *(const Lanes*)(share + e) * s;
      moment[hinge[e]] += (p[0] + p[1]) + p[2];
    }
  }
  return energy;
}

/// Each hinge's moment pushes its tips; the edge's ends balance them.
FURROW_VECTOR_CLONES
void push_particles(const FourHinges* hinges, const double* moment, const Vec4* tips, Vec4* force, int n) {
  for (int h = 0; h < n; ++h) {
    const int i = h / 4, j = h % 4;
    Lanes a = *(const Lanes*)(tips + 2 * h), b = *(const Lanes*)(tips + 2 * h + 1);
    const double foot_a = a[3], foot_b = b[3], m = moment[h];
    a *= m, b *= m;
    *(Lanes*)(force + hinges[i].vertex[0][j]) -= (foot_a - 1) * a - foot_b * b;
    *(Lanes*)(force + hinges[i].vertex[1][j]) -= (foot_b - 1) * b - foot_a * a;
    *(Lanes*)(force + hinges[i].vertex[2][j]) -= a;
    *(Lanes*)(force + hinges[i].vertex[3][j]) -= b;
  }
}

/// What one thread's passes need; kept, so that they allocate nothing.
struct Scratch {
  std::vector<Vec4> x, force, tips;
  std::vector<double> bend, moment;
};

}  // namespace

PlateLayout::PlateLayout(const Plate& plate) : begin_(plate.begin), hinge_(plate.hinge) {
  const int n = int(plate.hinges.size());
  for (int h = 0; h < n; h += 4) {
    FourHinges& four = hinges_.emplace_back();
    for (int j = 0; j < 4; ++j) {
      const Hinge& own = plate.hinges[std::size_t(std::min(h + j, n - 1))];
      four.rest_angle[j] = own.rest_angle;
      for (int k = 0; k < 4; ++k) four.vertex[k][j] = own.vertices[std::size_t(k)];
    }
  }
  for (const Eigen::Vector3d& s : plate.share) share_.push_back({s.x(), s.y(), s.z(), 0});
  for (const Eigen::Matrix3d& d : plate.stiffness) {
    Answer& answer = answers_.emplace_back();
    for (int c = 0; c < 3; ++c) answer.column[c] = {d(0, c), d(1, c), d(2, c), 0};
  }
  put_at_rest(plate);
}

void PlateLayout::put_at_rest(const Plate& plate) {
  for (std::size_t t = 0; t < plate.at_rest.size(); ++t) {
    const Eigen::Vector3d& k = plate.at_rest[t];
    answers_[t].at_rest = {k.x(), k.y(), k.z(), 0};
  }
}

double PlateLayout::add_forces(std::span<const Vec3> x, std::span<Vec3> force) const {
  thread_local Scratch s;
  const std::size_t fours = hinges_.size();
  s.x.resize(x.size()), s.bend.resize(4 * fours), s.tips.resize(8 * fours);
  s.moment.assign(4 * fours, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) s.x[i] = {x[i].x(), x[i].y(), x[i].z(), 0};
  bend_hinges(hinges_.data(), s.x.data(), s.bend.data(), s.tips.data(), int(fours));
  const double energy = answer_curvatures(answers_.data(), begin_.data(), hinge_.data(), share_.data(),
                                          s.bend.data(), s.moment.data(), int(answers_.size()));
  if (force.empty()) return energy;
  s.force.assign(x.size(), Vec4{});
  // Copies of the last hinge have no moment.
  push_particles(hinges_.data(), s.moment.data(), s.tips.data(), s.force.data(), int(4 * fours));
  for (std::size_t i = 0; i < x.size(); ++i) force[i] += Vec3(s.force[i].x, s.force[i].y, s.force[i].z);
  return energy;
}

}  // namespace furrow::physics
