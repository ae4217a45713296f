// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/png_file.h"

#include <png.h>

#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <ostream>
#include <string>

#include "geometry/mesh/errors.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/own_mark.h"

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

template <class AnyImage>
void check(const AnyImage& image) {
  const auto expected = std::size_t{3} * std::size_t(image.width) * std::size_t(image.height);
  if (image.width < 1 || image.height < 1 || image.rgb.size() != expected) {
    throw std::invalid_argument(
        "image: " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels with " +
        std::to_string(image.rgb.size()) + " values; expected sides of at least 1 and 3 values a pixel");
  }
}

constexpr double max_pixels = 1e8;

/// What libpng's callbacks work on. libpng leaves by longjmp, so nothing with a destructor may live in the
/// functions that it leaves.
struct Stream {
  std::string* out = nullptr;
  const std::string* in = nullptr;
  std::size_t at = 0;
  char message[200] = {};

  static Stream& of(png_structp png) { return *static_cast<Stream*>(png_get_io_ptr(png)); }
  static void append(png_structp png, png_bytep data, std::size_t n) {
    bool full = false;
    try {
      of(png).out->append(reinterpret_cast<const char*>(data), n);
    } catch (...) {
      full = true;
    }
    if (full) png_error(png, "not enough memory");
  }
  static void take(png_structp png, png_bytep data, std::size_t n) {
    Stream& s = of(png);
    if (n > s.in->size() - s.at) png_error(png, "the file is cut short");
    std::memcpy(data, s.in->data() + s.at, n);
    s.at += n;
  }
  static void fail(png_structp png, png_const_charp message) {
    std::strncpy(static_cast<Stream*>(png_get_error_ptr(png))->message, message, sizeof(Stream::message) - 1);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}
};

/// False with stream.message if it could not be done.
bool encode(const Image16& image, Stream& stream) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &stream, Stream::fail, Stream::ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  if (setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &stream, Stream::append, nullptr);
  png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), 16, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  for (int row = 0; row < image.height; ++row)
    png_write_row(png, reinterpret_cast<png_const_bytep>(&image.rgb[std::size_t{3} * image.width * row]));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

/// Reads the header: sides, and whether there are three channels of 16 bits.
void read_header(png_structp png, png_infop info, Image16& image) {
  png_read_info(png, info);
  const double pixels = double(png_get_image_width(png, info)) * double(png_get_image_height(png, info));
  if (pixels > max_pixels) png_error(png, "more than 100 million pixels; scale the picture down");
  if (png_get_bit_depth(png, info) != 16 || !(png_get_color_type(png, info) & PNG_COLOR_MASK_COLOR))
    png_error(png, "a picture of 16 bits a channel in red, green and blue is needed");
  image.width = int(png_get_image_width(png, info));
  image.height = int(png_get_image_height(png, info));
}

/// Reads the rows. `rows` is filled here but lives outside.
bool decode(Stream& stream, Image16& image, std::vector<png_bytep>& rows) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream, Stream::fail, Stream::ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  if (setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &stream, Stream::take);
  read_header(png, info, image);
  png_set_strip_alpha(png);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  image.rgb.resize(std::size_t{3} * image.width * image.height);
  for (int row = 0; row < image.height; ++row)
    rows.push_back(reinterpret_cast<png_bytep>(&image.rgb[std::size_t{3} * image.width * row]));
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

std::string marked_png(std::string_view bytes) {
  if (!bytes.ends_with(png_end)) throw std::invalid_argument("bytes: a PNG ends with the chunk IEND");
  return std::string(bytes.substr(0, bytes.size() - png_end.size())).append(png_mark).append(png_end);
}

void write_png16(const std::filesystem::path& path, const Image16& image) {
  check(image);
  std::string bytes;
  Stream stream;
  stream.out = &bytes;
  if (!encode(image, stream))
    throw std::runtime_error(path.string() + ": cannot write the picture: " + stream.message);
  write_atomically(path, [&](std::ostream& out) { out << marked_png(bytes); });
}

Image16 read_png16(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  Stream stream;
  stream.in = &bytes;
  Image16 image;
  std::vector<png_bytep> rows;
  if (!decode(stream, image, rows))
    throw geometry::ContentError(path.string() + ": cannot be read as PNG: " + stream.message);
  return image;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  check(image);
  Control control;
  control.image.width = png_uint_32(image.width);
  control.image.height = png_uint_32(image.height);
  control.image.format = PNG_FORMAT_RGB;
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(path.string() + ": cannot write the picture: " + why);
  };
  char* bytes = nullptr;
  std::size_t size = 0;
  std::FILE* memory = open_memstream(&bytes, &size);
  if (!memory) fail(std::strerror(errno));
  const bool done = png_image_write_to_stdio(&control.image, memory, 0, image.rgb.data(), 0, nullptr);
  const bool whole = std::fclose(memory) == 0;
  const std::unique_ptr<char, decltype(&std::free)> owner(bytes, &std::free);
  if (!done || !whole) fail(done ? "not enough memory" : control.image.message);
  write_atomically(path, [&](std::ostream& out) { out << marked_png({bytes, size}); });
}

Image read_png(const std::filesystem::path& path) {
  Control control;
  if (!png_image_begin_read_from_file(&control.image, path.c_str())) {
    throw geometry::ContentError(path.string() + ": cannot be read as PNG: " + control.image.message);
  }
  if (double(control.image.width) * double(control.image.height) > max_pixels) {
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
