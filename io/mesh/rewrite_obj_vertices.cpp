// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/rewrite_obj_vertices.h"

#include <charconv>

#include "geometry/mesh/errors.h"
#include "io/base/number_text.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/material_libraries.h"

namespace furrow::io {
namespace {

/// Walks over the words of a text; a backslash at the end of a line joins it to the next.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  bool at_end() const { return position_ >= text_.size(); }
  std::size_t position() const { return position_; }

  /// The next word of this line; empty at its end.
  std::string_view word() {
    for (; !at_end(); ++position_) {
      if (const std::size_t joint = joint_length()) {
        position_ += joint - 1;
        continue;
      }
      if (text_[position_] != ' ' && text_[position_] != '\t') break;
    }
    const std::size_t start = position_;
    while (!at_end() && !is_space(text_[position_]) && !joint_length()) ++position_;
    return text_.substr(start, position_ - start);
  }

  /// All words that are left of this line, with the blanks between them.
  std::string_view words() {
    const std::size_t first = word().size(), start = position_ - first;
    std::size_t end = position_;
    while (!word().empty()) end = position_;
    return text_.substr(start, end - start);
  }

  /// To behind the end of this line.
  void skip_line() {
    while (!at_end()) {
      if (const std::size_t joint = joint_length()) {
        position_ += joint;
      } else if (const char c = text_[position_++]; c == '\n' || (c == '\r' && !is_next('\n'))) {
        return;
      }
    }
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  bool is_next(char c) const { return position_ < text_.size() && text_[position_] == c; }
  /// Of a backslash and the line end behind it; 0: none stands here.
  std::size_t joint_length() const {
    const std::string_view rest = text_.substr(position_, 3);
    return rest == "\\\r\n" ? 3 : rest.starts_with("\\\n") || rest.starts_with("\\\r") ? 2 : 0;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

bool has_value(std::string_view word, double value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double read = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), read);
  return error == std::errc() && end == word.data() + word.size() && read == value;
}

}  // namespace

std::string rewrite_obj_vertices(std::string_view text, const std::string& name,
                                 std::span<const geometry::Point> positions, const WriteOptions& options,
                                 const std::filesystem::path& there, const std::filesystem::path& here) {
  std::string result;
  result.reserve(text.size() + text.size() / 4);
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8; it stands before the first word
  if (text.starts_with(mark)) {
    result = mark;
    text.remove_prefix(mark.size());
  }
  std::size_t copied = 0, vertex = 0;
  const auto copy_until = [&](std::string_view word) {
    const std::size_t start = static_cast<std::size_t>(word.data() - text.data());
    result += text.substr(copied, start - copied);
    copied = start + word.size();
  };
  for (Words words(text); !words.at_end(); words.skip_line()) {
    const std::string_view keyword = words.word();
    if (keyword == "mtllib") {
      const std::string_view library = words.words();
      if (!library.empty()) copy_until(library), result += library_from(std::string(library), there, here);
    }
    if (keyword != "v") continue;
    if (vertex == positions.size())
      throw geometry::ContentError(name + ": has more vertices than the mesh that was read from it");
    const geometry::Vector p = to_file(positions[vertex++], options);
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words.word();
      if (word.empty())
        throw geometry::ContentError(name + ": vertex " + std::to_string(vertex) + " has no three numbers");
      copy_until(word);
      if (has_value(word, p[k]))
        result += word;
      else
        append_number(result, p[k]);
    }
  }
  return result += text.substr(copied);
}

}  // namespace furrow::io
