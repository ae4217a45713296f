// SPDX-License-Identifier: MIT
#include "physics/cloth/patch_membrane.h"

#include <algorithm>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"

namespace furrow::physics {
namespace {

/// What one thread's passes need; kept, so that they allocate nothing.
struct PatchScratch {
  std::vector<double> longer, tension;
};
PatchScratch& patch_scratch() {
  thread_local PatchScratch s;
  return s;
}

/// d of each edge to `longer`, tau to `tension`; returns the energy.
template <class At>
double find_tensions(const Patches& p, const At& at, PatchScratch& s) {
  s.longer.resize(p.edges.size());
  s.tension.assign(p.edges.size(), 0);
  for (std::size_t e = 0; e < p.edges.size(); ++e)
    s.longer[e] = (at(p.edges[e].b) - at(p.edges[e].a)).squaredNorm() - p.edges[e].length2;
  double energy = 0;
  for (std::size_t v = 0; v < p.stiffness.size(); ++v) {
    const std::size_t begin = std::size_t(p.begin[v]), end = std::size_t(p.begin[v + 1]);
    Vec3 strain = Vec3::Zero();
    for (std::size_t i = begin; i < end; ++i) strain += s.longer[std::size_t(p.edge[i])] * p.share[i];
    const Vec3 stress = p.stiffness[v] * strain;
    energy += 0.5 * strain.dot(stress);
    for (std::size_t i = begin; i < end; ++i) s.tension[std::size_t(p.edge[i])] += stress.dot(p.share[i]);
  }
  return energy;
}

double pass(const Patches& p, std::span<const Vec3> x, std::span<Vec3> force) {
  PatchScratch& s = patch_scratch();
  const double energy = find_tensions(
      p, [&](int i) { return x[std::size_t(i)]; }, s);
  if (force.empty()) return energy;
  for (std::size_t e = 0; e < p.edges.size(); ++e) {
    const auto& [a, b, length2] = p.edges[e];
    const Vec3 pull = 2 * s.tension[e] * (x[std::size_t(b)] - x[std::size_t(a)]);
    force[std::size_t(a)] += pull;
    force[std::size_t(b)] -= pull;
  }
  return energy;
}

/// Patches whose edges name places.
class PackedPatches : public PackedEnergy {
 public:
  PackedPatches(const Patches& patches, std::span<const int> place) : patches_(patches) {
    for (auto& [a, b, length2] : patches_.edges) a = place[std::size_t(a)], b = place[std::size_t(b)];
  }
  double add_forces(const Vec4* x, Vec4* force) const override {
    PatchScratch& s = patch_scratch();
    const double energy = find_tensions(
        patches_, [&](int i) { return xyz(x[i]); }, s);
    if (!force) return energy;
    for (std::size_t e = 0; e < patches_.edges.size(); ++e) {
      const auto& [a, b, length2] = patches_.edges[e];
      const Vec3 pull = 2 * s.tension[e] * (xyz(x[b]) - xyz(x[a]));
      force[a].x += pull.x(), force[a].y += pull.y(), force[a].z += pull.z();
      force[b].x -= pull.x(), force[b].y -= pull.y(), force[b].z -= pull.z();
    }
    return energy;
  }

 private:
  Patches patches_;
};

}  // namespace

PatchMembrane::PatchMembrane(Patches patches, std::size_t particles) : patches_(std::move(patches)) {
  for (const auto& [a, b, length2] : patches_.edges)
    if (a < 0 || b <= a || std::size_t(b) >= particles)
      refuse("patches", "an edge names particles ", a, " and ", b, " of ", particles);
  find_pattern();
}

void PatchMembrane::find_pattern() {
  const Patches& p = patches_;
  std::vector<std::array<int, 2>> all;
  for (std::size_t v = 0; v < p.stiffness.size(); ++v) {
    std::vector<int> corners;
    const std::size_t begin = std::size_t(p.begin[v]), end = std::size_t(p.begin[v + 1]);
    for (std::size_t i = begin; i < end; ++i)
      for (const int c : {p.edges[std::size_t(p.edge[i])].a, p.edges[std::size_t(p.edge[i])].b})
        if (std::find(corners.begin(), corners.end(), c) == corners.end()) corners.push_back(c);
    std::sort(corners.begin(), corners.end());
    const auto rank = [&](int c) {
      return static_cast<unsigned char>(std::lower_bound(corners.begin(), corners.end(), c) -
                                        corners.begin());
    };
    for (std::size_t i = begin; i < end; ++i)
      ends_.push_back({rank(p.edges[std::size_t(p.edge[i])].a), rank(p.edges[std::size_t(p.edge[i])].b)});
    corners_.push_back(int(corners.size()));
    for (std::size_t r = 0; r < corners.size(); ++r)
      for (std::size_t c = 0; c <= r; ++c) all.push_back({corners[r], corners[c]});
  }
  pairs_ = all;
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  const auto place = [&](int i, int j) {
    return int(std::lower_bound(pairs_.begin(), pairs_.end(), std::array{i, j}) - pairs_.begin());
  };
  for (const auto& [i, j] : all) place_.push_back(place(i, j));
  for (const auto& [a, b, length2] : p.edges) edge_place_.push_back({place(a, a), place(b, a), place(b, b)});
}

double PatchMembrane::energy(std::span<const Vec3> x) const { return pass(patches_, x, {}); }

void PatchMembrane::add_forces(std::span<const Vec3> x, std::span<Vec3> force) const {
  pass(patches_, x, force);
}

double PatchMembrane::add_energy_and_forces(std::span<const Vec3> x, std::span<Vec3> force) const {
  return pass(patches_, x, force);
}

std::shared_ptr<const PackedEnergy> PatchMembrane::packed(std::span<const int> place) const {
  return std::make_shared<PackedPatches>(patches_, place);
}

std::shared_ptr<PatchMembrane> PatchMembrane::softened(double times) const {
  auto copy = std::make_shared<PatchMembrane>(*this);
  for (Eigen::Matrix3d& own : copy->patches_.stiffness) own /= times;
  return copy;
}

/// J^T A C J of each patch.
void PatchMembrane::add_strain_blocks(std::span<const Vec3> x, std::vector<Mat3>& blocks) const {
  const Patches& p = patches_;
  std::vector<Mat3> j, answer;
  std::size_t place = 0;
  for (std::size_t v = 0; v < p.stiffness.size(); ++v) {
    if (v % 4096 == 0) throw_if_cancelled("patches");
    const std::size_t corners = std::size_t(corners_[v]);
    j.assign(corners, Mat3::Zero());
    for (std::size_t i = std::size_t(p.begin[v]); i < std::size_t(p.begin[v + 1]); ++i) {
      const auto& [a, b, length2] = p.edges[std::size_t(p.edge[i])];
      const Mat3 slope = 2 * p.share[i] * (x[std::size_t(b)] - x[std::size_t(a)]).transpose();
      j[ends_[i][0]] -= slope;
      j[ends_[i][1]] += slope;
    }
    answer.resize(corners);
    for (std::size_t c = 0; c < corners; ++c) answer[c].noalias() = p.stiffness[v] * j[c];
    for (std::size_t r = 0; r < corners; ++r)
      for (std::size_t c = 0; c <= r; ++c)
        blocks[std::size_t(place_[place++])] += j[r].transpose().lazyProduct(answer[c]);
  }
}

/// 2 tau |u_b - u_a|^2 / 2 of each edge.
void PatchMembrane::add_tension_blocks(std::span<const Vec3> x, Stiffness stiffness,
                                       std::vector<Mat3>& blocks) const {
  PatchScratch& s = patch_scratch();
  find_tensions(
      patches_, [&](int i) { return x[std::size_t(i)]; }, s);
  for (std::size_t e = 0; e < edge_place_.size(); ++e) {
    const double tension = s.tension[e] < 0 ? (1 - stiffness.clamped) * s.tension[e] : s.tension[e];
    const auto [aa, ba, bb] = edge_place_[e];
    blocks[std::size_t(aa)].diagonal().array() += 2 * tension;
    blocks[std::size_t(ba)].diagonal().array() -= 2 * tension;
    blocks[std::size_t(bb)].diagonal().array() += 2 * tension;
  }
}

bool PatchMembrane::add_stiffness(std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) const {
  std::vector<Mat3> blocks(pairs_.size(), Mat3::Zero());
  add_strain_blocks(x, blocks);
  add_tension_blocks(x, stiffness, blocks);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [i, j] = pairs_[k];
    sink(i, j, blocks[k]);
    if (i != j) sink(j, i, blocks[k].transpose());
  }
  return true;
}

}  // namespace furrow::physics
