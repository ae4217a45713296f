// SPDX-License-Identifier: MIT
#include "physics/plate/plate_bending.h"

#include <algorithm>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/cloth/dihedral.h"
#include "physics/cloth/hinge_forces.h"

namespace furrow::physics {
namespace {

/// The distinct ones of pairs i >= j, sorted. Returns where those of each i begin, and last their number.
std::vector<int> sort_pairs(const std::vector<std::array<int, 2>>& pairs,
                            std::vector<std::array<int, 2>>& sorted) {
  int rows = 0;
  for (const auto& pair : pairs) rows = std::max(rows, pair[0] + 1);
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(rows));
  for (const auto& [i, j] : pairs) columns[std::size_t(i)].push_back(j);
  std::vector<int> begin{0};
  for (int i = 0; i < rows; ++i) {
    std::vector<int>& row = columns[std::size_t(i)];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const int j : row) sorted.push_back({i, j});
    begin.push_back(int(sorted.size()));
  }
  return begin;
}

/// The particles that move a triangle's curvature, rising.
std::vector<int> corners_of(const Plate& plate, int t) {
  std::vector<int> corners;
  for (int e = plate.begin[std::size_t(t)]; e < plate.begin[std::size_t(t) + 1]; ++e)
    for (const int v : plate.hinges[std::size_t(plate.hinge[std::size_t(e)])].vertices) corners.push_back(v);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

PlateBending::PlateBending(Plate plate, std::size_t particles, std::shared_ptr<const PlateOrigin> origin)
    : plate_(std::move(plate)), layout_(plate_), origin_(std::move(origin)) {
  for (const Hinge& h : plate_.hinges) check(h, particles);
  pattern_ = find_pattern(plate_);
  alone_ = stiffness_alone();
}

PlateBending::PlateBending(Plate plate, const PlateBending& like, std::shared_ptr<const PlateOrigin> origin)
    : plate_(std::move(plate)), layout_(plate_), origin_(std::move(origin)), pattern_(like.pattern_) {
  if (!like.joins_as(plate_)) refuse("plate", "its hinges and triangles are not those of the other one");
  alone_ = stiffness_alone();
}

bool PlateBending::joins_as(const Plate& other) const {
  const auto same = [](const Hinge& a, const Hinge& b) { return a.vertices == b.vertices; };
  return plate_.begin == other.begin && plate_.hinge == other.hinge &&
         std::ranges::equal(plate_.hinges, other.hinges, same);
}

std::vector<double> PlateBending::stiffness_alone() const {
  std::vector<double> alone(plate_.hinges.size(), 0);
  for (std::size_t t = 0; t < plate_.stiffness.size(); ++t)
    for (std::size_t e = std::size_t(plate_.begin[t]); e < std::size_t(plate_.begin[t + 1]); ++e)
      alone[std::size_t(plate_.hinge[e])] += plate_.share[e].dot(plate_.stiffness[t] * plate_.share[e]);
  return alone;
}

std::shared_ptr<const PlateBending::Pattern> PlateBending::find_pattern(const Plate& plate) {
  auto pattern = std::make_shared<Pattern>();
  std::vector<std::array<int, 2>> all;
  for (int t = 0; t < plate.triangles(); ++t) {
    const std::vector<int> corners = corners_of(plate, t);
    for (int e = plate.begin[std::size_t(t)]; e < plate.begin[std::size_t(t) + 1]; ++e) {
      auto& at = pattern->corner_of_entry.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        const int v = plate.hinges[std::size_t(plate.hinge[std::size_t(e)])].vertices[k];
        at[k] =
            static_cast<unsigned char>(std::lower_bound(corners.begin(), corners.end(), v) - corners.begin());
      }
    }
    pattern->corners.push_back(int(corners.size()));
    for (std::size_t r = 0; r < corners.size(); ++r)
      for (std::size_t c = 0; c <= r; ++c) all.push_back({corners[r], corners[c]});
  }
  const std::vector<int> row = sort_pairs(all, pattern->pairs);
  const auto place = [&](int i, int j) {
    const std::array<int, 2> pair{std::max(i, j), std::min(i, j)};
    const auto begin = pattern->pairs.begin() + row[std::size_t(pair[0])];
    const auto end = pattern->pairs.begin() + row[std::size_t(pair[0]) + 1];
    return int(std::lower_bound(begin, end, pair) - pattern->pairs.begin());
  };
  for (const auto& [i, j] : all) pattern->place.push_back(place(i, j));
  for (const Hinge& h : plate.hinges) {
    auto& at = pattern->hinge_place.emplace_back();
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c <= r; ++c)
        at[std::size_t(lower_block(r, c))] = place(h.vertices[std::size_t(r)], h.vertices[std::size_t(c)]);
  }
  return pattern;
}

/// What bends and how it turns with the particles.
struct PlateBending::Bends {
  std::vector<double> bend;
  std::vector<std::array<Vec3, 4>> gradient;

  Bends(const std::vector<Hinge>& hinges, std::span<const Vec3> x) {
    bend.reserve(hinges.size()), gradient.reserve(hinges.size());
    for (const Hinge& h : hinges) {
      const auto& v = h.vertices;
      const Dihedral d = dihedral(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
      bend.push_back(physics::bend(d.angle, h.rest_angle));
      gradient.push_back(d.gradient);
    }
  }
};

/// dE/dbend, each triangle's curvature answered by its stiffness.
std::vector<double> PlateBending::moments_of(const std::vector<double>& bend, double& energy) const {
  std::vector<double> moment(bend.size());
  for (std::size_t t = 0; t < plate_.stiffness.size(); ++t) {
    const int begin = plate_.begin[t], end = plate_.begin[t + 1];
    Vec3 k = plate_.at_rest.empty() ? Vec3::Zero() : Vec3(-plate_.at_rest[t]);
    for (int e = begin; e < end; ++e)
      k += bend[std::size_t(plate_.hinge[std::size_t(e)])] * plate_.share[std::size_t(e)];
    const Vec3 answer = plate_.stiffness[t] * k;
    energy += 0.5 * k.dot(answer);
    for (int e = begin; e < end; ++e)
      moment[std::size_t(plate_.hinge[std::size_t(e)])] += plate_.share[std::size_t(e)].dot(answer);
  }
  return moment;
}

std::vector<Eigen::Vector3d> PlateBending::curvatures(std::span<const Vec3> x) const {
  const std::vector<double> bend = Bends(plate_.hinges, x).bend;
  std::vector<Eigen::Vector3d> k(plate_.stiffness.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < k.size(); ++t)
    for (std::size_t e = std::size_t(plate_.begin[t]); e < std::size_t(plate_.begin[t + 1]); ++e)
      k[t] += bend[std::size_t(plate_.hinge[e])] * plate_.share[e];
  return k;
}

void PlateBending::put_at_rest(std::vector<Eigen::Vector3d> curvature) {
  if (curvature.size() != plate_.stiffness.size())
    refuse("plate", curvature.size(), " curvatures for ", plate_.stiffness.size(), " triangles");
  plate_.at_rest = std::move(curvature);
  layout_.put_at_rest(plate_);
}

double PlateBending::energy(std::span<const Vec3> x) const { return layout_.add_forces(x, {}); }

double PlateBending::add_energy_and_forces(std::span<const Vec3> x, std::span<Vec3> force) const {
  return layout_.add_forces(x, force);
}

std::shared_ptr<const PackedEnergy> PlateBending::packed(std::span<const int> place) const {
  return std::make_shared<PlateLayout>(plate_, place);
}

std::vector<double> PlateBending::moments(std::span<const Vec3> x) const {
  double energy = 0;
  return moments_of(Bends(plate_.hinges, x).bend, energy);
}

void PlateBending::add_forces(std::span<const Vec3> x, std::span<Vec3> force) const {
  layout_.add_forces(x, force);
}

/// J^T A D J of each triangle, J = dk/dx.
void PlateBending::add_curvature_blocks(const std::vector<std::array<Vec3, 4>>& gradient,
                                        std::vector<Mat3>& blocks) const {
  std::vector<Mat3> j, answer;
  std::size_t place = 0;
  for (std::size_t t = 0; t < plate_.stiffness.size(); ++t) {
    if (t % 4096 == 0) throw_if_cancelled("plates");
    const std::size_t corners = std::size_t(pattern_->corners[t]);
    j.assign(corners, Mat3::Zero());
    for (std::size_t e = std::size_t(plate_.begin[t]); e < std::size_t(plate_.begin[t + 1]); ++e)
      for (std::size_t k = 0; k < 4; ++k)
        j[pattern_->corner_of_entry[e][k]] +=
            plate_.share[e] * gradient[std::size_t(plate_.hinge[e])][k].transpose();
    answer.resize(corners);
    for (std::size_t c = 0; c < corners; ++c) answer[c].noalias() = plate_.stiffness[t] * j[c];
    for (std::size_t r = 0; r < corners; ++r)
      for (std::size_t c = 0; c <= r; ++c)
        blocks[std::size_t(pattern_->place[place++])] += j[r].transpose().lazyProduct(answer[c]);
  }
}

/// Each hinge by itself: diag Q in place of Q.
void PlateBending::hand_out_hinges(std::span<const Vec3> x, Stiffness stiffness,
                                   const BlockSink& sink) const {
  const Bends b(plate_.hinges, x);
  double energy = 0;
  const std::vector<double> moment = moments_of(b.bend, energy);
  for (std::size_t h = 0; h < moment.size(); ++h) {
    const auto& v = plate_.hinges[h].vertices;
    std::array<Mat3, 10> blocks;
    const double m = (1 - stiffness.clamped) * moment[h];
    if (m != 0) blocks = dihedral_hessian(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c <= r; ++c) {
        const std::size_t i = std::size_t(lower_block(r, c));
        const Mat3 curl =
            alone_[h] * b.gradient[h][std::size_t(r)] * b.gradient[h][std::size_t(c)].transpose();
        blocks[i] = m != 0 ? Mat3(m * blocks[i] + curl) : curl;
      }
    hand_out(v, blocks.data(), sink);
  }
}

bool PlateBending::add_stiffness(std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) const {
  if (stiffness.narrow) {
    hand_out_hinges(x, stiffness, sink);
    return true;
  }
  const Bends b(plate_.hinges, x);
  std::vector<Mat3> blocks(pattern_->pairs.size(), Mat3::Zero());
  add_curvature_blocks(b.gradient, blocks);
  double energy = 0;
  const std::vector<double> moment = moments_of(b.bend, energy);
  for (std::size_t h = 0; h < moment.size(); ++h) {
    const double m = (1 - stiffness.clamped) * moment[h];
    if (m == 0) continue;
    const auto& v = plate_.hinges[h].vertices;
    const auto hessian = dihedral_hessian(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c <= r; ++c) {
        const std::size_t i = std::size_t(lower_block(r, c));
        Mat3& block = blocks[std::size_t(pattern_->hinge_place[h][i])];
        if (v[std::size_t(r)] >= v[std::size_t(c)])
          block += m * hessian[i];
        else
          block += m * hessian[i].transpose();
      }
  }
  for (std::size_t p = 0; p < pattern_->pairs.size(); ++p) {
    const auto [i, j] = pattern_->pairs[p];
    sink(i, j, blocks[p]);
    if (i != j) sink(j, i, blocks[p].transpose());
  }
  return true;
}

int count_coupled(const Cloth& cloth) {
  int n = 0;
  for (const auto& own : cloth.energies)
    if (const auto* plate = dynamic_cast<const PlateBending*>(own.get()))
      n += int(plate->plate().hinges.size());
  return n;
}

CoupledHinges couple_hinges(Cloth& cloth, std::span<const std::array<double, 3>> rest_lengths,
                            const PlateOptions& options, std::span<const char> apart,
                            std::span<const double> press) {
  if (cloth.hinge_law != HingeLaw::linear) refuse("couple_hinges", "the hinges' law is not linear");
  PlateParts parts = make_plate(
      {cloth.triangles, rest_lengths, cloth.hinges, cloth.particles.inv_mass, apart, press}, options);
  CoupledHinges result{int(parts.coupled.size()), int(parts.plain.size()), parts.slivers};
  if (parts.coupled.empty()) return result;
  PlateOrigin origin{options.rigidity,
                     {options.warp.begin(), options.warp.end()},
                     {rest_lengths.begin(), rest_lengths.end()},
                     {apart.begin(), apart.end()},
                     {press.begin(), press.end()},
                     parts.coupled,
                     parts.plain};
  origin.press.resize(cloth.hinges.size(), 1);
  cloth.energies.push_back(std::make_shared<PlateBending>(std::move(parts.plate), cloth.particles.size(),
                                                          std::make_shared<PlateOrigin>(std::move(origin))));
  std::vector<Hinge> plain;
  for (const int h : parts.plain) plain.push_back(cloth.hinges[std::size_t(h)]);
  cloth.hinges = std::move(plain);
  return result;
}

}  // namespace furrow::physics
