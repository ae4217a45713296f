// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace furrow::geometry {

std::vector<StrokeSegment> stroke_path(const TracedStroke& traced) {
  std::vector<StrokeSegment> path;
  const auto& samples = traced.samples;
  std::map<Face, std::pair<std::size_t, std::size_t>> in_face;  // first and last sample
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto [at, is_new] = in_face.try_emplace(samples[i].point.face, i, i);
    at->second.second = i;
    const ProjectedSample& before = samples[i > 0 ? i - 1 : 0];
    const bool follows = before.index + 1 == samples[i].index && before.point.face == samples[i].point.face;
    path.push_back({follows ? before.position : samples[i].position, samples[i].position});
  }
  for (const SubStroke& part : traced.sub_strokes)
    for (const CrossedFace& visit : part.faces) {
      const auto inside = in_face.find(visit.face);
      if (visit.entry && visit.exit)
        path.push_back({visit.entry->position, visit.exit->position});
      else if (visit.exit && inside != in_face.end())
        path.push_back({samples[inside->second.first].position, visit.exit->position});
      else if (visit.entry && inside != in_face.end())
        path.push_back({visit.entry->position, samples[inside->second.second].position});
    }
  return path;
}

double distance_to(std::span<const StrokeSegment> path, const Point& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : path) {
    const Vector along = b - a;
    const double length2 = along.squared_length();
    const double t = length2 > 0 ? std::clamp((p - a) * along / length2, 0.0, 1.0) : 0;
    least = std::min(least, (p - (a + t * along)).squared_length());
  }
  return std::sqrt(least);
}

}  // namespace furrow::geometry
