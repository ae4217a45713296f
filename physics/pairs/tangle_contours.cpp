// SPDX-License-Identifier: MIT
#include "physics/pairs/tangle_contours.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

namespace furrow::physics {
namespace {

constexpr double flattest = 0.1;  // |E.N| of a crossing

/// Two triangles that cross, the smaller number first, and a crossing of an edge of one with the other.
struct TriangleMeeting {
  int first, second, crossing;
  auto operator<=>(const TriangleMeeting&) const = default;
};

class ContourChains {
 public:
  ContourChains(const PairMesh& mesh, std::span<const Vec3> x, std::span<const EdgeFaceCrossing> crossings,
                std::span<const std::array<int, 2>> triangles_of_edge)
      : mesh_(mesh), x_(x), all_(crossings.size()), links_(crossings.size()), toward_(crossings.size()) {
    for (std::size_t i = 0; i < crossings.size(); ++i) all_[i] = placed(crossings[i]);
    link(meetings(crossings, triangles_of_edge));
  }

  std::vector<TangleContour> contours() {
    std::vector<TangleContour> found;
    std::vector<char> known(all_.size(), 0);
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (!known[i]) found.push_back(contour_from(int(i), known));
    return found;
  }

 private:
  struct Link {
    int to;
    bool same_side;
  };

  const Vec3& at(int v) const { return x_[std::size_t(v)]; }
  const std::array<int, 3>& triangle(int t) const { return mesh_.triangles[std::size_t(t)]; }

  Vec3 edge_of(const EdgeFaceCrossing& c) const {
    const auto& e = mesh_.edges[std::size_t(c.edge)];
    return at(e[1]) - at(e[0]);
  }

  ContourCrossing placed(const EdgeFaceCrossing& c) const {
    const auto& t = triangle(c.triangle);
    const Vec3 edge = edge_of(c), start = at(mesh_.edges[std::size_t(c.edge)][0]);
    const Vec3 area = (at(t[1]) - at(t[0])).eval().cross((at(t[2]) - at(t[0])).eval());
    const double length = area.norm();
    ContourCrossing result{c};
    result.normal = length > 0 ? Vec3(area / length) : Vec3::Zero();
    const double along = edge.dot(result.normal);
    const double share = along != 0 ? (at(t[0]) - start).dot(result.normal) / along : 0.5;
    result.at = start + std::clamp(share, 0.0, 1.0) * edge;
    return result;
  }

  static std::vector<TriangleMeeting> meetings(std::span<const EdgeFaceCrossing> crossings,
                                               std::span<const std::array<int, 2>> triangles_of_edge) {
    std::vector<TriangleMeeting> found;
    for (std::size_t i = 0; i < crossings.size(); ++i)
      for (const int t : triangles_of_edge[std::size_t(crossings[i].edge)])
        if (t >= 0)
          found.push_back({std::min(t, crossings[i].triangle), std::max(t, crossings[i].triangle), int(i)});
    std::sort(found.begin(), found.end());
    return found;
  }

  void link(const std::vector<TriangleMeeting>& meetings) {
    for (std::size_t i = 0; i < meetings.size();) {
      std::size_t end = i + 1;
      while (end < meetings.size() && meetings[end].first == meetings[i].first &&
             meetings[end].second == meetings[i].second)
        ++end;
      if (end == i + 1) end_at_shared_vertex(meetings[i]);
      for (std::size_t k = i + 1; k < end; ++k) link(meetings[k - 1].crossing, meetings[k].crossing);
      i = end;
    }
  }

  void link(int a, int b) {
    ContourCrossing &one = all_[std::size_t(a)], &other = all_[std::size_t(b)];
    const bool same = one.crossing.triangle == other.crossing.triangle;
    links_[std::size_t(a)].push_back({b, same});
    links_[std::size_t(b)].push_back({a, same});
    const Vec3 between = other.at - one.at;
    add_toward(a, between, 0.5);
    add_toward(b, -between, 0.5);
  }

  /// Where triangles share a vertex, the contour ends there.
  void end_at_shared_vertex(const TriangleMeeting& m) {
    for (const int v : triangle(m.first))
      for (const int w : triangle(m.second))
        if (v == w) add_toward(m.crossing, at(v) - all_[std::size_t(m.crossing)].at, 1);
  }

  void add_toward(int crossing, const Vec3& way, double share) {
    Toward& t = toward_[std::size_t(crossing)];
    const double length = way.norm();
    t.length += share * length;
    if (length > 0) t.directions += way / length;
  }

  TangleContour contour_from(int first, std::vector<char>& known) {
    std::vector<int> members{first};
    known[std::size_t(first)] = 1;
    for (std::size_t next = 0; next < members.size(); ++next) {
      const auto member = std::size_t(members[next]);
      for (const Link& l : links_[member]) {
        if (known[std::size_t(l.to)]) continue;
        known[std::size_t(l.to)] = 1;
        all_[std::size_t(l.to)].side = l.same_side ? all_[member].side : 1 - all_[member].side;
        members.push_back(l.to);
      }
    }
    std::sort(members.begin(), members.end());
    TangleContour contour;
    for (const int m : members) {
      ContourCrossing& c = all_[std::size_t(m)];
      const Toward& t = toward_[std::size_t(m)];
      c.shortening = shortening(c, t.directions);
      contour.length += t.length;
      contour.crossings.push_back(c);
    }
    return contour;
  }

  Vec3 shortening(const ContourCrossing& c, const Vec3& r) const {
    const Vec3 e = edge_of(c.crossing).normalized();
    double across = e.dot(c.normal);
    if (std::abs(across) < flattest) across = across < 0 ? -flattest : flattest;
    return r - 2 * e.dot(r) / across * c.normal;  // R - 2 (E.R) / (E.N) N
  }

  struct Toward {
    Vec3 directions = Vec3::Zero();
    double length = 0;
  };

  const PairMesh& mesh_;
  std::span<const Vec3> x_;
  std::vector<ContourCrossing> all_;
  std::vector<std::vector<Link>> links_;
  std::vector<Toward> toward_;
};

}  // namespace

Vec3 TangleContour::middle() const {
  Vec3 sum = Vec3::Zero();
  for (const ContourCrossing& c : crossings) sum += c.at;
  return sum / double(std::max<std::size_t>(1, crossings.size()));
}

std::vector<std::array<int, 2>> triangles_of_edges(const PairMesh& mesh) {
  std::vector<std::array<int, 2>> found(mesh.edges.size(), {-1, -1});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      auto& of = found[std::size_t(mesh.triangle_edges[t][i])];
      (of[0] < 0 ? of[0] : of[1]) = int(t);
    }
  return found;
}

std::vector<TangleContour> tangle_contours(const PairMesh& mesh, std::span<const Vec3> x,
                                           std::span<const EdgeFaceCrossing> crossings,
                                           std::span<const std::array<int, 2>> triangles_of_edge) {
  return ContourChains(mesh, x, crossings, triangles_of_edge).contours();
}

}  // namespace furrow::physics
