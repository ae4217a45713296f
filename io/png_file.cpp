// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/png_file.h"

#include <png.h>
#include <unistd.h>

#include <string>
#include <system_error>

#include "geometry/errors.h"

namespace furrow::io {
namespace {

/// libpng's control block, released however we leave.
struct Control {
  png_image image{};
  Control() { image.version = PNG_IMAGE_VERSION; }
  ~Control() { png_image_free(&image); }
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;
};

void check(const Image& image) {
  const auto expected = std::size_t{3} * std::size_t(image.width) * std::size_t(image.height);
  if (image.width < 1 || image.height < 1 || image.rgb.size() != expected) {
    throw std::invalid_argument(
        "image: " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels with " +
        std::to_string(image.rgb.size()) + " values; expected sides of at least 1 and 3 values a pixel");
  }
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  check(image);
  Control control;
  control.image.width = png_uint_32(image.width);
  control.image.height = png_uint_32(image.height);
  control.image.format = PNG_FORMAT_RGB;
  const std::filesystem::path temporary = path.string() + ".part" + std::to_string(::getpid());
  std::error_code error;
  if (!png_image_write_to_file(&control.image, temporary.c_str(), 0, image.rgb.data(), 0, nullptr)) {
    std::filesystem::remove(temporary, error);
    throw std::runtime_error(path.string() + ": cannot write the picture: " + control.image.message);
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(path.string() + ": cannot write the picture: " + error.message());
  }
}

Image read_png(const std::filesystem::path& path) {
  constexpr double kMaxPixels = 1e8;
  Control control;
  if (!png_image_begin_read_from_file(&control.image, path.c_str())) {
    throw geometry::ContentError(path.string() + ": cannot be read as PNG: " + control.image.message);
  }
  if (double(control.image.width) * double(control.image.height) > kMaxPixels) {
    throw geometry::ContentError(path.string() + ": more than 100 million pixels; scale the picture down");
  }
  control.image.format = PNG_FORMAT_RGB;
  Image image{int(control.image.width), int(control.image.height), {}};
  image.rgb.resize(PNG_IMAGE_SIZE(control.image));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&control.image, &white, image.rgb.data(), 0, nullptr)) {
    throw geometry::ContentError(path.string() + ": cannot be read as PNG: " + control.image.message);
  }
  return image;
}

}  // namespace furrow::io
