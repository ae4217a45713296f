// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/mesh.h"
#include "io/base/nearest_word.h"
#include "io/stroke/stroke_file.h"

namespace furrow::io {
namespace {

double length_of(const std::vector<std::array<double, 2>>& points, bool closed) {
  double sum = 0;
  for (std::size_t i = closed ? 0 : 1; i < points.size(); ++i) {
    const auto &a = points[i > 0 ? i - 1 : points.size() - 1], &b = points[i];
    sum += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  return sum;
}

double length_of(const geometry::Stroke& stroke) {
  double sum = 0;
  const std::vector<geometry::Point> p(stroke.points.begin(), stroke.points.end());
  for (std::size_t i = stroke.closed ? 0 : 1; i < p.size(); ++i)
    if (!std::binary_search(stroke.breaks.begin(), stroke.breaks.end(), i))
      sum += std::sqrt(CGAL::squared_distance(p[i > 0 ? i - 1 : p.size() - 1], p[i]));
  return sum;
}

}  // namespace

const char* kind_of(const DrawnStroke& stroke) {
  constexpr std::array<const char*, 4> kinds{"points", "pixels", "texture", "vertices"};
  return kinds[stroke.on.index()];
}

const char* unit_of(const DrawnStroke& stroke) {
  constexpr std::array<const char*, 4> units{"m", "pixels", "texture", ""};
  return units[stroke.on.index()];
}

double drawn_length(const DrawnStroke& stroke) {
  if (const auto* drawn = std::get_if<PictureStroke>(&stroke.on))
    return length_of(drawn->pixels, stroke.stroke.closed);
  if (const auto* drawn = std::get_if<TextureStroke>(&stroke.on))
    return length_of(drawn->points, stroke.stroke.closed);
  return std::holds_alternative<VertexStroke>(stroke.on) ? std::numeric_limits<double>::quiet_NaN()
                                                         : length_of(stroke.stroke);
}

std::size_t find_stroke(std::span<const DrawnStroke> strokes, const std::string& name) {
  std::vector<std::string> names;
  for (const DrawnStroke& s : strokes) names.push_back(s.stroke.name);
  const auto count = std::count(names.begin(), names.end(), name);
  if (count > 1)
    throw geometry::ContentError(std::to_string(count) + " strokes are named '" + name +
                                 "'; give each a name of its own");
  if (count == 1) return std::find(names.begin(), names.end(), name) - names.begin();
  throw geometry::ContentError("there is no stroke '" + name + "'" +
                               (names.empty() ? "" : "; did you mean '" + nearest_word(name, names) + "'?"));
}

void order_strokes(std::vector<DrawnStroke>& strokes, std::span<const std::string> names) {
  std::vector<std::size_t> order;
  for (const std::string& name : names) {
    order.push_back(find_stroke(strokes, name));
    if (std::count(order.begin(), order.end(), order.back()) > 1)
      throw geometry::ContentError("the order names the stroke '" + name + "' twice");
  }
  for (std::size_t i = 0; i < strokes.size(); ++i)
    if (std::find(order.begin(), order.end(), i) == order.end()) order.push_back(i);
  std::vector<DrawnStroke> ordered;
  for (const std::size_t i : order) ordered.push_back(std::move(strokes[i]));
  strokes = std::move(ordered);
}

void move_stroke(DrawnStroke& stroke, std::span<const double> by) {
  const std::string who = "stroke '" + stroke.stroke.name + "' ";
  if (std::holds_alternative<VertexStroke>(stroke.on))
    throw std::invalid_argument(who + "runs between vertices and cannot be moved; name other vertices");
  const bool in_space = std::holds_alternative<std::monostate>(stroke.on);
  if (by.size() != (in_space ? 3 : 2))
    throw std::invalid_argument(
        who + (in_space ? "lies in space: it is moved by dx,dy,dz [m]"
                        : std::string("is drawn in ") + kind_of(stroke) + ": it is moved by two numbers"));
  if (!std::all_of(by.begin(), by.end(), [](double x) { return std::isfinite(x); }))
    throw std::invalid_argument(who + "cannot be moved by what is not finite");
  const auto shift = [&](auto& points) {
    for (auto& p : points) p = {p[0] + by[0], p[1] + by[1]};
  };
  if (auto* drawn = std::get_if<PictureStroke>(&stroke.on)) shift(drawn->pixels);
  if (auto* drawn = std::get_if<TextureStroke>(&stroke.on)) shift(drawn->points);
  if (in_space)
    for (auto& p : stroke.stroke.points) p = {p.x() + by[0], p.y() + by[1], p.z() + by[2]};
}

}  // namespace furrow::io
