// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/strip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/picture/stroke_font.h"

namespace furrow::io {
namespace {

constexpr double line_spacing = 2.0;  // of the capitals' height

[[noreturn]] void refuse_strip(const std::string& text) { throw std::invalid_argument("strip: " + text); }

void check(std::span<const Panel> panels, const StripOptions& options) {
  if (panels.empty()) refuse_strip("no panels");
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Image& image = panels[i].image;
    if (image.width < 1 || image.height < 1 ||
        image.rgb.size() != std::size_t{3} * std::size_t(image.width) * std::size_t(image.height)) {
      refuse_strip("panel " + std::to_string(i) + ": its pixels do not match its sides");
    }
  }
  if (!(options.text_height >= 0.005 && options.text_height <= 0.2)) {
    refuse_strip("text_height " + std::to_string(options.text_height) + " is not in [0.005, 0.2]");
  }
  if (options.gap < 0 || options.gap > 1000) {
    refuse_strip("gap " + std::to_string(options.gap) + " is not in [0, 1000]");
  }
  for (const Colour& colour : {options.paper, options.ink}) {
    for (float c : colour) {
      if (!(c >= 0 && c <= 1)) refuse_strip("colour value " + std::to_string(c) + " is not in [0, 1]");
    }
  }
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Height of the capitals at which every caption fits its panel [pixels].
double fitting_height(std::span<const Panel> panels, double height) {
  for (const Panel& panel : panels) {
    for (std::string_view line : lines_of(panel.caption)) {
      const double width = text_width(line, height), room = 0.96 * panel.image.width;
      if (width > room) height *= room / width;
    }
  }
  return height;
}

void paste(const Image& image, int left, int top, Image& strip) {
  for (int row = 0; row < image.height; ++row) {
    const auto from = image.rgb.begin() + std::ptrdiff_t{3} * row * image.width;
    std::copy(from, from + 3 * image.width,
              strip.rgb.begin() + 3 * (std::ptrdiff_t{top + row} * strip.width + left));
  }
}

Image blank(int width, int height, const Colour& colour) {
  Image image{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = std::uint8_t(std::lround(255 * colour[i % 3]));
  }
  return image;
}

}  // namespace

Image strip(std::span<const Panel> panels, const StripOptions& options) {
  check(panels, options);
  int width = options.gap, tallest = 0;
  std::size_t line_count = 0;
  for (const Panel& panel : panels) {
    width += panel.image.width + options.gap;
    tallest = std::max(tallest, panel.image.height);
    line_count = std::max(line_count, lines_of(panel.caption).size());
  }
  const double text = fitting_height(panels, options.text_height * tallest);
  const int room = line_count == 0 ? 0 : int(std::ceil((0.8 + line_spacing * line_count) * text));
  Image result = blank(width, tallest + 2 * options.gap + room, options.paper);
  int left = options.gap;
  for (const Panel& panel : panels) {
    paste(panel.image, left, options.gap + (tallest - panel.image.height) / 2, result);
    double baseline = options.gap + tallest + 1.9 * text;
    for (std::string_view line : lines_of(panel.caption)) {
      const double start = left + (panel.image.width - text_width(line, text)) / 2;
      draw_text(result, line, start, baseline, text, options.ink);
      baseline += line_spacing * text;
    }
    left += panel.image.width + options.gap;
  }
  return result;
}

}  // namespace furrow::io
