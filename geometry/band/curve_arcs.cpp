// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/curve_arcs.h"

#include <algorithm>

namespace furrow::geometry {
namespace {

constexpr double same_cut = 1e-9;  ///< of a curve's length

/// Points `from` to `to` of a curve, counted on beyond the last one if it is closed.
FoldCurve arc_between(const FoldCurve& whole, std::size_t from, std::size_t to) {
  FoldCurve arc = whole;
  const std::size_t n = whole.points.size();
  arc.points.clear(), arc.places.clear(), arc.arc.clear(), arc.width.clear(), arc.height.clear();
  for (std::size_t k = from; k <= to; ++k) {
    const std::size_t i = k % n;
    arc.points.push_back(whole.points[i]);
    arc.places.push_back(whole.places[i]);
    arc.arc.push_back(whole.arc[i] + (k >= n ? whole.length : 0) - whole.arc[from]);
    arc.width.push_back(whole.width[i]);
    arc.height.push_back(whole.height[i]);
  }
  arc.length = arc.arc.back();
  arc.closed = false;
  arc.cuts.clear();
  arc.begins_at_border = whole.begins_at_border && from == 0;
  arc.ends_at_border = whole.ends_at_border && to + 1 == n;
  return arc;
}

}  // namespace

CurveArcs::CurveArcs(std::span<const FoldCurve> curves) {
  for (std::size_t i = 0; i < curves.size(); ++i) {
    length.push_back(curves[i].length);
    closed.push_back(curves[i].closed);
    cut(curves[i], i);
  }
}

void CurveArcs::cut(const FoldCurve& whole, std::size_t index) {
  if (whole.cuts.empty()) {
    arcs.push_back(whole), curve.push_back(index), begin.push_back(0);
    return;
  }
  std::vector<std::size_t> ends = whole.cuts;
  if (whole.closed) {
    ends.push_back(ends.front());
  } else {
    ends.insert(ends.begin(), 0);
    ends.push_back(whole.points.size() - 1);
  }
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const std::size_t to = ends[k + 1] > ends[k] ? ends[k + 1] : ends[k + 1] + whole.points.size();
    arcs.push_back(arc_between(whole, ends[k], to));
    curve.push_back(index);
    begin.push_back(whole.arc[ends[k]]);
  }
}

int CurveArcs::neighbour(std::size_t arc, bool next) const {
  const auto range = std::equal_range(curve.begin(), curve.end(), curve[arc]);
  const auto first = static_cast<std::size_t>(range.first - curve.begin()),
             end = static_cast<std::size_t>(range.second - curve.begin());
  if (arcs[arc].closed) return -1;
  if (next && arc + 1 < end) return static_cast<int>(arc + 1);
  if (!next && arc > first) return static_cast<int>(arc - 1);
  if (!closed[curve[arc]]) return -1;
  return static_cast<int>(next ? first : end - 1);
}

std::vector<std::pair<double, Vertex>> CurveArcs::joined(
    std::size_t of, const std::vector<const std::map<double, Vertex>*>& on) const {
  std::vector<std::pair<double, Vertex>> result;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (curve[i] != of) continue;
    const bool goes_on = after(i) >= 0;
    for (const auto& [along, v] : *on[i]) {
      if (goes_on && v == on[i]->rbegin()->second) continue;  // the next arc begins with it
      const double there = begin[i] + along;
      result.push_back({closed[of] && there >= length[of] ? there - length[of] : there, v});
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return result;
}

std::map<double, Vertex> CurveArcs::part(std::size_t arc, std::span<const double> along,
                                         std::span<const Vertex> vertices) const {
  std::map<double, Vertex> result;
  const double whole = length[curve[arc]], slack = same_cut * whole;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (before(arc) < 0 && after(arc) < 0) {
      result[along[k]] = vertices[k];
      continue;
    }
    double there = along[k] - begin[arc];
    if (closed[curve[arc]] && there < -slack) there += whole;
    if (closed[curve[arc]] && there > whole - slack) there -= whole;
    if (there > -slack && there < arcs[arc].length + slack)
      result[std::clamp(there, 0.0, arcs[arc].length)] = vertices[k];
  }
  return result;
}

}  // namespace furrow::geometry
