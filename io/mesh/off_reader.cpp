// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "io/base/text_scanner.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/mesh_readers.h"

namespace furrow::io {
namespace {

using namespace geometry;

/// What the first word of the file announces for each vertex: [ST][C][N]OFF.
struct OffHeader {
  bool textures = false, colors = false, normals = false;
  std::size_t vertices = 0, faces = 0;
};

OffHeader read_kind(TextScanner& in) {
  OffHeader header;
  const std::string_view keyword = in.next_word();
  std::string_view word = keyword;
  const auto take = [&word](std::string_view prefix) {
    const bool there = word.starts_with(prefix);
    if (there) word.remove_prefix(prefix.size());
    return there;
  };
  header.textures = take("ST");
  header.colors = take("C");
  header.normals = take("N");
  if (word == "4OFF" || word == "nOFF" || word == "4nOFF")
    in.fail(in_quotes(keyword) + ": vertices of other than three dimensions are not read; write OFF");
  if (word != "OFF") in.fail("the first word is not OFF but " + in_quotes(keyword) + ": this is no OFF file");
  return header;
}

/// The counts stand on the keyword's line or the next one with words; the number of edges may be missing.
void read_counts(TextScanner& in, std::size_t file_size, OffHeader& header) {
  const std::string_view first = in.next_word();
  if (first == "BINARY") in.fail("binary OFF is not read; write it as text, or as PLY");
  const std::int64_t vertices = in.integer(first, "number of vertices");
  const std::int64_t faces = in.integer(in.word(), "number of faces");
  if (const std::string_view edges = in.word(); !edges.empty()) in.integer(edges, "number of edges");
  if (vertices < 0 || faces < 0) in.fail("a negative count; correct it");
  // A vertex takes at least the six bytes of "0 0 0\n" (the last may lack its line's end), a face the two of
  // "0\n".
  header.vertices = static_cast<std::size_t>(vertices);
  header.faces = static_cast<std::size_t>(faces);
  if (header.vertices > (file_size + 1) / 6 || header.faces > (file_size + 1) / 2)
    in.fail("the header announces " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
            " faces, more than the file can hold; it is cut short or damaged");
}

class OffReader {
 public:
  OffReader(std::string_view text, const std::string& name, const ReadOptions& options)
      : in_(plain_text(text, name), name), options_(options) {
    header_ = read_kind(in_);
    read_counts(in_, text.size(), header_);
  }

  void read() {
    for (std::size_t i = 0; i < header_.vertices; ++i) read_vertex(i);
    for (std::size_t i = 0; i < header_.faces; ++i) read_face(i);
    if (face_colors_) file.warnings.push_back(in_.name() + ": colours of faces not read");
    if (header_.textures)
      for (const std::size_t c : soup.corners)
        soup.textures.push_back(c < textures_.size() ? textures_[c] : attribute::texture.default_value);
  }

  PolygonSoup soup;
  MeshFile file;

 private:
  void fail_short(const char* what, std::size_t i, std::size_t n) const {
    in_.fail("the file ends before " + std::string(what) + " " + std::to_string(i) + " of " +
             std::to_string(n) + ": it is cut short");
  }

  void read_vertex(std::size_t i) {
    std::string_view word = in_.next_word();
    if (word.empty()) fail_short("vertex", i, header_.vertices);
    std::array<double, 3> x{};
    for (int k = 0; k < 3; ++k, word = in_.word()) x[k] = in_.finite_number(word, "coordinate of a vertex");
    const auto point = from_file(x[0], x[1], x[2], options_);
    if (!point) in_.fail(bad_coordinate);
    soup.points.push_back(*point);
    if (header_.normals)
      for (int k = 0; k < 3; ++k, word = in_.word()) in_.any_number(word, "normal of a vertex");
    if (header_.colors) word = read_color(word);
    if (!header_.textures) return;
    TextureCoordinate t{};
    for (int k = 0; k < 2; ++k, word = in_.word())
      t[k] = in_.finite_number(word, "texture coordinate of a vertex");
    textures_.push_back(t);
  }

  /// Three or four numbers; whole ones go to 255, others to 1. Returns the next word. (Before texture
  /// coordinates a colour has four numbers.)
  std::string_view read_color(std::string_view word) {
    Color c = attribute::color.default_value;
    bool whole = true;
    int n = 0;
    for (; n < 4 && (n < 3 || !word.empty()); ++n, word = in_.word()) {
      c[n] = in_.finite_number(word, "colour of a vertex");
      whole = whole && word.find_first_of(".eE") == word.npos;
    }
    for (int k = 0; whole && k < n; ++k) c[k] /= 255;
    soup.colors.push_back(c);
    return word;
  }

  void read_face(std::size_t i) {
    const std::string_view word = in_.next_word();
    if (word.empty()) fail_short("face", i, header_.faces);
    const std::int64_t n = in_.integer(word, "number of corners of a face");
    if (n < 0) in_.fail("a face with a negative number of corners; correct it");
    for (std::int64_t k = 0; k < n; ++k) {
      const std::int64_t v = in_.integer(in_.word(), "corner of a face");
      if (v < 0) in_.fail("a corner with a negative index; OFF counts from 0");
      soup.corners.push_back(static_cast<std::size_t>(v));
    }
    soup.close_face();
    soup.face_lines.push_back(in_.line());
    if (!in_.word().empty()) {
      face_colors_ = true;
      in_.rest_of_line();
    }
  }

  TextScanner in_;
  ReadOptions options_;
  OffHeader header_;
  std::vector<TextureCoordinate> textures_;
  bool face_colors_ = false;
};

}  // namespace

/// Geomview OFF, COFF, NOFF, CNOFF, STOFF …, text only.
MeshFile read_off(std::string_view text, const std::string& name, const ReadOptions& options) {
  OffReader reader(text, name, options);
  reader.read();
  set_mesh(reader.file, reader.soup, name);
  return std::move(reader.file);
}

}  // namespace furrow::io
