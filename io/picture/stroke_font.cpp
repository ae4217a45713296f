// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace furrow::io {
namespace {

using PenStroke = std::vector<std::array<double, 2>>;

constexpr double capital = 12, space = 6, side_bearing = 3.4;
constexpr double pen_radius = 0.75;

/// Strokes of the characters from '!' to '~', separated by blanks. A point is a digit, x, and a letter, y: E
/// is the baseline, M the height of small letters, Q that of capitals. After '~' the points steer a quadratic
/// B-spline.
constexpr std::string_view glyph_strokes[] = {
    "0Q0I 0E0E",                             // !
    "0Q0N 3Q3N",                             // "
    "2Q1E 6Q5E 0I7I 0M7M",                   // #
    "~7O7Q0Q0K7K7E0E0G 3S3C",                // $
    "0E8Q ~0M3M3Q0Q0M ~5E8E8I5I5E",          // %
    "~8J8E0E0K5K5Q1Q1M3K8E",                 // &
    "0Q0N",                                  // '
    "~3R0O0F3C",                             // (
    "~0R3O3F0C",                             // )
    "3P3J 0O6K 0K6O",                        // *
    "0I6I 3F3L",                             // +
    "1E0C",                                  // ,
    "0I5I",                                  // -
    "0E0E",                                  // .
    "0D5Q",                                  // /
    "~0E6E6Q0Q0E",                           // 0
    "0N3Q3E",                                // 1
    "~0N0Q6Q6L0E 0E6E",                      // 2
    "~0O0Q6Q6K3K 2K3K ~3K6K6E0E0G",          // 3
    "5E5Q0H7H",                              // 4
    "6Q1Q1K ~1K6M6E0E0G",                    // 5
    "~5Q0Q0H ~0E6E6K0K0E",                   // 6
    "0Q6Q2E",                                // 7
    "~0K6K6Q0Q0K ~0E6E6K0K0E",               // 8
    "~1E6E6N ~0K6K6Q0Q0K",                   // 9
    "0E0E 0L0L",                             // :
    "0L0L 1E0C",                             // ;
    "5M0I5E",                                // <
    "0G6G 0K6K",                             // =
    "0M5I0E",                                // >
    "~0N0Q6Q6L3L3I 3E3E",                    // ?
    "~6H6L2L2G6G ~6I6F8F8Q0Q0C8C",           // @
    "0E4Q8E 1H7H",                           // A
    "0E0Q4Q ~4Q7Q7K4K 0K4K ~4K8K8E4E 4E0E",  // B
    "~8N8Q0Q0E8E8H",                         // C
    "0E0Q3Q ~3Q8Q8E3E 3E0E",                 // D
    "7Q0Q0E7E 0K6K",                         // E
    "7Q0Q0E 0K6K",                           // F
    "~8N8Q0Q0E8E8J 8J5J",                    // G
    "0Q0E 8Q8E 0K8K",                        // H
    "0Q0E",                                  // I
    "~0H0E5E5I 5I5Q",                        // J
    "0Q0E 7Q0I 2K8E",                        // K
    "0Q0E6E",                                // L
    "0E0Q4I8Q8E",                            // M
    "0E0Q8E8Q",                              // N
    "~0E8E8Q0Q0E",                           // O
    "0E0Q4Q ~4Q8Q8J4J 4J0J",                 // P
    "~0E8E8Q0Q0E 5H8D",                      // Q
    "0E0Q4Q ~4Q8Q8J4J 4J0J 4J8E",            // R
    "~7O7Q0Q0K7K7E0E0G",                     // S
    "0Q8Q 4Q4E",                             // T
    "0Q0I ~0I0E8E8I 8I8Q",                   // U
    "0Q4E8Q",                                // V
    "0Q2E4N6E8Q",                            // W
    "0Q8E 8Q0E",                             // X
    "0Q4K8Q 4K4E",                           // Y
    "0Q8Q0E8E",                              // Z
    "3R0R0C3C",                              // [
    "0Q5D",                                  // backslash
    "0R3R3C0C",                              // ]
    "0N3Q6N",                                // ^
    "0D7D",                                  // _
    "0Q2N",                                  // `
    "~0E6E6M0M0E 6M6E",                      // a
    "0Q0E ~0E6E6M0M0E",                      // b
    "~6K6M0M0E6E6G",                         // c
    "6Q6E ~0E6E6M0M0E",                      // d
    "0I6I ~6I6M0M0E6E6F",                    // e
    "~5Q2Q2L 2L2E 0M4M",                     // f
    "~0E6E6M0M0E 6M6E ~6E6A1A",              // g
    "0Q0E ~0I0M6M6I 6I6E",                   // h
    "0E0M 0P0P",                             // i
    "2M2D ~2D2A0A 2P2P",                     // j
    "0Q0E 5M0H 2J6E",                        // k
    "0Q0E",                                  // l
    "0M0E ~0I0M4M4I 4I4E ~4I4M8M8I 8I8E",    // m
    "0M0E ~0I0M6M6I 6I6E",                   // n
    "~0E6E6M0M0E",                           // o
    "0M0A ~0E6E6M0M0E",                      // p
    "6M6A ~0E6E6M0M0E",                      // q
    "0M0E ~0I0M4M4L",                        // r
    "~5L5M0M0I5I5E0E0F",                     // s
    "1P1G ~1G1E4E 0M4M",                     // t
    "0M0I ~0I0E6E6I 6M6E",                   // u
    "0M3E6M",                                // v
    "0M2E4M6E8M",                            // w
    "0M6E 6M0E",                             // x
    "0M3E 6M1A",                             // y
    "0M6M0E6E",                              // z
    "~3R1R1K0K ~0K1K1C3C",                   // {
    "0R0C",                                  // |
    "~0R2R2K3K ~3K2K2C0C",                   // }
    "~0H1K3K4H6H7K",                         // ~
};
constexpr std::string_view box = "0E6E6Q0Q0E";
static_assert(std::size(glyph_strokes) == '~' - '!' + 1);

/// Corner cutting (Chaikin 1974), whose limit is the quadratic B-spline; ends stay, a loop stays closed.
PenStroke smoothed(PenStroke points) {
  const bool closed = points.front() == points.back();
  for (int round = 0; round < 4; ++round) {
    PenStroke next;
    if (!closed) next.push_back(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto &a = points[i - 1], &b = points[i];
      next.push_back({0.75 * a[0] + 0.25 * b[0], 0.75 * a[1] + 0.25 * b[1]});
      next.push_back({0.25 * a[0] + 0.75 * b[0], 0.25 * a[1] + 0.75 * b[1]});
    }
    next.push_back(closed ? next.front() : points.back());
    points = std::move(next);
  }
  return points;
}

double distance_to_segment(double x, double y, const std::array<double, 2>& a,
                           const std::array<double, 2>& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / length2, 0.0, 1.0) : 0;
  return std::hypot(x - a[0] - t * dx, y - a[1] - t * dy);
}

/// How much of each pixel the pen covers, in [0, 1].
struct Coverage {
  int width, height;
  std::vector<float> values;

  void stroke(const std::array<double, 2>& a, const std::array<double, 2>& b, double radius) {
    const int x0 = bound(std::min(a[0], b[0]) - radius - 1, width),
              y0 = bound(std::min(a[1], b[1]) - radius - 1, height);
    const int x1 = bound(std::max(a[0], b[0]) + radius + 1, width),
              y1 = bound(std::max(a[1], b[1]) + radius + 1, height);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const double covered = radius + 0.5 - distance_to_segment(x + 0.5, y + 0.5, a, b);
        float& value = values[std::size_t(y) * width + x];
        value = std::max(value, float(std::clamp(covered, 0.0, 1.0)));
      }
    }
  }
  static int bound(double x, int side) { return int(std::clamp(x, 0.0, double(side))); }
};

}  // namespace

Glyph glyph(char character) {
  if (character == ' ') return {{}, space};
  const bool known = character >= '!' && character <= '~';
  const std::string_view text = known ? glyph_strokes[character - '!'] : box;
  Glyph result;
  double right = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const bool curved = text[at] == '~';
    PenStroke points;
    for (std::size_t i = at + (curved ? 1 : 0); i + 1 < end; i += 2) {
      points.push_back({double(text[i] - '0'), double(text[i + 1] - 'E')});
      right = std::max(right, points.back()[0]);
    }
    result.strokes.push_back(curved ? smoothed(std::move(points)) : std::move(points));
    at = end + 1;
  }
  result.advance = right + side_bearing;
  return result;
}

double text_width(std::string_view text, double height) {
  double width = 0;
  for (char c : text) width += glyph(c).advance;
  return std::max(0.0, width - (text.empty() || text.back() == ' ' ? 0 : side_bearing)) * height / capital;
}

void draw_text(Image& image, std::string_view text, double left, double baseline, double height,
               const Colour& colour) {
  if (!(height > 0 && height <= 10000)) {
    throw std::invalid_argument("draw_text: height " + std::to_string(height) + " is not in (0, 10000]");
  }
  if (!std::isfinite(left) || !std::isfinite(baseline)) throw std::invalid_argument("draw_text: no position");
  const double scale = height / capital;
  Coverage coverage{image.width, image.height, std::vector<float>(image.rgb.size() / 3)};
  for (char c : text) {
    const Glyph letter = glyph(c);
    for (const PenStroke& stroke : letter.strokes) {
      const auto place = [&](const std::array<double, 2>& p) {
        return std::array<double, 2>{left + scale * p[0], baseline - scale * p[1]};
      };
      for (std::size_t i = 1; i < stroke.size(); ++i) {
        coverage.stroke(place(stroke[i - 1]), place(stroke[i]), std::max(0.5, pen_radius * scale));
      }
    }
    left += scale * letter.advance;
  }
  for (std::size_t i = 0; i < coverage.values.size(); ++i) {
    const float covered = coverage.values[i];
    if (covered == 0) continue;
    for (int k = 0; k < 3; ++k) {
      std::uint8_t& value = image.rgb[3 * i + k];
      value = std::uint8_t(std::lround((1 - covered) * value + covered * 255 * colour[k]));
    }
  }
}

}  // namespace furrow::io
