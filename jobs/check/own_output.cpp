// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/check/own_output.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/lower_case.h"
#include "io/base/nesting.h"
#include "io/base/number_text.h"
#include "jobs/inputs.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t looked_at = 1 << 24;        // of a file's beginning [bytes]
constexpr std::uintmax_t longest_json = 1 << 26;  // [bytes]
constexpr std::ptrdiff_t many_digits = 14;        // more than programs write that have floats

/// A file and how it begins.
struct Beginning {
  fs::path path;
  std::string text;  ///< at most looked_at bytes
  std::uintmax_t size = 0;

  bool starts_with(std::string_view word) const { return text.starts_with(word); }
  bool has(std::string_view word) const { return text.find(word) != text.npos; }
};

/// A word of the text in the byte order `order`; 0 behind its end.
std::uint32_t word_at(const std::string& text, std::size_t at, std::endian order) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4 && at + 4 <= text.size(); ++i)
    word |= std::uint32_t(static_cast<unsigned char>(text[at + i]))
            << 8 * (order == std::endian::little ? i : 3 - i);
  return word;
}

/// The whole lines of a beginning.
std::vector<std::string_view> lines_of(const Beginning& file) {
  std::vector<std::string_view> lines;
  const std::string_view text = file.text;
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != text.npos; at = end + 1)
    lines.push_back(text.substr(at, end - at));
  return lines;
}

/// What the numbers of a text look like.
struct Numbers {
  std::size_t count = 0, doubles = 0;  ///< those with more digits than a float has
  bool shortest = true;                ///< each is the shortest text that reads back as it
  bool doubles_shortest = true;

  /// Numbers with one blank between them; at most the first `most`.
  void take(std::string_view words, int most) {
    for (std::size_t at = 0; at <= words.size() && most > 0; --most) {
      const std::string_view word = words.substr(at, words.find(' ', at) - at);
      at += word.size() + 1;
      double value = 0;
      const bool read = std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc();
      std::string again;
      io::append_number(again, value);
      const bool same = read && again == word,
                 is_double = std::ranges::count_if(word, is_digit) >= many_digits;
      ++count;
      shortest = shortest && same;
      doubles += is_double;
      doubles_shortest = doubles_shortest && (same || !is_double);
    }
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
};

/// Doubles in little-endian order under the columns that furrow names, or a comment of furrow's own.
bool is_own_ply(const Beginning& file) {
  if (!file.starts_with("ply\nformat binary_little_endian 1.0\n")) return false;
  if (file.has("\ncomment furrow ")) return true;
  std::string properties, elements;
  for (const std::string_view line : lines_of(file)) {
    if (line == "end_header") break;
    if (line.starts_with("property ")) {
      properties += std::string(line.substr(9)) + ";";
      const bool known = line.starts_with("property double ") || line.starts_with("property int ") ||
                         line.starts_with("property uchar ") ||
                         line.starts_with("property list uchar double ") ||
                         line == "property list uchar int vertex_indices";
      if (!known) return false;
    }
    if (line.starts_with("element ")) elements += std::string(line.substr(8, line.rfind(' ') - 8)) + ";";
  }
  return properties.starts_with("double x;double y;double z;") && elements.starts_with("vertex;face;") &&
         properties.find(";list uchar int vertex_indices;") != properties.npos;
}

/// Numbers of the shortest form, some with all the digits of a double or without a comment in the file, in
/// the order in which furrow writes an OBJ; or in the text of another program, which `transfer` keeps but for
/// the positions that it moved.
bool is_own_obj(const Beginning& file) {
  constexpr std::string_view words[] = {"#", "mtllib", "v", "vt", "g", "usemtl", "f", "l"};
  Numbers numbers;
  bool own_order = true, commented = false;
  for (std::string_view line : lines_of(file)) {
    if (line.ends_with('\r')) line.remove_suffix(1), own_order = false;
    const std::string_view word = line.substr(0, line.find(' '));
    own_order = own_order && std::ranges::find(words, word) != std::end(words);
    commented = commented || word == "#";
    if (word == "v" && line.size() > 2) numbers.take(line.substr(2), 3);
  }
  const bool told = own_order && numbers.count > 0 && numbers.shortest;
  if (told && (numbers.doubles > 0 || !commented)) return true;
  return numbers.doubles > 0 && numbers.doubles_shortest;
}

bool is_own_off(const Beginning& file) {
  const std::vector<std::string_view> lines = lines_of(file);
  if (lines.size() < 3 || (lines[0] != "OFF" && lines[0] != "COFF") || !lines[1].ends_with(" 0"))
    return false;
  std::size_t vertices = 0;
  std::from_chars(lines[1].data(), lines[1].data() + lines[1].size(), vertices);
  Numbers numbers;
  for (std::size_t i = 2; i < lines.size() && i - 2 < vertices; ++i) numbers.take(lines[i], 3);
  return numbers.count > 0 && numbers.shortest;
}

bool is_own_stl(const Beginning& file) { return file.starts_with("binary STL written by furrow"); }

bool is_own_glb(const Beginning& file) {
  return file.starts_with("glTF") && file.has("\"generator\":\"Furrow\"");
}

bool is_own_pc2(const Beginning& file) {
  if (!file.starts_with(std::string_view("POINTCACHE2\0\1\0\0\0", 16))) return false;
  const std::uintmax_t points = word_at(file.text, 16, std::endian::little),
                       frames = word_at(file.text, 28, std::endian::little);
  const auto sampling = std::bit_cast<float>(word_at(file.text, 24, std::endian::little));
  return sampling == 1 && file.size == 32 + 12 * points * frames;
}

/// As long as its head says.
bool is_own_mdd(const Beginning& file) {
  if (io::lower_case(file.path.extension().string()) != ".mdd") return false;
  const std::uintmax_t frames = word_at(file.text, 0, std::endian::big),
                       points = word_at(file.text, 4, std::endian::big);
  return frames > 0 && points > 0 && file.size == 8 + 4 * frames + 12 * points * frames;
}

bool is_own_field(const Beginning& file) {  // the body's fingerprint stands before the word
  return std::string_view(file.text)
      .substr(std::min<std::size_t>(8, file.text.size()))
      .starts_with("FURFIELD");
}

/// IHDR, sRGB with 8 bits a channel, IDAT of 8,192 bytes each but the last, IEND, and nothing else: as libpng
/// writes RGB where nothing more is asked of it. gnuplot's charts have cairo's bKGD instead of sRGB.
bool is_own_png(const Beginning& file) {
  if (!file.starts_with("\x89PNG\r\n\x1a\n") || file.text.size() < 33) return false;
  const int bits = file.text[24], channels = file.text[25];
  std::ifstream in(file.path, std::ios::binary);
  std::string kinds;
  std::uint32_t length = 0, last = 8192;
  for (std::uintmax_t at = 8; at + 12 <= file.size && !kinds.ends_with("IEND"); at += 12 + length) {
    std::string head(8, '\0');
    if (!in.seekg(std::streamoff(at)).read(head.data(), 8)) return false;
    length = word_at(head, 0, std::endian::big);
    const std::string kind = head.substr(4);
    if (kind == "IDAT" && std::exchange(last, length) != 8192) return false;
    if (kind != "IDAT" || !kinds.ends_with("IDAT")) kinds += kind;
  }
  if (channels != 2) return false;
  return (bits == 16 && kinds == "IHDRIDATIEND") ||
         (bits == 8 && (kinds == "IHDRsRGBIDATIEND" || kinds == "IHDRbKGDIDATIEND"));
}

/// Strokes, a record of maps or a camera, laid out to the byte as furrow does it.
bool is_own_json(const Beginning& file) {
  if (!file.starts_with("{") || file.size > longest_json) return false;
  std::ifstream in(file.path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (io::is_nested_too_deep(text)) return false;
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return false;
  int indent = 0;
  if (json.contains("strokes"))
    indent = 1;
  else if (json.contains("furrow_maps"))
    indent = 2;
  else if (json.contains("eye") && json.contains("target") && json.contains("size"))
    indent = -1;
  return indent != 0 && text == json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool is_own_chart(const Beginning& file) {
  return file.starts_with("name,integrator,dt,cost,error,error_is") ||
         (file.starts_with("<?xml") && file.has("predicted seconds a simulated second"));
}

bool is_own_manual(const Beginning& file) {
  return file.starts_with(".TH \"FURROW") && file.has("\"Furrow\"");
}

Beginning beginning_of(const fs::path& path) {
  Beginning file{path, {}, fs::file_size(path)};
  file.text.resize(std::min<std::uintmax_t>(looked_at, file.size));
  std::ifstream in(path, std::ios::binary);
  in.read(file.text.data(), std::streamsize(file.text.size()));
  file.text.resize(std::size_t(std::max<std::streamsize>(0, in.gcount())));
  return file;
}

}  // namespace

bool is_own_output(const fs::path& path) {
  std::error_code error;
  if (fs::file_size(path, error) == 0 && !error) return true;
  if (error) return false;
  const Beginning file = beginning_of(path);
  for (const auto is_own : {is_own_ply, is_own_obj, is_own_off, is_own_stl, is_own_glb, is_own_pc2,
                            is_own_mdd, is_own_field, is_own_png, is_own_json, is_own_chart, is_own_manual})
    if (is_own(file)) return true;
  return false;
}

}  // namespace furrow::jobs
