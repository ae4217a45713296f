// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <span>

#include "geometry/mesh/errors.h"
#include "io/base/name_table.h"
#include "io/base/own_mark.h"
#include "io/base/text_scanner.h"
#include "io/mesh/chain_segments.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/mesh_readers.h"

namespace furrow::io {
namespace {

using namespace geometry;

constexpr std::size_t no_texture = static_cast<std::size_t>(-1);

/// Statements of the format that say nothing about our meshes.
constexpr std::array passed_over = {
    "vn",     "vp",       "p",        "s",          "mg",        "cstype", "deg",  "bmat",
    "step",   "curv",     "curv2",    "surf",       "parm",      "trim",   "hole", "scrv",
    "sp",     "end",      "con",      "bevel",      "lod",       "call",   "csh",  "maplib",
    "usemap", "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech",  "stech"};

struct LineElement {
  std::vector<std::size_t> vertices;
  std::size_t line = 0;
  std::string object;  ///< that it belongs to, or else its group
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name, const ReadOptions& options)
      : in_(plain_text(text, name), name, TextScanner::Continuation::backslash), options_(options) {
    if (std::ranges::count(text.substr(0, 4096), '\0') > 0)
      in_.fail("zero bytes: this is no text, so no OBJ file");
  }

  void read() {
    while (in_.next_line()) read_statement();
    resolve_textures();
    resolve_polylines();
    finish_colors();
  }

  /// The polylines object by object, in the order in which objects have lines first. After read().
  std::vector<NamedPolyline> polylines_by_object() const {
    std::vector<std::string> names;
    NameTable table(names);
    std::vector<std::vector<LineElement>> of_object(1);  // the first: of no name
    for (const LineElement& element : lines_) {
      const auto index = static_cast<std::size_t>(table.index(element.object) + 1);
      of_object.resize(std::max(of_object.size(), index + 1));
      of_object[index].push_back(element);
    }
    std::vector<NamedPolyline> result;
    for (std::size_t i = 0; i < of_object.size(); ++i)
      for (Polyline& line : chained(of_object[i]))
        result.push_back({std::move(line), i == 0 ? "" : names[i - 1]});
    return result;
  }

  PolygonSoup soup;
  MeshFile file;

 private:
  void read_statement() {
    if (comment()) return;
    const std::string_view word = in_.word();
    if (word.empty()) return;
    if (word == "v")
      read_vertex();
    else if (word == "vt")
      read_texture();
    else if (word == "f" || word == "fo")
      read_face();
    else if (word == "l")
      read_line();
    else if (word == "g" || word == "o")
      read_name(word == "o");
    else if (word == "usemtl")
      material_ = materials_.index(in_.rest_of_line());
    else if (word == "mtllib")
      file.material_libraries.emplace_back(in_.rest_of_line());
    else if (std::ranges::find(passed_over, word) == passed_over.end())
      warn_unknown(word);
  }

  void read_name(bool of_object) {
    const std::string_view name = in_.rest_of_line();
    group_ = groups_.index(name);
    (of_object ? object_name_ : group_name_) = name;
  }

  bool comment() {
    TextScanner ahead = in_;
    const std::string_view line = ahead.rest_of_line();
    if (!line.starts_with('#')) return false;
    std::string_view text = line.substr(1);
    if (text.starts_with(' ')) text.remove_prefix(1);
    if (text != own_mark) file.comments.emplace_back(text);
    return true;
  }

  void warn_unknown(std::string_view word) {
    if (warned_) return;
    warned_ = true;
    file.warnings.push_back(in_.name() + ":" + std::to_string(in_.line()) + ": unknown statement " +
                            in_quotes(word) + "; it and others like it are passed over");
  }

  void read_vertex() {
    std::array<double, 7> c{};
    std::size_t n = 0;
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word(), ++n) {
      if (n == c.size()) in_.fail("a vertex has more than seven numbers; x y z, w or a colour may follow");
      c[n] = in_.finite_number(word, n < 3 ? "coordinate of a vertex" : "w or colour of a vertex");
    }
    if (n < 3 || n == 5)
      in_.fail("a vertex has " + std::to_string(n) + " numbers; 3, 4 (w), 6 or 7 (colour) are read");
    const auto point = from_file(c[0], c[1], c[2], options_);
    if (!point) in_.fail(bad_coordinate);
    soup.points.push_back(*point);
    if (n < 6) return;
    soup.colors.resize(soup.points.size() - 1, attribute::color.default_value);
    soup.colors.push_back({c[3], c[4], c[5], n == 7 ? c[6] : 1.0});
  }

  void read_texture() {
    TextureCoordinate t{in_.finite_number(in_.word(), "u of a texture coordinate"), 0};
    if (const std::string_view v = in_.word(); !v.empty())
      t[1] = in_.finite_number(v, "v of a texture coordinate");
    textures_.push_back(t);
  }

  /// An index from 1, or from -1 backwards, as one from 0. Positive ones may name what comes later.
  std::size_t resolve(std::string_view digits, std::size_t count, const char* what) {
    const std::int64_t i = in_.integer(digits, what);
    if (i > 0) return static_cast<std::size_t>(i - 1);
    if (i == 0) in_.fail(std::string("index 0 (") + what + "); OBJ counts from 1");
    if (i < -static_cast<std::int64_t>(count))
      in_.fail("index " + std::to_string(i) + " (" + what + ") reaches back beyond the first of " +
               std::to_string(count) + "; correct it");
    return count - static_cast<std::size_t>(-i);
  }

  void read_face() {
    const std::size_t first = soup.corners.size();
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      const auto slash = word.find('/');
      soup.corners.push_back(resolve(word.substr(0, slash), soup.points.size(), "vertex of a face"));
      const std::string_view rest = slash == word.npos ? std::string_view() : word.substr(slash + 1);
      const auto second = rest.find('/');
      const std::string_view texture = rest.substr(0, second);
      face_textures_.push_back(
          texture.empty() ? no_texture : resolve(texture, textures_.size(), "texture coordinate of a face"));
      const std::string_view normal = second == rest.npos ? std::string_view() : rest.substr(second + 1);
      if (!normal.empty()) in_.integer(normal, "normal of a face");
    }
    if (soup.corners.size() < first + 3)
      in_.fail("a face has fewer than three corners; add them or drop the line");
    soup.close_face();
    soup.face_lines.push_back(in_.line());
    soup.groups.push_back(group_);
    soup.materials.push_back(material_);
  }

  void read_line() {
    LineElement element{{}, in_.line(), object_name_.empty() ? group_name_ : object_name_};
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word())
      element.vertices.push_back(
          resolve(word.substr(0, word.find('/')), soup.points.size(), "vertex of a line"));
    if (element.vertices.size() < 2) in_.fail("a line has fewer than two vertices; add them or drop it");
    lines_.push_back(std::move(element));
  }

  [[noreturn]] void fail_at(std::size_t line, const std::string& what) const {
    throw ContentError(in_.name() + ":" + std::to_string(line) + ": " + what);
  }

  void resolve_textures() {
    const auto used = [](std::size_t t) { return t != no_texture; };
    if (std::ranges::none_of(face_textures_, used)) return;
    for (std::size_t f = 0; f < soup.faces(); ++f)
      for (std::size_t c = soup.first_corner[f]; c < soup.first_corner[f + 1]; ++c) {
        const std::size_t t = face_textures_[c];
        if (used(t) && t >= textures_.size())
          fail_at(soup.face_lines[f], "a corner names a texture coordinate beyond the last of " +
                                          std::to_string(textures_.size()) + "; correct the index");
        soup.textures.push_back(used(t) ? textures_[t] : attribute::texture.default_value);
      }
  }

  void check_lines() const {
    for (const LineElement& element : lines_)
      for (const std::size_t v : element.vertices)
        if (v >= soup.points.size())
          fail_at(element.line, "a line names a vertex beyond the last of " +
                                    std::to_string(soup.points.size()) +
                                    "; correct the index or add the vertex");
  }

  void resolve_polylines() {
    check_lines();
    for (Polyline& line : chained(lines_)) file.polylines.push_back(std::move(line));
  }

  /// Longer elements as they are, those of two vertices chained.
  std::vector<Polyline> chained(std::span<const LineElement> lines) const {
    std::vector<std::array<std::size_t, 2>> segments;
    std::vector<Chain> chains;
    std::vector<Polyline> result;
    for (const LineElement& element : lines) {
      if (element.vertices.size() == 2) {
        segments.push_back({element.vertices[0], element.vertices[1]});
        continue;
      }
      Chain chain{element.vertices,
                  element.vertices.size() > 3 && element.vertices.front() == element.vertices.back()};
      if (chain.closed) chain.vertices.pop_back();
      chains.push_back(std::move(chain));
    }
    std::ranges::move(chain_segments(segments), std::back_inserter(chains));
    for (Chain& chain : chains) {
      Polyline line{{}, std::move(chain.vertices), chain.closed};
      for (const std::size_t v : line.vertices) line.points.push_back(soup.points[v]);
      result.push_back(std::move(line));
    }
    return result;
  }

  /// Most programs write colours from 0 to 1, some from 0 to 255.
  void finish_colors() {
    if (soup.colors.empty()) return;
    soup.colors.resize(soup.points.size(), attribute::color.default_value);
    const auto bright = [](const Color& c) { return std::max({c[0], c[1], c[2]}) > 1; };
    if (std::ranges::none_of(soup.colors, bright)) return;
    file.warnings.push_back(in_.name() + ": vertex colours above 1 are taken as going from 0 to 255");
    for (Color& c : soup.colors)
      if (c != attribute::color.default_value)
        c = {c[0] / 255, c[1] / 255, c[2] / 255, c[3] > 1 ? c[3] / 255 : c[3]};
  }

  TextScanner in_;
  ReadOptions options_;
  std::vector<TextureCoordinate> textures_;
  std::vector<std::size_t> face_textures_;
  std::vector<LineElement> lines_;
  NameTable groups_{file.group_names}, materials_{file.material_names};
  int group_ = -1, material_ = -1;
  std::string object_name_, group_name_;
  bool warned_ = false;
};

}  // namespace

MeshFile read_obj(std::string_view text, const std::string& name, const ReadOptions& options) {
  ObjReader reader(text, name, options);
  reader.read();
  PolygonSoup& soup = reader.soup;
  if (reader.file.group_names.empty()) soup.groups.clear();
  if (reader.file.material_names.empty()) soup.materials.clear();
  soup.has_lines = !reader.file.polylines.empty();
  set_mesh(reader.file, soup, name, options.chains);
  return std::move(reader.file);
}

std::vector<NamedPolyline> read_obj_polylines(std::string_view text, const std::string& name,
                                              const ReadOptions& options) {
  ObjReader reader(text, name, options);
  reader.read();
  return reader.polylines_by_object();
}

}  // namespace furrow::io
