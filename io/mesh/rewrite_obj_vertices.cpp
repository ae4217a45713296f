// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/rewrite_obj_vertices.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/mesh.h"
#include "io/base/number_text.h"
#include "io/base/text_scanner.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/material_libraries.h"

namespace furrow::io {
namespace {

/// As the reader has it: a backslash at the end of a line joins it to the next.
TextScanner words_of(std::string_view text) { return {text, "", TextScanner::Continuation::backslash}; }

/// All words that are left of this line, with the blanks between them.
std::string_view words_left(TextScanner& in) {
  const std::string_view first = in.word();
  std::string_view last = first;
  for (std::string_view word = first; !word.empty(); word = in.word()) last = word;
  return {first.data(), static_cast<std::size_t>(last.data() + last.size() - first.data())};
}

bool has_value(std::string_view word, double value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double read = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), read);
  return error == std::errc() && end == word.data() + word.size() && read == value;
}

/// A corner of a face as the file writes it: "3", "3/2", "3//1" or "3/2/1".
struct ObjCorner {
  std::size_t vertex = 0, normal = 0;  ///< from 1; 0: none that can be used
  std::size_t normal_at = 0;           ///< where its number stands in the word
};

/// Numbers below zero count from the last of `vertices` and `normals`.
ObjCorner corner_of(std::string_view word, std::size_t vertices, std::size_t normals) {
  const auto number = [](std::string_view digits, std::size_t count) -> std::size_t {
    long long n = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (n < 0) n += static_cast<long long>(count) + 1;
    return n >= 1 && n <= static_cast<long long>(count) ? static_cast<std::size_t>(n) : 0;
  };
  const std::size_t first = word.find('/'), second = first == word.npos ? first : word.find('/', first + 1);
  ObjCorner corner{number(word.substr(0, first), vertices), 0, 0};
  if (second != word.npos) corner.normal_at = second + 1;
  if (second != word.npos) corner.normal = number(word.substr(second + 1), normals);
  return corner;
}

using geometry::Vector;

/// Normals for the places that vertices have now, one for each vertex and normal that corners name together.
class ObjNormals {
 public:
  ObjNormals(std::string_view text, std::span<const Vector> places) : places_(places) {
    for (TextScanner in = words_of(text); in.next_line();) {
      const std::string_view keyword = in.word();
      if (keyword == "v") take_vertex(in);
      if (keyword == "vn") texts_.push_back(words_left(in));
      if (keyword == "f") take_face(in);
    }
  }

  /// Whether any is not what it was.
  bool moved() const {
    return std::ranges::any_of(made_, [](const Made& made) { return made.moved; });
  }

  /// From 1; 0: none.
  std::size_t number_of(const ObjCorner& corner) const {
    const auto found = numbers_.find(key_of(corner));
    return corner.vertex == 0 || corner.normal == 0 || found == numbers_.end() ? 0 : found->second;
  }

  std::string lines(const char* line_end) const {
    std::string lines;
    for (const Made& made : made_) {
      lines += "vn ";
      const double length = std::sqrt(made.sum.squared_length());
      if (!made.moved || !(length > 0) || !std::isfinite(length)) {
        lines += texts_[made.before - 1];
      } else {
        for (int k = 0; k < 3; ++k)
          append_number(lines, std::round(made.sum[k] / length * 1e6) / 1e6), lines += k < 2 ? " " : "";
      }
      lines += line_end;
    }
    return lines;
  }

 private:
  struct Made {
    std::size_t before = 0;  ///< the file's, from 1
    Vector sum{0, 0, 0};
    bool moved = false;
  };

  static std::uint64_t key_of(const ObjCorner& c) { return std::uint64_t{c.vertex} << 32 | c.normal; }

  void take_vertex(TextScanner& in) {
    const std::size_t v = moved_.size();
    bool stays = v < places_.size();
    for (int k = 0; stays && k < 3; ++k) stays = has_value(in.word(), places_[v][k]);
    moved_.push_back(!stays);
  }

  void take_face(TextScanner& in) {
    std::vector<ObjCorner> corners;
    for (std::string_view word; !(word = in.word()).empty();)
      corners.push_back(corner_of(word, moved_.size(), texts_.size()));
    Vector sum(0, 0, 0);
    bool moved = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t a = corners[i].vertex, b = corners[(i + 1) % corners.size()].vertex;
      if (a == 0 || b == 0 || std::max(a, b) > places_.size()) return;
      sum += CGAL::cross_product(places_[a - 1] - places_[corners[0].vertex - 1],
                                 places_[b - 1] - places_[corners[0].vertex - 1]);
      moved = moved || moved_[a - 1];
    }
    for (const ObjCorner& corner : corners) {
      if (corner.normal == 0) continue;
      const auto [found, is_new] = numbers_.emplace(key_of(corner), made_.size() + 1);
      if (is_new) made_.push_back({corner.normal});
      Made& made = made_[found->second - 1];
      made.sum += sum;
      made.moved = made.moved || moved;
    }
  }

  std::span<const Vector> places_;
  std::vector<char> moved_;              ///< by vertex of the file
  std::vector<std::string_view> texts_;  ///< of the file's normals
  std::vector<Made> made_;
  std::unordered_map<std::uint64_t, std::size_t> numbers_;  ///< of made_, from 1, by key_of()
};

/// Copies a text, with other words in it.
class ObjRewriter {
 public:
  ObjRewriter(std::string_view text, std::span<const Vector> places)
      : text_(text), places_(places), normals_(text, places), new_normals_(normals_.moved()) {
    result_.reserve(text.size() + text.size() / 4);
  }

  std::string rewritten(const std::string& name, const std::filesystem::path& there,
                        const std::filesystem::path& here) {
    TextScanner in = words_of(text_);
    for (bool more = in.next_line(); more;) {
      const std::string_view keyword = in.word();
      if (keyword == "mtllib") {
        const std::string_view library = words_left(in);
        if (!library.empty()) put(library, library_from(std::string(library), there, here));
      }
      if (keyword == "v") write_vertex(in, name);
      if (keyword == "f" && new_normals_) write_face(in);
      if (keyword == "vn") ++normal_;
      more = in.next_line();
      if (keyword == "vn" && new_normals_) write_normals(keyword, in.position());
    }
    return result_ += text_.substr(copied_);
  }

 private:
  /// `with` in place of the word.
  void put(std::string_view word, std::string_view with) {
    const std::size_t start = static_cast<std::size_t>(word.data() - text_.data());
    result_ += text_.substr(copied_, start - copied_);
    result_ += with;
    copied_ = start + word.size();
  }

  void write_vertex(TextScanner& in, const std::string& name) {
    if (vertex_ == places_.size())
      throw geometry::ContentError(name + ": has more vertices than the mesh that was read from it");
    const Vector& p = places_[vertex_++];
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = in.word();
      if (word.empty())
        throw geometry::ContentError(name + ": vertex " + std::to_string(vertex_) + " has no three numbers");
      std::string number(word);
      if (!has_value(word, p[k])) number.clear(), append_number(number, p[k]);
      put(word, number);
    }
  }

  /// All where the first one stood, none where the others did.
  void write_normals(std::string_view keyword, std::size_t line_end) {
    const std::size_t start = static_cast<std::size_t>(keyword.data() - text_.data());
    const bool of_dos = text_.substr(start, line_end - start).ends_with("\r\n");
    put(text_.substr(start, line_end - start), normal_ == 1 ? normals_.lines(of_dos ? "\r\n" : "\n") : "");
  }

  void write_face(TextScanner& in) {
    for (std::string_view word; !(word = in.word()).empty();) {
      const ObjCorner corner = corner_of(word, vertex_, normal_);
      if (const std::size_t number = normals_.number_of(corner))
        put(word.substr(corner.normal_at), std::to_string(number));
    }
  }

  std::string_view text_;
  std::span<const Vector> places_;
  ObjNormals normals_;
  bool new_normals_;
  std::string result_;
  std::size_t copied_ = 0, vertex_ = 0, normal_ = 0;
};

}  // namespace

std::string rewrite_obj_vertices(std::string_view text, const std::string& name,
                                 std::span<const geometry::Point> positions, const WriteOptions& options,
                                 const std::filesystem::path& there, const std::filesystem::path& here) {
  std::vector<Vector> places;
  places.reserve(positions.size());
  for (const geometry::Point& p : positions) places.push_back(to_file(p, options));
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8; it stands before the first word
  const std::size_t first = text.starts_with(mark) ? mark.size() : 0;
  return std::string(text.substr(0, first)) +
         ObjRewriter(text.substr(first), places).rewritten(name, there, here);
}

}  // namespace furrow::io
