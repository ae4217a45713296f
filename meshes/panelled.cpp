// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/panelled.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace furrow::meshes {
namespace {

constexpr int gores = 6, rows = 28;
// Waist and hem radius and the length along the cloth between them [m].
constexpr double waist = 0.13, hem_line = 0.32, gore_length = 0.60, hem_height = 0.45;
constexpr double sine = (hem_line - waist) / gore_length;  // of half the cone's opening
constexpr double gore_angle = 2 * std::numbers::pi / gores;
constexpr double spacing = 0.022;  // aimed at between vertices [m]
constexpr double margin = 0.02;    // of the unit square

double radius_of(int row) { return hem_line + (waist - hem_line) * row / rows; }
/// Columns of a gore in a row, so that the edges are about as long as the rows are apart.
int columns_of(int row) {
  return std::max(3, static_cast<int>(std::lround(gore_angle * radius_of(row) / spacing)));
}

/// The point of the cone at `angle` from the front [rad] and `down` the cloth from the waist [m].
std::array<double, 3> on_cone(double angle, double down) {
  const double radius = waist + sine * down;
  return {radius * std::sin(angle), hem_height + std::sqrt(1 - sine * sine) * (gore_length - down),
          radius * std::cos(angle)};
}

/// The same point in the flat gore, from the middle of its hem [m]; angle from the gore's middle.
std::array<double, 2> in_pattern(double angle, double down) {
  const double from_apex = waist / sine + down, hem = waist / sine + gore_length;
  return {from_apex * std::sin(angle * sine), hem - from_apex * std::cos(angle * sine)};
}

/// Texture coordinates: three gores in each of two rows of charts.
std::array<double, 2> in_chart(int gore, const std::array<double, 2>& p) {
  const double width = 2 * in_pattern(gore_angle / 2, gore_length)[0],
               height = in_pattern(gore_angle / 2, 0)[1];
  const double scale = std::min((1 - 4 * margin) / (3 * width), (1 - 3 * margin) / (2 * height));
  const double u = margin + (gore % 3 + 0.5) * (width * scale + margin) - margin / 2;
  const double v = margin + (gore / 3) * (height * scale + margin);
  return {u + scale * p[0], v + scale * p[1]};
}

std::string line(const char* format, double a, double b, double c = 0) {
  char text[96];
  std::snprintf(text, sizeof text, format, a + 0.0, b + 0.0, c + 0.0);
  return text;
}

/// Numbers from 1, as OBJ counts: vertices are shared along the seams, texture coordinates are not.
class Skirt {
 public:
  Skirt() {
    for (int row = 0; row <= rows; ++row) {
      first_vertex_.push_back(first_vertex_.back() + gores * (row ? columns_of(row - 1) : 0));
      first_texture_.push_back(first_texture_.back() + (row ? columns_of(row - 1) + 1 : 0));
    }
    textures_ = first_texture_.back() + columns_of(rows);
  }

  std::string text() const {
    std::string out = "# skirt of six gores, flat charts; metres, y up, made by make_meshes\n";
    for (int row = 0; row <= rows; ++row)
      for (int i = 0; i < gores * columns_of(row); ++i) {
        const auto p = on_cone((double(i) / columns_of(row) - 0.5) * gore_angle, down(row));
        out += line("v %.6f %.6f %.6f\n", p[0], p[1], p[2]);
      }
    for (int gore = 0; gore < gores; ++gore)
      for (int row = 0; row <= rows; ++row)
        for (int i = 0; i <= columns_of(row); ++i) {
          const auto t =
              in_chart(gore, in_pattern((double(i) / columns_of(row) - 0.5) * gore_angle, down(row)));
          out += line("vt %.7f %.7f\n", t[0], t[1]);
        }
    for (int gore = 0; gore < gores; ++gore) {
      out += "g gore_" + std::to_string(gore + 1) + "\nusemtl " + (gore % 2 ? "cotton_b" : "cotton_a") + "\n";
      for (int row = 0; row < rows; ++row) append_strip(out, gore, row);
    }
    return out;
  }

 private:
  static double down(int row) { return gore_length * (rows - row) / rows; }

  std::string corner(int gore, int row, int i) const {
    const int around = (gore * columns_of(row) + i) % (gores * columns_of(row));
    return " " + std::to_string(first_vertex_[row + 1] + around) + "/" +
           std::to_string(gore * textures_ + first_texture_[row + 1] + i);
  }

  /// The triangles of a gore between a row and the one above it, which may have fewer columns.
  void append_strip(std::string& out, int gore, int row) const {
    const int below = columns_of(row), above = columns_of(row + 1);
    for (int a = 0, b = 0; a < below || b < above;) {
      const int next_below = (a + 1) * above, next_above = (b + 1) * below;
      const bool step_below =
          b == above || (a < below && (next_below < next_above || (next_below == next_above && row % 2)));
      out += "f" + corner(gore, row, a) +
             (step_below ? corner(gore, row, a + 1) : corner(gore, row + 1, b + 1)) +
             corner(gore, row + 1, b) + "\n";
      ++(step_below ? a : b);
    }
  }

  std::vector<int> first_vertex_{1}, first_texture_{1};
  int textures_;
};

/// Points of a line from (angle [degrees], down [m]) to another on the cone, every 4 mm or so.
nlohmann::json path(double angle0, double down0, double angle1, double down1, double wave = 0) {
  const auto a = on_cone(angle0 * std::numbers::pi / 180, down0);
  const auto b = on_cone(angle1 * std::numbers::pi / 180, down1);
  const double turn = std::abs(angle1 - angle0) * std::numbers::pi / 180 * hem_line;
  const double length = std::max(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), turn);
  const int n = static_cast<int>(std::ceil(length / 0.004));
  nlohmann::json points = nlohmann::json::array();
  for (int i = 0; i <= n; ++i) {
    const double t = double(i) / n;
    const auto p = on_cone((angle0 + t * (angle1 - angle0)) * std::numbers::pi / 180,
                           down0 + t * (down1 - down0) + wave * std::sin(12 * std::numbers::pi * t));
    nlohmann::json point = nlohmann::json::array();
    for (double x : p) point.push_back(std::round(x * 1e5) / 1e5 + 0.0);
    points.push_back(point);
  }
  return points;
}

}  // namespace

std::string panelled_obj() { return Skirt().text(); }

nlohmann::json panelled_strokes() {
  nlohmann::json around = path(-180, 0.45, 180, 0.45, 0.02);
  around.erase(around.size() - 1);  // the first point again
  return {{{"name", "across the front seams"}, {"height", 0.012}, {"points", path(-55, 0.10, 55, 0.30)}},
          {{"name", "shallow over a seam"}, {"height", 0.012}, {"points", path(24, 0.32, 36, 0.42)}},
          {{"name", "along a seam"}, {"height", -0.010}, {"points", path(-30, 0.22, -30, 0.40)}},
          {{"name", "all around"}, {"height", 0.015}, {"closed", true}, {"points", around}},
          {{"name", "back"}, {"height", -0.012}, {"points", path(120, 0.08, 200, 0.36)}},
          {{"name", "over the hem"}, {"height", 0.015}, {"points", path(100, 0.48, 85, 0.598)}}};
}

}  // namespace furrow::meshes
