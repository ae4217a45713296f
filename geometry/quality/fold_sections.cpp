// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/quality/fold_sections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double rows_in_width = 40, half_columns = 20;
constexpr double free_end = 1.6, most_of_line = 0.3;  ///< left out at an end, in widths, in lengths
constexpr double crest_reach = 0.25;                  ///< of the highest point from the line, in widths
constexpr double least_side = 0.1;                    ///< of cloth on either side of a crest, in widths
constexpr double direction_reach = 0.1,
                 normal_reach = 0.25;  ///< over which a row's frame is a mean, in widths
constexpr std::size_t rows_in_block = 16;
constexpr int pad = 2;  ///< rows beyond those that are nearest to the corners of a face

struct Row {
  Vec3 place, along, left = Vec3::Zero(), up = Vec3::Zero();
  double right_end = 0, left_end = 0;  ///< how far there is cloth on either side [m]
  double level = unset_value;          ///< of the feet over the curve [m]
};

struct RowBlock {
  Vec3 centre = Vec3::Zero();
  double reach = 0;
  std::size_t first, last;
};

/// Places at arc lengths of a curve.
class Course {
 public:
  explicit Course(const FoldCurve& curve) : curve_(curve) {}
  Vec3 at(double s) const {
    const std::size_t n = curve_.points.size();
    if (curve_.closed) s -= curve_.length * std::floor(s / curve_.length);
    s = std::clamp(s, 0.0, curve_.length);
    auto next = static_cast<std::size_t>(std::upper_bound(curve_.arc.begin(), curve_.arc.end(), s) -
                                         curve_.arc.begin());
    next = std::clamp<std::size_t>(next, 1, curve_.closed ? n : n - 1);
    const double from = curve_.arc[next - 1], to = next == n ? curve_.length : curve_.arc[next];
    const double t = to > from ? (s - from) / (to - from) : 0;
    return (1 - t) * curve_.points[next - 1] + t * curve_.points[next % n];
  }
  Vec3 direction_at(double s, double reach) const {
    const double a = curve_.closed ? s - reach : std::max(0.0, s - reach),
                 b = curve_.closed ? s + reach : std::min(curve_.length, s + reach);
    return (at(b) - at(a)).normalized();
  }

 private:
  const FoldCurve& curve_;
};

class Cutting {
 public:
  Cutting(const FoldSurface& surface, const FoldCurve& curve, bool crest_alone)
      : surface_(surface), curve_(curve), crest_alone_(crest_alone) {
    cut_.width = *std::max_element(curve.width.begin(), curve.width.end());
    cut_.closed = curve.closed;
    sign_ = curve.height[curve.height.size() / 2] < 0 ? -1 : 1;
    step_ = cut_.width / (2 * half_columns);
    for (int i = -half_columns; i <= half_columns; ++i) cut_.across.push_back(i * step_);
  }

  FoldSections cut() {
    place_rows();
    if (rows_.empty()) return std::move(cut_);
    make_blocks();
    find_nearest_rows();
    turn_rows();
    for (Face f : faces_) each_row_of(f, [&](std::size_t row) { note_level(row, f); });
    level_rows();
    clear();
    for (Face f : faces_) each_row_of(f, [&](std::size_t row) { cut_row(row, f); });
    drop_halves();
    return std::move(cut_);
  }

 private:
  void place_rows() {
    const double w = cut_.width, length = curve_.length;
    const double left_out = std::min(free_end * w, most_of_line * length);
    const double from = curve_.closed || curve_.begins_at_border ? 0 : left_out,
                 to = length - (curve_.closed || curve_.ends_at_border ? 0 : left_out);
    if (!(to > from)) return;
    const auto n = static_cast<std::size_t>(std::max(1.0, std::round((to - from) * rows_in_width / w)));
    const Course course(curve_);
    for (std::size_t i = 0; i < n + (curve_.closed ? 0 : 1); ++i) {
      const double s = from + (to - from) * static_cast<double>(i) / static_cast<double>(n);
      cut_.along.push_back(s);
      rows_.push_back({course.at(s), course.direction_at(s, direction_reach * w)});
    }
  }

  void make_blocks() {
    for (std::size_t first = 0; first < rows_.size(); first += rows_in_block) {
      RowBlock block{Vec3::Zero(), 0, first, std::min(first + rows_in_block, rows_.size())};
      for (std::size_t i = block.first; i < block.last; ++i)
        block.centre += rows_[i].place / static_cast<double>(block.last - block.first);
      for (std::size_t i = block.first; i < block.last; ++i)
        block.reach = std::max(block.reach, (rows_[i].place - block.centre).norm());
      blocks_.push_back(block);
    }
  }

  /// -1: farther than `far` from all.
  int nearest_row(const Vec3& x, double far) const {
    physics::throw_if_cancelled("cut_sections");
    int nearest = -1;
    double least = far * far;
    for (const RowBlock& block : blocks_) {
      const double reach = block.reach + std::sqrt(least);
      if ((x - block.centre).squaredNorm() > reach * reach) continue;
      for (std::size_t i = block.first; i < block.last; ++i)
        if (const double d = (x - rows_[i].place).squaredNorm(); d < least)
          least = d, nearest = static_cast<int>(i);
    }
    return nearest;
  }

  /// Of the vertices whose faces the rows may cut: half a width, and an edge.
  void find_nearest_rows() {
    const Mesh& mesh = *surface_.mesh;
    const double near = (crest_alone_ ? crest_reach : 0.5) * cut_.width;
    std::vector<char> is_near(mesh.num_vertices(), 0);
    nearest_.assign(mesh.num_vertices(), -1);
    for (Vertex v : mesh.vertices())
      if (surface_.has_foot(v)) {
        nearest_[v.idx()] = nearest_row(surface_.feet[v.idx()], near);
        is_near[v.idx()] = nearest_[v.idx()] >= 0;
      }
    for (Face f : mesh.faces()) take_if_near(f, is_near, near);
  }

  void take_if_near(Face f, const std::vector<char>& is_near, double near) {
    const auto c = corners_of(*surface_.mesh, f);
    for (Vertex v : c)
      if (!surface_.has_foot(v)) return;
    double size = 0;  // of a face that is larger than the fold, no corner need be near
    for (int i = 0; i < 3; ++i) size = std::max(size, (foot(c[i]) - foot(c[(i + 1) % 3])).norm());
    const bool is_large = size > near;
    bool any = false;
    for (Vertex v : c) any = any || is_near[v.idx()];
    if (!any && !is_large) return;
    for (Vertex v : c)
      if (nearest_[v.idx()] < 0) nearest_[v.idx()] = nearest_row(foot(v), near + 2 * size);
    for (Vertex v : c)
      if (nearest_[v.idx()] < 0) return;
    faces_.push_back(f);
  }

  const Vec3& foot(Vertex v) const { return surface_.feet[v.idx()]; }

  Vec3 foot_normal(const std::array<Vertex, 3>& c) const {
    return (foot(c[1]) - foot(c[0])).cross(foot(c[2]) - foot(c[0]));
  }

  /// By row: sums of the normals of feet whose corners are nearest to it and not farther than `far`.
  std::vector<Vec3> normal_sums(double far) const {
    std::vector<Vec3> sums(rows_.size(), Vec3::Zero());
    for (Face f : faces_) {
      const auto c = corners_of(*surface_.mesh, f);
      for (Vertex v : c)
        if ((foot(v) - rows_[nearest_[v.idx()]].place).norm() < far)
          sums[nearest_[v.idx()]] += foot_normal(c);
    }
    return sums;
  }

  Vec3 sum_around(const std::vector<Vec3>& sums, int row, int reach) const {
    const auto n = static_cast<int>(sums.size());
    Vec3 sum = Vec3::Zero();
    for (int j = row - reach; j <= row + reach; ++j)
      if (curve_.closed || (j >= 0 && j < n)) sum += sums[(j % n + n) % n];
    return sum;
  }

  /// Upwards is the mean normal of the feet around a row; of a coarse cloth those that are nearest.
  void turn_rows() {
    const auto n = static_cast<int>(rows_.size());
    const std::vector<Vec3> near = normal_sums(normal_reach * cut_.width),
                            all = normal_sums(std::numeric_limits<double>::infinity());
    for (int i = 0; i < n; ++i) {
      Row& row = rows_[i];
      int reach = std::max(1, static_cast<int>(normal_reach * rows_in_width));
      row.up = sum_around(near, i, reach);
      for (; row.up.norm() == 0 && reach < 2 * n; reach *= 2) row.up = sum_around(all, i, reach);
      row.left = row.up.cross(row.along).normalized();
      row.up = row.along.cross(row.left);
    }
  }

  void clear() {
    const std::size_t n = rows_.size();
    cut_.crest.assign(n, unset_value);
    cut_.beside.assign(n, unset_value);
    cut_.highest.assign(n, Vec3::Constant(unset_value));
    if (crest_alone_) return;
    cut_.heights.assign(n * cut_.across.size(), unset_value);
    cut_.normals.assign(n * cut_.across.size(), Vec3::Constant(unset_value));
  }

  /// Calls with the rows that may cut a face.
  template <class Call>
  void each_row_of(Face f, const Call& call) const {
    physics::throw_if_cancelled("cut_sections");
    const auto c = corners_of(*surface_.mesh, f);
    const auto n = static_cast<int>(rows_.size());
    int first = n, last = -1;
    for (Vertex v : c) first = std::min(first, nearest_[v.idx()]), last = std::max(last, nearest_[v.idx()]);
    if (curve_.closed && last - first > n / 2) {  // over the place where the rows begin
      first = 2 * n, last = -1;
      for (Vertex v : c) {
        const int row = nearest_[v.idx()] + (nearest_[v.idx()] < n / 2 ? n : 0);
        first = std::min(first, row), last = std::max(last, row);
      }
    }
    for (int i = first - pad; i <= last + pad; ++i)
      if (curve_.closed || (i >= 0 && i < n)) call(static_cast<std::size_t>((i % n + n) % n));
  }

  struct CutPoint {
    Vec3 place;
    double height;
  };

  /// Where a row's plane leaves a face, if it cuts it.
  bool ends_of_cut(std::size_t row, Face f, CutPoint (&ends)[2]) const {
    const auto c = corners_of(*surface_.mesh, f);
    const Row& r = rows_[row];
    if (foot_normal(c).dot(r.up) < 0) return false;  // of another layer
    double side[3];
    for (int i = 0; i < 3; ++i) side[i] = r.along.dot(foot(c[i]) - r.place);
    int found = 0;
    for (int i = 0; i < 3 && found < 2; ++i) {
      const int j = (i + 1) % 3;
      if ((side[i] < 0) == (side[j] < 0)) continue;
      const double t = side[i] / (side[i] - side[j]);
      ends[found++] = {(1 - t) * foot(c[i]) + t * foot(c[j]),
                       (1 - t) * surface_.heights[c[i].idx()] + t * surface_.heights[c[j].idx()]};
    }
    return found == 2;
  }

  /// How far the feet lie above the curve, which may run on the facets below a curved surface.
  void note_level(std::size_t row, Face f) {
    CutPoint ends[2];
    if (!ends_of_cut(row, f, ends)) return;
    Row& r = rows_[row];
    const Vec3 a = ends[0].place - r.place, b = ends[1].place - r.place;
    const double left = a.dot(r.left), right = b.dot(r.left);
    if (left * right > 0) return;
    const double t = left != right ? left / (left - right) : 0;
    const double level = (1 - t) * a.dot(r.up) + t * b.dot(r.up);
    if (std::isnan(r.level) || std::abs(level) < std::abs(r.level)) r.level = level;
  }

  void level_rows() {
    for (Row& row : rows_)
      if (!std::isnan(row.level)) row.place += row.level * row.up;
    for (const Row& row : rows_) cut_.up.push_back(row.up);
  }

  double distance(const Row& row, const Vec3& p) const {
    const Vec3 off = p - row.place;
    return std::copysign(off.norm(), off.dot(row.left));
  }

  void cut_row(std::size_t row, Face f) {
    CutPoint ends[2];
    if (!ends_of_cut(row, f, ends)) return;
    double distances[2];
    for (int i : {0, 1}) {
      distances[i] = distance(rows_[row], ends[i].place);
      note_crest(row, ends[i], distances[i]);
      rows_[row].right_end = std::min(rows_[row].right_end, distances[i]);
      rows_[row].left_end = std::max(rows_[row].left_end, distances[i]);
    }
    if (crest_alone_) return;
    const bool in_order = distances[0] <= distances[1];
    note_heights(row, {distances[in_order ? 0 : 1], ends[in_order ? 0 : 1].height},
                 {distances[in_order ? 1 : 0], ends[in_order ? 1 : 0].height}, f);
  }

  /// Where a line meets a hem, a section may have cloth on one side of it alone: its highest point is no
  /// crest, unless all along the line it is so, as for a line along a hem.
  void drop_halves() {
    const auto is_half = [&](const Row& row) {
      const double least = least_side * cut_.width;
      return row.right_end > -least || row.left_end < least;
    };
    const auto n = static_cast<std::size_t>(std::count_if(rows_.begin(), rows_.end(), is_half));
    for (std::size_t i = 0; 2 * n < rows_.size() && i < rows_.size(); ++i)
      if (is_half(rows_[i])) cut_.crest[i] = unset_value;
  }

  void note_crest(std::size_t row, const CutPoint& p, double distance) {
    if (!(std::abs(distance) <= crest_reach * cut_.width)) return;
    double& crest = cut_.crest[row];
    const bool higher = std::isnan(crest) || sign_ * p.height > sign_ * crest ||
                        (p.height == crest && std::abs(distance) < std::abs(cut_.beside[row]));
    if (!higher) return;
    crest = p.height;
    cut_.beside[row] = distance;
    cut_.highest[row] = p.place;
  }

  using Sample = std::array<double, 2>;  ///< distance, height

  /// Whether a value goes before the one that is there: the higher one; of equal ones, as where two faces
  /// meet, that of the normal that comes first, so that the order of faces does not matter.
  bool goes_before(std::size_t at, double height, const Vec3& normal) const {
    const double there = cut_.heights[at], off = sign_ * (height - there);
    if (std::isnan(there)) return true;
    if (std::abs(off) > 1e-9 * cut_.width) return off > 0;
    const Vec3& other = cut_.normals[at];
    for (int i : {1, 0})
      if (std::abs(normal[i] - other[i]) > 1e-9) return normal[i] < other[i];
    return false;
  }

  void note_heights(std::size_t row, const Sample& a, const Sample& b, Face f) {
    const auto last = static_cast<int>(cut_.across.size()) - 1;
    const int from = std::max(0, static_cast<int>(std::ceil(a[0] / step_ + half_columns))),
              to = std::min(last, static_cast<int>(std::floor(b[0] / step_ + half_columns)));
    if (from > to) return;
    const Vector n = normalized(area_normal_of(*surface_.mesh, f));
    const Vec3 spatial(n.x(), n.y(), n.z());
    const Row& r = rows_[row];
    const Vec3 normal(spatial.dot(r.along), spatial.dot(r.left), spatial.dot(r.up));
    for (int column = from; column <= to; ++column) {
      const double span = b[0] - a[0], t = span > 0 ? (cut_.across[column] - a[0]) / span : 0;
      const double height = (1 - t) * a[1] + t * b[1];
      const std::size_t at = cut_.at(row, column);
      if (!goes_before(at, height, normal)) continue;
      cut_.heights[at] = height;
      cut_.normals[at] = normal;
    }
  }

  const FoldSurface& surface_;
  const FoldCurve& curve_;
  const bool crest_alone_;
  double sign_ = 1, step_ = 0;
  FoldSections cut_;
  std::vector<Row> rows_;
  std::vector<RowBlock> blocks_;
  std::vector<int> nearest_;  ///< row of each vertex; -1: far
  std::vector<Face> faces_;
};

}  // namespace

FoldSections cut_sections(const FoldSurface& surface, const FoldCurve& curve, bool crest_alone) {
  return Cutting(surface, curve, crest_alone).cut();
}

}  // namespace furrow::geometry
