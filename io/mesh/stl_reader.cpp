// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include "geometry/mesh/errors.h"
#include "io/base/byte_order.h"
#include "io/base/name_table.h"
#include "io/base/text_scanner.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/merge_points.h"
#include "io/mesh/mesh_readers.h"

namespace furrow::io {
namespace {

using namespace geometry;

constexpr std::size_t header = 84, facet = 50;  // [bytes]

template <class T>
T number_at(std::string_view bytes, std::size_t at) {
  return read_in_order<T>(bytes.data() + at, std::endian::little);
}

class StlReader {
 public:
  StlReader(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : bytes_(bytes), name_(name), options_(options) {}

  void read() {
    if (is_binary())
      read_binary();
    else
      read_text();
    if (file.group_names.empty()) soup.groups.clear();
    file.repairs.merged_vertices = shared_;
  }

  PolygonSoup soup;
  MeshFile file;

 private:
  /// Some binary files begin with "solid" too: the length decides first.
  bool is_binary() const {
    if (bytes_.size() >= header && bytes_.size() == header + facet * number_at<std::uint32_t>(bytes_, 80))
      return true;
    const auto first = bytes_.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == bytes_.npos || !bytes_.substr(first).starts_with("solid")) return true;
    return bytes_.substr(0, 1000).find('\0') != bytes_.npos;
  }

  void add_corner(const Point& point) {
    const auto [index, is_new] = numbers_.number(point);
    if (is_new)
      soup.points.push_back(point);
    else
      ++shared_;
    soup.corners.push_back(index);
  }

  void read_binary() {
    if (bytes_.size() < header) throw ContentError(name_ + ": shorter than the header of an STL file");
    const std::size_t count = number_at<std::uint32_t>(bytes_, 80), room = (bytes_.size() - header) / facet;
    if (count > room)
      throw ContentError(name_ + ": the header announces " + std::to_string(count) +
                         " triangles, the file holds " + std::to_string(room) +
                         ": it is cut short or no STL file");
    if (bytes_.size() > header + facet * count)
      file.warnings.push_back(name_ + ": bytes after the last triangle not read");
    for (std::size_t f = 0; f < count; ++f) {
      const std::size_t at = header + facet * f;
      for (int k = 0; k < 3; ++k) {
        const auto c = [&](int i) { return number_at<float>(bytes_, at + 12 + 12 * k + 4 * i); };
        const auto point = from_file(c(0), c(1), c(2), options_);
        if (!point) throw ContentError(name_ + ": face " + std::to_string(f) + ": " + bad_coordinate);
        add_corner(*point);
      }
      soup.close_face();
    }
  }

  void read_text() {
    TextScanner in(plain_text(bytes_, name_), name_);
    std::string_view word = in.next_word();
    for (; word == "solid"; word = in.next_word()) read_solid(in);
    if (!word.empty()) in.fail(in_quotes(word) + " where 'solid' should stand; correct it");
  }

  void read_solid(TextScanner& in) {
    const std::string_view title = in.rest_of_line();
    int group = -1;
    std::string_view word = in.next_word();
    for (; word == "facet"; word = in.next_word()) {
      if (group < 0) group = groups_.index(title);
      read_facet(in);
      soup.groups.push_back(group);
    }
    if (word.empty()) in.fail("no 'endsolid': the file is cut short");
    if (word != "endsolid")
      in.fail(in_quotes(word) + " where 'facet' or 'endsolid' should stand; correct it");
    in.rest_of_line();
  }

  static void expect(TextScanner& in, std::string_view wanted) {
    const std::string_view word = in.next_word();
    if (word.empty()) in.fail("the file is cut short: '" + std::string(wanted) + "' should follow");
    if (word != wanted)
      in.fail(in_quotes(word) + " where '" + std::string(wanted) + "' should stand; correct it");
  }

  void read_facet(TextScanner& in) {
    soup.face_lines.push_back(in.line());
    expect(in, "normal");
    for (int k = 0; k < 3; ++k) in.any_number(in.next_word(), "normal of a facet");
    expect(in, "outer");
    expect(in, "loop");
    std::string_view word = in.next_word();
    for (; word == "vertex"; word = in.next_word()) {
      double x[3];
      for (double& c : x) c = in.finite_number(in.next_word(), "coordinate of a vertex");
      const auto point = from_file(x[0], x[1], x[2], options_);
      if (!point) in.fail(bad_coordinate);
      add_corner(*point);
    }
    if (word != "endloop") in.fail(in_quotes(word) + " where 'vertex' or 'endloop' should stand; correct it");
    expect(in, "endfacet");
    soup.close_face();
  }

  std::string_view bytes_;
  std::string name_;
  ReadOptions options_;
  NameTable groups_{file.group_names};
  PointNumbers numbers_;
  std::size_t shared_ = 0;
};

}  // namespace

/// STL, text (solids become groups) and binary. Vertices of exactly equal position are merged.
MeshFile read_stl(std::string_view text, const std::string& name, const ReadOptions& options) {
  StlReader reader(text, name, options);
  reader.read();
  set_mesh(reader.file, reader.soup, name);
  return std::move(reader.file);
}

}  // namespace furrow::io
