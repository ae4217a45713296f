// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace furrow::io {

/// The text without a UTF-8 byte order mark. Throws geometry::ContentError for UTF-16 and UTF-32.
std::string_view plain_text(std::string_view text, const std::string& name);

/// Words and numbers of a text, with the line that an error names. Lines end with LF, CR LF or (if the text
/// has no LF at all) CR. A '#' where a word could begin ends a line's words. Numbers are read in double
/// precision, whatever the locale. Keeps a view: the text must outlive the scanner.
class TextScanner {
 public:
  enum class Continuation { none, backslash };  ///< a backslash at a line's end joins the next line to it

  /// `name` stands in the messages.
  TextScanner(std::string_view text, std::string name, Continuation continuation = Continuation::none);

  /// Goes to the start of the next line (at first: the first line). Returns false at the end of the text.
  bool next_line();
  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word of the text, on any line; empty at the end of the text.
  std::string_view next_word();
  /// The rest of this line, without blanks at both ends; a '#' is part of it.
  std::string_view rest_of_line();

  std::size_t line() const { return line_; }
  std::size_t position() const { return position_; }  ///< [bytes] of the next unread byte
  const std::string& name() const { return name_; }

  /// The word as a finite number, or as any number (nan and inf, too); `what` stands in the message.
  double finite_number(std::string_view word, const char* what) const;
  double any_number(std::string_view word, const char* what) const;
  std::int64_t integer(std::string_view word, const char* what) const;

  /// Throws geometry::ContentError "name:line: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool at_line_end() const { return position_ >= text_.size() || text_[position_] == newline_; }
  bool skip_continuation();

  std::string_view text_;
  std::string name_;
  Continuation continuation_;
  char newline_ = '\n';
  std::size_t position_ = 0, line_ = 0;
};

/// The word between quotation marks for a message: cut after 30 bytes, control characters replaced by '?'.
std::string in_quotes(std::string_view word);

}  // namespace furrow::io
