// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/fit_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "geometry/mesh/property_names.h"
#include "io/picture/stroke_font.h"

namespace furrow::io {
namespace {

using Ramp = std::array<Colour, 6>;

// Lightness 0.93, 0.83, 0.73, 0.62, 0.52, 0.42 (OKLab, B. Ottosson 2020), hues of our own choice.
constexpr Ramp stretched{{{0.923f, 0.907f, 0.881f},
                          {0.918f, 0.750f, 0.520f},
                          {0.921f, 0.557f, 0.206f},
                          {0.873f, 0.321f, 0.020f},
                          {0.759f, 0.105f, 0.049f},
                          {0.580f, 0.008f, 0.052f}}};
constexpr Ramp pressed{{{0.923f, 0.907f, 0.881f},
                        {0.645f, 0.805f, 0.921f},
                        {0.438f, 0.684f, 0.889f},
                        {0.254f, 0.542f, 0.819f},
                        {0.152f, 0.411f, 0.718f},
                        {0.063f, 0.288f, 0.593f}}};
// Lightness 0.30, 0.42, 0.54, 0.66, 0.78, 0.91.
constexpr Ramp distant{{{0.217f, 0.106f, 0.359f},
                        {0.238f, 0.272f, 0.533f},
                        {0.178f, 0.461f, 0.638f},
                        {0.096f, 0.656f, 0.632f},
                        {0.522f, 0.804f, 0.460f},
                        {0.942f, 0.904f, 0.396f}}};
constexpr Colour unknown{0.55f, 0.55f, 0.55f}, paper{1, 1, 1}, ink{0.15f, 0.16f, 0.18f};

void check(const FitScale& scale) {
  if (!(scale.limit > 0 && std::isfinite(scale.limit)))
    throw std::invalid_argument("fit colours: limit = " + std::to_string(scale.limit) +
                                " is not finite and > 0");
  if (!(scale.mark >= 0 && scale.mark <= scale.limit))
    throw std::invalid_argument("fit colours: mark = " + std::to_string(scale.mark) +
                                " is not in [0, limit]");
}

/// `at` in [0, 1].
Colour blend(const Ramp& ramp, double at) {
  const double place = at * double(ramp.size() - 1);
  const std::size_t i = std::min(std::size_t(place), ramp.size() - 2);
  const float t = float(place - double(i));
  Colour c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = (1 - t) * ramp[i][k] + t * ramp[i + 1][k];
  return c;
}

double lowest(const FitScale& scale) { return scale.quantity == FitQuantity::strain ? -scale.limit : 0; }

/// A number as the legend writes it: strain in per cent, distance in millimetres.
std::string number(double value, const FitScale& scale) {
  char text[32];
  const double shown = value * (scale.quantity == FitQuantity::strain ? 100 : 1000);
  std::snprintf(text, sizeof text, "%.3g", shown == 0 ? 0.0 : shown);
  return (scale.quantity == FitQuantity::strain && shown > 0 ? "+" : "") + std::string(text);
}

/// Where things stand in the part below the picture [pixels].
struct Layout {
  double text;                   ///< height of capitals
  int left, right, top, bottom;  ///< of the bar
  int height;                    ///< of the whole part
  double column(double value, const FitScale& scale) const {
    return left + (right - left) * (value - lowest(scale)) / (scale.limit - lowest(scale));
  }
};

Layout layout_of(const Image& picture, bool words) {
  Layout l{};
  l.text = std::max(6.0, std::min(0.0155 * std::min(1.0 * picture.width, 1.2 * picture.height), 22.0));
  const double line = 2.1 * l.text;
  const int half = int(std::min(0.38 * picture.width, 26 * l.text));
  l.left = picture.width / 2 - half;
  l.right = picture.width / 2 + half;
  l.top = int(std::lround((words ? 2 : 1) * line + 0.7 * l.text));
  l.bottom = l.top + int(std::lround(1.6 * l.text));
  l.height = l.bottom + int(std::lround(2 * line + 0.8 * l.text));
  return l;
}

void fill(Image& image, int x, int y0, int y1, const Colour& colour) {
  if (x < 0 || x >= image.width) return;
  for (int y = std::max(0, y0); y < std::min(image.height, y1); ++y)
    for (int k = 0; k < 3; ++k)
      image.rgb[3 * (std::size_t(y) * image.width + x) + k] =
          std::uint8_t(std::lround(255 * colour[std::size_t(k)]));
}

void centred(Image& image, const std::string& text, double middle, double baseline, double height) {
  const double width = text_width(text, height), room = 0.96 * image.width;
  const double size = width > room ? height * room / width : height;
  const double half = text_width(text, size) / 2;
  const double left = std::clamp(middle - half, 0.0, std::max(0.0, image.width - 2 * half));
  draw_text(image, text, left, baseline, size, ink);
}

void draw_bar(Image& image, int offset, const Layout& l, const FitScale& scale) {
  for (int x = l.left; x < l.right; ++x) {
    const double at = (x + 0.5 - l.left) / (l.right - l.left);
    fill(image, x, offset + l.top, offset + l.bottom,
         fit_colour(lowest(scale) + at * (scale.limit - lowest(scale)), scale));
  }
  const int tick = int(std::lround(0.5 * l.text));
  const double below = offset + l.bottom + 0.8 * l.text + 1.1 * l.text;
  for (int i = 0; i <= 4; ++i) {
    const double value = lowest(scale) + i * (scale.limit - lowest(scale)) / 4;
    const int x = std::min(int(l.column(value, scale)), l.right - 1);
    fill(image, x, offset + l.bottom, offset + l.bottom + tick, ink);
    centred(image, number(value, scale), x, below, l.text);
  }
  if (!(scale.mark > 0)) return;
  for (int x = 0; x < 2; ++x)
    fill(image, int(l.column(scale.mark, scale)) + x, offset + l.top - tick, offset + l.bottom + tick, ink);
}

}  // namespace

Colour fit_colour(double value, const FitScale& scale) {
  check(scale);
  if (std::isnan(value)) return unknown;
  const double at = std::clamp(std::abs(value) / scale.limit, 0.0, 1.0);
  if (scale.quantity == FitQuantity::strain) return blend(value < 0 ? pressed : stretched, at);
  return blend(distant, value < 0 ? 0 : at);
}

void colour_by_fit(geometry::Mesh& mesh, std::span<const double> values, const FitScale& scale) {
  check(scale);
  if (values.size() < mesh.num_vertices())
    throw std::invalid_argument("colour_by_fit: " + std::to_string(values.size()) + " values for " +
                                std::to_string(mesh.num_vertices()) + " vertices");
  auto colours = geometry::ensure_map(mesh, geometry::attribute::color);
  for (geometry::Vertex v : mesh.vertices()) {
    const Colour c = fit_colour(values[v.idx()], scale);
    for (std::size_t k = 0; k < 3; ++k) colours[v][k] = std::round(255.0 * c[k]) / 255;
    colours[v][3] = 1;
  }
}

Image with_fit_legend(const Image& picture, const FitScale& scale, const std::string& words) {
  check(scale);
  if (picture.width < 200 || picture.height < 1 ||
      picture.rgb.size() != std::size_t{3} * std::size_t(picture.width) * std::size_t(picture.height))
    throw std::invalid_argument("with_fit_legend: width = " + std::to_string(picture.width) +
                                " is not >= 200, or the pixels do not match the sides");
  const Layout l = layout_of(picture, !words.empty());
  Image image{picture.width, picture.height + l.height, picture.rgb};
  image.rgb.resize(std::size_t{3} * image.width * image.height, std::uint8_t(255 * paper[0]));
  const int offset = picture.height;
  const double line = 2.1 * l.text, middle = picture.width / 2.0;
  const bool strain = scale.quantity == FitQuantity::strain;
  if (!words.empty()) centred(image, words, middle, offset + line, l.text);
  const std::string title = strain ? "strain of the cloth [%]" : "distance from the body [mm]";
  centred(image, title, middle, offset + (words.empty() ? 1 : 2) * line, l.text);
  draw_bar(image, offset, l, scale);
  const double last = offset + l.height - 0.9 * l.text;
  centred(image, strain ? "pressed together" : "on the body", l.left, last, l.text);
  centred(image, strain ? "stretched: tight" : "far: loose", l.right, last, l.text);
  if (scale.mark > 0) {
    const std::string mark = (strain ? "tight from " : "loose from ") + number(scale.mark, scale);
    const double left = l.column(scale.mark, scale) - text_width(mark, 0.8 * l.text) / 2;
    if (left > middle + text_width(title, l.text) / 2 + l.text)  // else it would cover the title
      centred(image, mark, l.column(scale.mark, scale), offset + l.top - 0.8 * l.text, 0.8 * l.text);
  }
  return image;
}

}  // namespace furrow::io
