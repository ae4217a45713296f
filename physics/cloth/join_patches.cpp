// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/patch_membrane.h"

namespace furrow::physics {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr double least_height = 1e-4;  // of a triangle, in its longest edge
constexpr double same_length = 1e-9;   // of an edge in two triangles
constexpr double unlike = 0.1;         // materials, in the largest stiffness of the fan

/// A triangle as one of its corners sees it.
struct Corner {
  int triangle, at;
};

/// Who meets where.
struct Net {
  std::vector<std::vector<Corner>> around;  ///< each particle, in the order of triangles
  std::vector<Patches::Edge> edges;         ///< sorted by (a, b)
  std::vector<std::array<int, 3>> edge_of;  ///< of each triangle, edge i opposite corner i; -1: left out
  std::vector<char> torn;                   ///< edges whose triangles do not agree on their length
};

bool is_held(const Cloth& cloth, const MembraneTriangle& t) {
  return std::ranges::all_of(t.vertices,
                             [&](int v) { return cloth.particles.inv_mass[std::size_t(v)] == 0; });
}

/// The membrane without what is held.
Net net_of(const Cloth& cloth) {
  struct Use {
    int a, b, triangle, at;
  };
  Net net{std::vector<std::vector<Corner>>(cloth.particles.size()), {}, {}, {}};
  std::vector<Use> uses;
  for (int t = 0; t < int(cloth.membrane.size()); ++t) {
    const MembraneTriangle& own = cloth.membrane[std::size_t(t)];
    net.edge_of.push_back({-1, -1, -1});
    if (is_held(cloth, own)) continue;
    for (int i = 0; i < 3; ++i) {
      const int a = own.vertices[(i + 1) % 3], b = own.vertices[(i + 2) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), t, i});
      net.around[std::size_t(own.vertices[i])].push_back({t, i});
    }
  }
  std::ranges::sort(uses, {}, [](const Use& u) { return std::array{u.a, u.b, u.triangle, u.at}; });
  for (const auto& [a, b, t, i] : uses) {
    const double length = cloth.membrane[std::size_t(t)].rest_lengths[i], length2 = length * length;
    if (net.edges.empty() || net.edges.back().a != a || net.edges.back().b != b) {
      net.edges.push_back({a, b, length2});
      net.torn.push_back(false);
    } else if (!(std::abs(length2 - net.edges.back().length2) <= 2 * same_length * length2)) {
      net.torn.back() = true;
    }
    net.edge_of[std::size_t(t)][i] = int(net.edges.size()) - 1;
  }
  return net;
}

/// The triangles around a vertex counter-clockwise, from a border if there is one; none if they are no single
/// fan.
struct Fan {
  std::vector<Corner> corners;
  bool closed = false;
};
std::optional<Fan> fan_of(const Cloth& cloth, const std::vector<Corner>& around) {
  const auto from = [&](Corner c) { return cloth.membrane[c.triangle].vertices[(c.at + 1) % 3]; };
  const auto to = [&](Corner c) { return cloth.membrane[c.triangle].vertices[(c.at + 2) % 3]; };
  const auto starting_at = [&](int v) {
    return std::ranges::find_if(around, [&](Corner c) { return from(c) == v; });
  };
  Fan fan{{}, true};
  Corner now = around.front();
  for (const Corner c : around) {
    const bool twice = std::ranges::any_of(around, [&](Corner other) {
      return other.triangle != c.triangle && (from(other) == from(c) || to(other) == to(c));
    });
    if (twice) return {};  // two triangles on one side of an edge
    if (std::ranges::any_of(around, [&](Corner other) { return to(other) == from(c); })) continue;
    fan.closed = false;
    now = c;
  }
  while (fan.corners.size() < around.size()) {
    fan.corners.push_back(now);
    const auto next = starting_at(to(now));
    if (next == around.end()) break;
    now = *next;
    if (now.triangle == fan.corners.front().triangle) break;
  }
  if (fan.corners.size() != around.size()) return {};
  return fan;
}

/// A triangle of the fan: its area, its stiffness C in the fan's axes, and what its edges' d add to its
/// strain.
struct Laid {
  double area;
  Matrix3d stiffness;
  std::array<Vector3d, 3> strain;
};

/// Of corner c, the bisector of its angle [rad] in the direction `middle`.
Laid lay(const MembraneTriangle& t, int c, double angle, double middle) {
  const auto along = [](double a) { return Vector2d(std::cos(a), std::sin(a)); };
  std::array<Vector2d, 3> x;
  x[c] = Vector2d::Zero();
  x[(c + 1) % 3] = t.rest_lengths[(c + 2) % 3] * along(middle - angle / 2);
  x[(c + 2) % 3] = t.rest_lengths[(c + 1) % 3] * along(middle + angle / 2);
  std::array<Vector2d, 3> turned;
  for (int i = 0; i < 3; ++i) {
    const Vector2d e = x[(i + 2) % 3] - x[(i + 1) % 3];
    turned[i] = {-e.y(), e.x()};
  }
  const double twice = turned[2].y() * turned[1].x() - turned[2].x() * turned[1].y();  // the area
  Laid laid{twice / 2, Matrix3d::Zero(), {}};
  for (int i = 0; i < 3; ++i) {
    const Vector2d &p = turned[(i + 1) % 3], &q = turned[(i + 2) % 3];
    laid.strain[i] =
        Vector3d(p.x() * q.x(), p.y() * q.y(), p.x() * q.y() + p.y() * q.x()) / (-2 * twice * twice);
  }
  laid.stiffness.topLeftCorner<2, 2>().setConstant(t.lambda);
  laid.stiffness.diagonal() += Vector3d(2 * t.mu, 2 * t.mu, t.mu);
  if (t.threads.any()) {
    const Vector2d edge = x[1] - x[0], w = along(std::atan2(edge.y(), edge.x()) + t.threads.angle);
    const Vector3d warp(w.x() * w.x(), w.y() * w.y(), w.x() * w.y()),
        weft(w.y() * w.y(), w.x() * w.x(), -w.x() * w.y());
    laid.stiffness += t.threads.warp * warp * warp.transpose() + t.threads.weft * weft * weft.transpose();
  }
  return laid;
}

/// Of the corner of a triangle at rest [rad]; none if the triangle is too low to be asked.
std::optional<double> angle_at(const MembraneTriangle& t, int c) {
  const auto& l = t.rest_lengths;
  const double p = l[(c + 1) % 3], q = l[(c + 2) % 3], o = l[c], longest = std::max({p, q, o});
  const double half = (p + q + o) / 2, area = std::sqrt(half * (half - p) * (half - q) * (half - o));
  if (2 * area < least_height * longest * longest) return {};
  return std::atan2(4 * area, p * p + q * q - o * o);
}

/// The fan unfolded; empty if it cannot be a patch.
std::vector<Laid> unfolded(const Cloth& cloth, const Fan& fan, double most_defect) {
  using std::numbers::pi;
  std::vector<double> angle;
  double sum = 0;
  for (const auto& [t, c] : fan.corners) {
    const std::optional<double> own = angle_at(cloth.membrane[std::size_t(t)], c);
    if (!own) return {};
    angle.push_back(*own);
    sum += *own;
  }
  if (fan.closed && std::abs(2 * pi - sum) > most_defect) return {};
  const double scale = fan.closed ? 2 * pi / sum : 1;
  std::vector<Laid> laid;
  double before = 0;
  for (std::size_t k = 0; k < angle.size(); ++k) {
    const auto& [t, c] = fan.corners[k];
    laid.push_back(lay(cloth.membrane[std::size_t(t)], c, angle[k], scale * (before + angle[k] / 2)));
    before += angle[k];
  }
  return laid;
}

bool is_torn(const Net& net, const Fan& fan) {
  return std::ranges::any_of(fan.corners, [&](Corner c) {
    return std::ranges::any_of(net.edge_of[std::size_t(c.triangle)],
                               [&](int e) { return net.torn[std::size_t(e)] != 0; });
  });
}

/// Adds the patch of a fan; false, with nothing added, if it has none.
bool add_patch(const Cloth& cloth, const Net& net, const Fan& fan, const PatchOptions& o, Patches& patches) {
  if (is_torn(net, fan)) return false;
  const std::vector<Laid> laid = unfolded(cloth, fan, o.most_defect);
  if (laid.empty()) return false;
  double area = 0;
  Matrix3d stiffness = Matrix3d::Zero();
  for (const Laid& t : laid) area += t.area, stiffness += t.area * t.stiffness;
  stiffness /= area;
  for (const Laid& t : laid)
    if ((t.stiffness - stiffness).cwiseAbs().maxCoeff() > unlike * stiffness.cwiseAbs().maxCoeff())
      return false;
  const std::size_t begin = patches.edge.size();
  for (std::size_t k = 0; k < laid.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const int e = net.edge_of[std::size_t(fan.corners[k].triangle)][i];
      const auto known = std::find(patches.edge.begin() + std::ptrdiff_t(begin), patches.edge.end(), e);
      const Vector3d share = laid[k].area / area * laid[k].strain[i];
      if (known != patches.edge.end()) {
        patches.share[std::size_t(known - patches.edge.begin())] += share;
      } else {
        patches.edge.push_back(e);
        patches.share.push_back(share);
      }
    }
  patches.begin.push_back(int(begin));
  patches.stiffness.push_back((1 - o.triangle_share) * area / 3 * stiffness);
  return true;
}

/// Leaves the edges that patches read, and renumbers them.
void keep_used(const std::vector<Patches::Edge>& edges, Patches& patches) {
  std::vector<int> number(edges.size(), -1);
  for (const int e : patches.edge) number[std::size_t(e)] = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (number[e] < 0) continue;
    number[e] = int(patches.edges.size());
    patches.edges.push_back(edges[e]);
  }
  for (int& e : patches.edge) e = number[std::size_t(e)];
}

std::array<double*, 4> moduli_of(MembraneTriangle& t) {
  return {&t.lambda, &t.mu, &t.threads.warp, &t.threads.weft};
}

}  // namespace

PatchCount join_patches(Cloth& cloth, const PatchOptions& o) {
  require("join_patches", "triangle_share", o.triangle_share, o.triangle_share > 0 && o.triangle_share <= 1,
          "in (0, 1]");
  require("join_patches", "most_defect", o.most_defect, o.most_defect >= 0, ">= 0");
  check_elements(cloth, cloth.particles.size());
  if (cloth.particles.inv_mass.size() != cloth.particles.size())
    refuse("join_patches", cloth.particles.inv_mass.size(), " inverse masses of ", cloth.particles.size(),
           " particles");
  const Net net = net_of(cloth);
  PatchCount count;
  Patches patches;
  std::vector<int> given(cloth.membrane.size(), 0);  // corners of each triangle
  for (std::size_t v = 0; v < net.around.size(); ++v) {
    if (v % 4096 == 0) throw_if_cancelled("patches");
    if (net.around[v].empty()) continue;
    const std::optional<Fan> fan = fan_of(cloth, net.around[v]);
    const bool joined = fan && add_patch(cloth, net, *fan, o, patches);
    ++(joined ? count.patches : count.plain);
    for (const Corner c : net.around[v]) given[std::size_t(c.triangle)] += joined;
  }
  if (count.patches == 0) return count;
  patches.begin.push_back(int(patches.edge.size()));
  keep_used(net.edges, patches);
  cloth.energies.push_back(std::make_shared<PatchMembrane>(std::move(patches), cloth.particles.size()));
  for (std::size_t t = 0; t < given.size(); ++t)
    for (double* modulus : moduli_of(cloth.membrane[t]))
      *modulus *= 1 - (1 - o.triangle_share) * given[t] / 3;
  return count;
}

void soften_membrane(Cloth& cloth, double times) {
  require("soften_membrane", "times", times, times > 0, "> 0");
  for (MembraneTriangle& t : cloth.membrane)
    for (double* modulus : moduli_of(t)) *modulus /= times;
  for (auto& own : cloth.energies)
    if (const auto* patches = dynamic_cast<const PatchMembrane*>(own.get())) own = patches->softened(times);
}

}  // namespace furrow::physics
