// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/fit_colours.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "geometry/mesh/property_names.h"
#include "tests/io/picture/scenes.h"
#include "tests/test_meshes.h"

namespace furrow::tests {
namespace {

using io::FitQuantity;
using io::FitScale;

/// L, a, b of OKLab (B. Ottosson 2020).
std::array<double, 3> oklab(const io::Colour& colour) {
  std::array<double, 3> c;
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = colour[k] <= 0.04045 ? colour[k] / 12.92 : std::pow((colour[k] + 0.055) / 1.055, 2.4);
  const double l = std::cbrt(0.4122214708 * c[0] + 0.5363325363 * c[1] + 0.0514459929 * c[2]);
  const double m = std::cbrt(0.2119034982 * c[0] + 0.6806995451 * c[1] + 0.1073969566 * c[2]);
  const double s = std::cbrt(0.0883024619 * c[0] + 0.2817188376 * c[1] + 0.6299787005 * c[2]);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double lightness(double value, const FitScale& scale) { return oklab(io::fit_colour(value, scale))[0]; }

TEST_CASE("fit_colours: the lightness of strain falls evenly to both sides, that of distance rises") {
  const FitScale strain{FitQuantity::strain, 0.1, 0}, distance{FitQuantity::distance, 0.05, 0};
  for (int i = 0; i < 20; ++i) {
    const double a = i / 20.0, b = (i + 1) / 20.0;
    for (double sign : {-1.0, 1.0}) {
      const double fall = lightness(sign * 0.1 * a, strain) - lightness(sign * 0.1 * b, strain);
      CHECK(fall > 0.5 * 0.51 / 20);
      CHECK(fall < 1.5 * 0.51 / 20);
    }
    const double rise = lightness(0.05 * b, distance) - lightness(0.05 * a, distance);
    CHECK(rise > 0.5 * 0.61 / 20);
    CHECK(rise < 1.5 * 0.61 / 20);
  }
}

TEST_CASE(
    "fit_colours: stretched and pressed differ in yellow against blue, which the colour-blind tell apart") {
  const FitScale scale{FitQuantity::strain, 0.1, 0};
  for (double x : {0.02, 0.05, 0.1, 0.4}) {
    CHECK(oklab(io::fit_colour(x, scale))[2] > 0.06);
    CHECK(oklab(io::fit_colour(-x, scale))[2] < -0.04);
  }
}

TEST_CASE(
    "fit_colours: beyond the ends colours stay, inside the body they are those of contact, NaN is grey") {
  const FitScale strain{FitQuantity::strain, 0.1, 0}, distance{FitQuantity::distance, 0.05, 0};
  CHECK(io::fit_colour(5, strain) == io::fit_colour(0.1, strain));
  CHECK(io::fit_colour(-5, strain) == io::fit_colour(-0.1, strain));
  CHECK(io::fit_colour(-0.01, distance) == io::fit_colour(0, distance));
  CHECK(io::fit_colour(std::numeric_limits<double>::infinity(), distance) == io::fit_colour(0.05, distance));
  const io::Colour none = io::fit_colour(std::numeric_limits<double>::quiet_NaN(), strain);
  CHECK(none[0] == none[1]);
  CHECK(none[1] == none[2]);
  CHECK_THROWS_WITH(io::fit_colour(0, {FitQuantity::strain, 0, 0}), Catch::Contains("limit"));
  CHECK_THROWS_WITH(io::fit_colour(0, {FitQuantity::strain, 0.1, 0.2}), Catch::Contains("mark"));
}

TEST_CASE("fit_colours: colours of a mesh are those of its values, in steps of a byte") {
  geometry::Mesh mesh = tests::grid(2, 2);
  std::vector<double> values;
  for (std::size_t i = 0; i < mesh.num_vertices(); ++i) values.push_back(0.03 * double(i) - 0.1);
  const FitScale scale{FitQuantity::strain, 0.1, 0};
  CHECK_THROWS_AS(io::colour_by_fit(mesh, std::vector<double>{1, 2}, scale), std::invalid_argument);
  CHECK_FALSE(geometry::find_map(mesh, geometry::attribute::color));
  io::colour_by_fit(mesh, values, scale);
  const auto colours = *geometry::find_map(mesh, geometry::attribute::color);
  for (auto v : mesh.vertices()) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(colours[v][k] == Approx(io::fit_colour(values[v.idx()], scale)[k]).margin(0.5 / 255 + 1e-6));
      CHECK(std::round(colours[v][k] * 255) / 255 == colours[v][k]);
    }
    CHECK(colours[v][3] == 1);
  }
}

TEST_CASE(
    "fit_colours: the legend stands below the picture, its bar has the scale's colours, and words make it "
    "higher") {
  const io::Image picture{400, 60, std::vector<std::uint8_t>(3 * 400 * 60, 77)};
  const FitScale scale{FitQuantity::strain, 0.1, 0.05};
  const io::Image image = io::with_fit_legend(picture, scale),
                  worded = io::with_fit_legend(picture, scale, "M");
  CHECK(image.width == 400);
  CHECK(image.height > 60 + 30);
  CHECK(worded.height > image.height);
  CHECK(std::equal(picture.rgb.begin(), picture.rgb.end(), image.rgb.begin()));
  const auto near = [](const std::array<int, 3>& p, const io::Colour& c) {
    int far = 0;
    for (std::size_t k = 0; k < 3; ++k) far = std::max(far, std::abs(p[k] - int(std::lround(255 * c[k]))));
    return far <= 6;
  };
  int red = 0, blue = 0, ink = 0;
  for (int y = 60; y < image.height; ++y)
    for (int x = 0; x < 400; ++x) {
      const auto p = pixel(image, x, y);
      red += x > 200 && near(p, io::fit_colour(0.1, scale));
      blue += x < 200 && near(p, io::fit_colour(-0.1, scale));
      ink += p[0] < 60 && p[1] < 60 && p[2] < 60;
    }
  CHECK(red > 5);
  CHECK(blue > 5);
  CHECK(ink > 60);  // numbers and words
  const io::Image narrow{100, 60, std::vector<std::uint8_t>(3 * 100 * 60, 77)};
  CHECK_THROWS_WITH(io::with_fit_legend(narrow, scale), Catch::Contains("width"));
}

}  // namespace
}  // namespace furrow::tests
