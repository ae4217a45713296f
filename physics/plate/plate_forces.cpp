// SPDX-License-Identifier: MIT
#include "physics/plate/plate_forces.h"

#include <algorithm>
#include <numeric>

#include "physics/base/cancel_scope.h"
#include "physics/cloth/dihedral_lanes.h"

namespace furrow::physics {
namespace {

using FourHinges = PlateLayout::FourHinges;
using FourShares = PlateLayout::FourShares;
using FourTriangles = PlateLayout::FourTriangles;

/// Bends, and of each hinge the gradients at both tips with the feet in their last lanes.
FURROW_VECTOR_CLONES
void bend_hinges(const FourHinges* hinges, const Vec4* x, double* bend, Vec4* tips, int n) {
  for (int i = 0; i < n; ++i) {
    FourBends b;
    bends_of(hinges[i].vertex, x, b);
    const Lanes rest_angle = at(hinges[i].rest_angle);
    Lanes phi;
    bend_of(b.angle, rest_angle, phi);
    *(UnalignedLanes*)(bend + 4 * i) = phi;
    for (int j = 0; j < 4; ++j) {
      *(Lanes*)(tips + 8 * i + 2 * j) = Lanes{b.tip_a.x[j], b.tip_a.y[j], b.tip_a.z[j], b.foot_a[j]};
      *(Lanes*)(tips + 8 * i + 2 * j + 1) = Lanes{b.tip_b.x[j], b.tip_b.y[j], b.tip_b.z[j], b.foot_b[j]};
    }
  }
}

/// moment[h] += share . (A D) (sum of share times bend, less k at rest); returns the energy.
FURROW_VECTOR_CLONES
double answer_curvatures(const FourTriangles* triangles, const FourShares* shares, const double* bend,
                         double* moment, int n) {
  Lanes energy{};
  for (int t = 0; t < n; ++t) {
    const FourTriangles& f = triangles[t];
    Lanes k0 = -at(f.at_rest[0]), k1 = -at(f.at_rest[1]), k2 = -at(f.at_rest[2]);
    for (int e = f.begin; e < f.end; ++e) {
      const int* h = shares[e].hinge;
      const Lanes b{bend[h[0]], bend[h[1]], bend[h[2]], bend[h[3]]};
      k0 += at(shares[e].share[0]) * b, k1 += at(shares[e].share[1]) * b, k2 += at(shares[e].share[2]) * b;
    }
    const auto& d = f.stiffness;
    const Lanes s0 = at(d[0]) * k0 + at(d[3]) * k1 + at(d[4]) * k2,
                s1 = at(d[3]) * k0 + at(d[1]) * k1 + at(d[5]) * k2,
                s2 = at(d[4]) * k0 + at(d[5]) * k1 + at(d[2]) * k2;
    energy += k0 * s0 + k1 * s1 + k2 * s2;
    for (int e = f.begin; e < f.end; ++e) {
      const Lanes m = at(shares[e].share[0]) * s0 + at(shares[e].share[1]) * s1 + at(shares[e].share[2]) * s2;
      for (int j = 0; j < 4; ++j) moment[shares[e].hinge[j]] += m[j];
    }
  }
  return 0.5 * ((energy[0] + energy[1]) + (energy[2] + energy[3]));
}

/// Each hinge's moment pushes its tips; the edge's ends balance them.
FURROW_VECTOR_CLONES
void push_particles(const FourHinges* hinges, const double* moment, const Vec4* tips, Vec4* force, int n) {
  for (int h = 0; h < n; ++h) {
    const int i = h / 4, j = h % 4;
    Lanes a = *(const Lanes*)(tips + 2 * h), b = *(const Lanes*)(tips + 2 * h + 1);
    const double foot_a = a[3], foot_b = b[3], m = moment[h];
    a *= m, b *= m, a[3] = b[3] = 0;
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
Scratch& scratch() {
  thread_local Scratch s;
  return s;
}

/// Numbers 0 to n - 1 sorted by a key, equal ones as they were.
template <class Key>
std::vector<int> sorted_by(int n, const Key& key) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  return order;
}

}  // namespace

PlateLayout::PlateLayout(const Plate& plate, std::span<const int> place) {
  const auto placed = [&](int particle) { return place.empty() ? particle : place[std::size_t(particle)]; };
  const int n = int(plate.hinges.size());
  const std::vector<int> order = sorted_by(n, [&](int h) {
    const auto& v = plate.hinges[std::size_t(h)].vertices;
    return std::min(std::min(placed(v[0]), placed(v[1])), std::min(placed(v[2]), placed(v[3])));
  });
  std::vector<int> place_of_hinge(plate.hinges.size());
  for (int at = 0; at < (n + 3) / 4 * 4; ++at) {
    if (at % 4 == 0) hinges_.emplace_back();
    const int h = order[std::size_t(std::min(at, n - 1))];
    if (at < n) place_of_hinge[std::size_t(h)] = at;
    const Hinge& own = plate.hinges[std::size_t(h)];
    hinges_.back().rest_angle[at % 4] = own.rest_angle;
    for (std::size_t k = 0; k < 4; ++k) hinges_.back().vertex[k][at % 4] = placed(own.vertices[k]);
  }
  lay_out_triangles(plate, place_of_hinge);
  put_at_rest(plate);
}

void PlateLayout::lay_out_triangles(const Plate& plate, const std::vector<int>& place_of_hinge) {
  const int n = plate.triangles();
  const auto entry = [&](int t, int e) { return std::size_t(plate.begin[std::size_t(t)] + e); };
  const auto entries = [&](int t) { return plate.begin[std::size_t(t) + 1] - plate.begin[std::size_t(t)]; };
  const std::vector<int> order =
      sorted_by(n, [&](int t) { return place_of_hinge[std::size_t(plate.hinge[entry(t, 0)])]; });
  lane_of_.resize(std::size_t(n));
  for (int first = 0; first < n; first += 4) {
    if (first % 4096 == 0) throw_if_cancelled("plates");
    FourTriangles& four = triangles_.emplace_back();
    four = {};
    four.begin = int(shares_.size());
    int most = 0;
    for (int i = first; i < std::min(first + 4, n); ++i)
      most = std::max(most, entries(order[std::size_t(i)]));
    shares_.resize(shares_.size() + std::size_t(most), FourShares{});
    four.end = int(shares_.size());
    for (int i = first; i < std::min(first + 4, n); ++i) {
      const int t = order[std::size_t(i)], lane = i - first;
      lane_of_[std::size_t(t)] = i;
      const Eigen::Matrix3d& d = plate.stiffness[std::size_t(t)];
      const double own[6] = {d(0, 0), d(1, 1), d(2, 2), d(0, 1), d(0, 2), d(1, 2)};
      for (int c = 0; c < 6; ++c) four.stiffness[c][lane] = own[c];
      for (int e = 0; e < most; ++e) {
        FourShares& share = shares_[std::size_t(four.begin + e)];
        const std::size_t from = entry(t, std::min(e, entries(t) - 1));
        share.hinge[lane] = place_of_hinge[std::size_t(plate.hinge[from])];
        for (int c = 0; c < 3; ++c) share.share[c][lane] = e < entries(t) ? plate.share[from][c] : 0;
      }
    }
  }
}

void PlateLayout::put_at_rest(const Plate& plate) {
  for (std::size_t t = 0; t < plate.at_rest.size(); ++t)
    for (int c = 0; c < 3; ++c)
      triangles_[std::size_t(lane_of_[t] / 4)].at_rest[c][lane_of_[t] % 4] = plate.at_rest[t][c];
}

double PlateLayout::add_forces(const Vec4* x, Vec4* force) const {
  Scratch& s = scratch();
  const std::size_t fours = hinges_.size();
  s.bend.resize(4 * fours), s.tips.resize(8 * fours);
  s.moment.assign(4 * fours, 0.0);
  bend_hinges(hinges_.data(), x, s.bend.data(), s.tips.data(), int(fours));
  const double energy = answer_curvatures(triangles_.data(), shares_.data(), s.bend.data(), s.moment.data(),
                                          int(triangles_.size()));
  // Copies of the last hinge have no moment.
  if (force) push_particles(hinges_.data(), s.moment.data(), s.tips.data(), force, int(4 * fours));
  return energy;
}

double PlateLayout::add_forces(std::span<const Vec3> x, std::span<Vec3> force) const {
  Scratch& s = scratch();
  s.x.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) s.x[i] = {x[i].x(), x[i].y(), x[i].z(), 0};
  if (force.empty()) return add_forces(s.x.data(), nullptr);
  s.force.assign(x.size(), Vec4{});
  const double energy = add_forces(s.x.data(), s.force.data());
  for (std::size_t i = 0; i < x.size(); ++i) force[i] += Vec3(s.force[i].x, s.force[i].y, s.force[i].z);
  return energy;
}

}  // namespace furrow::physics
