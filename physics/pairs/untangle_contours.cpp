// SPDX-License-Identifier: MIT
#include "physics/pairs/untangle_contours.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/pairs/tangle_contours.h"
#include "physics/pairs/tangle_moves.h"

namespace furrow::physics {
namespace {

constexpr double shorter = 0.99;     // a line that is not gets stale
constexpr double least_sum = 0.1;    // of the terms' lengths: below, a common direction says nothing
constexpr double second_try = 3;     // times the longest move
constexpr int stale_for_region = 8;  // rounds after which the other way is tried

/// What is known of a contour from the rounds before.
struct ContourPast {
  double shortest = 0;  ///< [m]
  int stale = -1;       ///< rounds since it was a hundredth shorter; -1: it is new
};

/// A part of the cloth that a contour cuts off.
struct CutRegion {
  int side;          ///< of the contour, to which it belongs
  double across;     ///< 1: it lies on the side of the other one's normals, -1: on the other side
  std::size_t size;  ///< vertices
};

class ContourUntangler {
 public:
  ContourUntangler(std::span<Vec3> x, const PairMesh& mesh, const ContourOptions& o)
      : x_(x),
        mesh_(mesh),
        o_(o),
        moves_(x, mesh, o.farthest * mesh.mean_edge),
        triangles_of_edge_(triangles_of_edges(mesh)),
        neighbours_(x.size()) {
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
      const auto& [a, b] = mesh.edges[e];
      neighbours_[std::size_t(a)].push_back({b, int(e)});
      neighbours_[std::size_t(b)].push_back({a, int(e)});
    }
  }

  ContourReport run() {
    ContourReport report;
    std::vector<EdgeFaceCrossing> now = edge_face_crossings(mesh_, x_);
    report.at_start = report.left = int(now.size());
    std::vector<Vec3> best = moves_.start();
    const auto may_go_on = [&] { return report.rounds < o_.most_rounds && !is_cancelled(); };
    for (int stale = 0; !now.empty() && stale < 2 * o_.patience && may_go_on(); ++stale) {
      if (!move(now)) break;
      ++report.rounds;
      now = edge_face_crossings(mesh_, x_);
      if (int(now.size()) >= report.left) continue;
      report.left = int(now.size());
      best.assign(x_.begin(), x_.end());
      stale = -1;
    }
    std::copy(best.begin(), best.end(), x_.begin());
    report.farthest = moves_.farthest_of(best);
    if (report.left) report.lines = lines();
    return report;
  }

 private:
  struct Neighbour {
    int vertex, edge;
  };

  std::vector<TangleContour> contours(std::span<const EdgeFaceCrossing> crossings) const {
    return tangle_contours(mesh_, x_, crossings, triangles_of_edge_);
  }

  std::vector<CrossingLine> lines() const {
    std::vector<CrossingLine> found;
    for (const TangleContour& c : contours(edge_face_crossings(mesh_, x_)))
      found.push_back({c.middle(), c.length, int(c.crossings.size())});
    std::stable_sort(found.begin(), found.end(),
                     [](const CrossingLine& a, const CrossingLine& b) { return a.length > b.length; });
    return found;
  }

  /// A round. Returns false if every contour has been given up.
  bool move(const std::vector<EdgeFaceCrossing>& crossings) {
    const std::vector<TangleContour> all = contours(crossings);
    remember(all);
    edge_crossed_.assign(mesh_.edges.size(), 0);
    for (const EdgeFaceCrossing& c : crossings) edge_crossed_[std::size_t(c.edge)] = 1;
    normal_ = vertex_normals(mesh_.triangles, x_);
    way_.assign(x_.size(), Vec3::Zero());
    bool any = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (past_[i].stale >= o_.patience) continue;
      any = true;
      add_way(all[i], past_[i]);
    }
    if (!any) return false;
    for (Vec3& w : way_)
      if (const double length = w.norm(); length > 0) w /= length;
    moves_.smooth(way_);
    moves_.go(way_, o_.longest_move * mesh_.mean_edge);
    return true;
  }

  /// Contours go on as those of the round before with which they share most triangles.
  void remember(const std::vector<TangleContour>& all) {
    std::vector<ContourPast> past(all.size());
    std::vector<int> owner(mesh_.triangles.size(), -1);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const int before = owner_before(all[i]);
      if (before >= 0) past[i] = past_[std::size_t(before)];
      ContourPast& p = past[i];
      if (p.stale < 0 || all[i].length < shorter * p.shortest)
        p = {all[i].length, 0};
      else
        ++p.stale;
      each_triangle(all[i], [&](int t) { owner[std::size_t(t)] = int(i); });
    }
    past_ = std::move(past);
    owner_ = std::move(owner);
  }

  template <class Visit>
  void each_triangle(const TangleContour& contour, const Visit& visit) const {
    for (const ContourCrossing& c : contour.crossings) {
      visit(c.crossing.triangle);
      for (const int t : triangles_of_edge_[std::size_t(c.crossing.edge)])
        if (t >= 0) visit(t);
    }
  }

  int owner_before(const TangleContour& contour) const {
    std::vector<int> owners;
    if (!owner_.empty())
      each_triangle(contour, [&](int t) {
        if (owner_[std::size_t(t)] >= 0) owners.push_back(owner_[std::size_t(t)]);
      });
    std::sort(owners.begin(), owners.end());
    int most = -1;
    std::ptrdiff_t votes = 0;
    for (auto i = owners.begin(); i != owners.end();) {
      const auto end = std::upper_bound(i, owners.end(), *i);
      if (end - i > votes) votes = end - i, most = *i;
      i = end;
    }
    return most;
  }

  void add_way(const TangleContour& contour, const ContourPast& past) {
    Vec3 sum = Vec3::Zero();
    double terms = 0;
    for (const ContourCrossing& c : contour.crossings) {
      sum += c.side == 0 ? c.shortening : Vec3(-c.shortening);
      terms += c.shortening.norm();
    }
    const bool says_nothing = !(sum.norm() > least_sum * terms);
    if (says_nothing || past.stale >= stale_for_region)
      if (const auto region = smaller_region(contour)) return add_region(contour, *region);
    if (says_nothing) {
      for (const ContourCrossing& c : contour.crossings) push(c, c.shortening.normalized());
      return;
    }
    sum.normalize();
    for (const ContourCrossing& c : contour.crossings) push(c, c.side == 0 ? sum : Vec3(-sum));
  }

  /// The edge that way, the triangle the other way.
  void push(const ContourCrossing& c, const Vec3& way) {
    for (const int v : mesh_.edges[std::size_t(c.crossing.edge)]) way_[std::size_t(v)] += way;
    for (const int v : mesh_.triangles[std::size_t(c.crossing.triangle)]) way_[std::size_t(v)] -= way;
  }

  /// The region goes back through the other side of the contour.
  void add_region(const TangleContour& contour, const CutRegion& region) {
    for (const ContourCrossing& c : contour.crossings) {
      if (c.side == region.side) {
        push(c, -region.across * c.normal);
        continue;
      }
      const auto& e = mesh_.edges[std::size_t(c.crossing.edge)];
      const Vec3 normal = normal_[std::size_t(e[0])] + normal_[std::size_t(e[1])];
      if (normal.norm() > 0) push(c, region.across * normal.normalized());
    }
  }

  std::optional<CutRegion> smaller_region(const TangleContour& contour) const {
    std::optional<CutRegion> smaller;
    for (const int side : {0, 1}) {
      const auto region = region_of(contour, side);
      if (region && (!smaller || region->size < smaller->size)) smaller = region;
    }
    return smaller;
  }

  /// The smaller one of the two parts that a contour cuts one of its sides into; none: it does not.
  std::optional<CutRegion> region_of(const TangleContour& contour, int side) const {
    std::vector<signed char> label(x_.size(), 0);
    std::vector<int> above, below;
    for (const ContourCrossing& c : contour.crossings) {
      if (c.side != side) continue;
      const Vec3& origin = x_[std::size_t(mesh_.triangles[std::size_t(c.crossing.triangle)][0])];
      for (const int v : mesh_.edges[std::size_t(c.crossing.edge)]) {
        const signed char sign = (x_[std::size_t(v)] - origin).dot(c.normal) > 0 ? 1 : -1;
        if (label[std::size_t(v)] == -sign) return {};
        if (label[std::size_t(v)] == 0) (sign > 0 ? above : below).push_back(v);
        label[std::size_t(v)] = sign;
      }
    }
    if (above.empty() || below.empty() || !flood(above, label) || !flood(below, label)) return {};
    const bool is_above = above.size() < below.size();
    return CutRegion{side, is_above ? 1.0 : -1.0, std::min(above.size(), below.size())};
  }

  /// Lets a part grow to where something crosses. Returns false if it meets the other one.
  bool flood(std::vector<int>& part, std::vector<signed char>& label) const {
    for (std::size_t i = 0; i < part.size(); ++i) {
      const signed char own = label[std::size_t(part[i])];
      for (const Neighbour& n : neighbours_[std::size_t(part[i])]) {
        signed char& other = label[std::size_t(n.vertex)];
        if (edge_crossed_[std::size_t(n.edge)] || other == own) continue;
        if (other == -own) return false;
        other = own;
        part.push_back(n.vertex);
      }
    }
    return true;
  }

  std::span<Vec3> x_;
  const PairMesh& mesh_;
  const ContourOptions& o_;
  TangleMoves moves_;
  std::vector<std::array<int, 2>> triangles_of_edge_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<ContourPast> past_;
  std::vector<int> owner_;  ///< by triangle, of past_; -1: none
  std::vector<char> edge_crossed_;
  std::vector<Vec3> normal_, way_;
};

}  // namespace

void add_later(const ContourReport& now, ContourReport& all) {
  if (all.at_start == 0) all.at_start = now.at_start;
  all.left = now.left;
  all.rounds += now.rounds;
  all.farthest = std::max(all.farthest, now.farthest);
  all.lines = now.lines;
}

ContourReport untangle_contours(std::span<Vec3> x, const PairMesh& mesh, const ContourOptions& options) {
  const char* const operation = "untangle_contours";
  require(operation, "longest_move", options.longest_move, options.longest_move > 0, "> 0");
  require(operation, "farthest", options.farthest, options.farthest > 0, "> 0");
  require(operation, "most_rounds", options.most_rounds, options.most_rounds >= 0, ">= 0");
  require(operation, "patience", options.patience, options.patience >= 1, ">= 1");
  if (x.size() != mesh.held.size())
    refuse(operation, x.size(), " positions of ", mesh.held.size(), " particles");
  const std::vector<Vec3> start(x.begin(), x.end());
  ContourReport first = ContourUntangler(x, mesh, options).run();
  if (first.left == 0) return first;
  ContourOptions bolder = options;
  bolder.longest_move *= second_try;
  std::vector<Vec3> other = start;
  ContourReport second = ContourUntangler(other, mesh, bolder).run();
  if (second.left < first.left) std::copy(other.begin(), other.end(), x.begin());
  ContourReport& better = second.left < first.left ? second : first;
  better.rounds = first.rounds + second.rounds;
  return better;
}

}  // namespace furrow::physics
