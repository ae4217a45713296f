// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/text_scanner.h"

#include <charconv>
#include <cmath>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// from_chars knows no '+'.
std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
  return plus ? word.substr(1) : word;
}

bool has_negative_exponent(std::string_view word) {
  const auto e = word.find_first_of("eE");
  return e != word.npos && e + 1 < word.size() && word[e + 1] == '-';
}

}  // namespace

std::string_view plain_text(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) return text.substr(3);
  const bool marked = text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE");
  const bool zeros = text.size() > 3 && (text[0] == 0) != (text[1] == 0) && (text[2] == 0) != (text[3] == 0);
  if (marked || zeros)
    throw geometry::ContentError(name + ": the text is UTF-16 or UTF-32; save it as UTF-8 or plain ASCII");
  return text;
}

std::string in_quotes(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, 30)) out += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  return out + (word.size() > 30 ? "…'" : "'");
}

TextScanner::TextScanner(std::string_view text, std::string name, Continuation continuation)
    : text_(text), name_(std::move(name)), continuation_(continuation) {
  if (text.find('\n') == text.npos && text.find('\r') != text.npos) newline_ = '\r';
}

bool TextScanner::next_line() {
  if (line_ > 0) {
    const auto end = text_.find(newline_, position_);
    position_ = end == text_.npos ? text_.size() : end + 1;
  }
  if (position_ >= text_.size()) return false;
  ++line_;
  return true;
}

bool TextScanner::skip_continuation() {
  if (continuation_ == Continuation::none || text_[position_] != '\\') return false;
  std::size_t next = position_ + 1;
  if (next < text_.size() && text_[next] == '\r' && newline_ != '\r') ++next;
  if (next >= text_.size() || text_[next] != newline_) return false;
  position_ = next + 1;
  ++line_;
  return true;
}

std::string_view TextScanner::word() {
  while (!at_line_end() && (is_blank(text_[position_]) || skip_continuation()))
    if (!at_line_end() && is_blank(text_[position_])) ++position_;
  if (at_line_end()) return {};
  if (text_[position_] == '#') {
    const auto end = text_.find(newline_, position_);
    position_ = end == text_.npos ? text_.size() : end;
    return {};
  }
  const std::size_t first = position_;
  std::size_t last = first;
  while (!at_line_end() && !is_blank(text_[position_])) {
    last = position_ + 1;
    if (skip_continuation()) {
      --last;
      break;
    }
    position_ = last;
  }
  return text_.substr(first, last - first);
}

std::string_view TextScanner::next_word() {
  if (line_ == 0 && !next_line()) return {};
  for (;;) {
    if (const auto found = word(); !found.empty()) return found;
    if (!next_line()) return {};
  }
}

std::string_view TextScanner::rest_of_line() {
  const auto end = std::min(text_.find(newline_, position_), text_.size());
  std::string_view rest = text_.substr(position_, end - position_);
  position_ = end;
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  return rest;
}

double TextScanner::any_number(std::string_view word, const char* what) const {
  const std::string_view digits = without_plus(word);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (word.empty()) fail(std::string("a number is missing (") + what + "), add it");
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
    fail(in_quotes(word) + " is not a number (" + what + "), correct it");
  if (error == std::errc::result_out_of_range) {
    if (has_negative_exponent(digits)) return 0;
    fail(in_quotes(word) + " is too large a number (" + what + "), correct it");
  }
  return value;
}

double TextScanner::finite_number(std::string_view word, const char* what) const {
  const double value = any_number(word, what);
  if (!std::isfinite(value)) fail(in_quotes(word) + " is not a finite number (" + what + "), correct it");
  return value;
}

std::int64_t TextScanner::integer(std::string_view word, const char* what) const {
  const std::string_view digits = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (word.empty()) fail(std::string("a whole number is missing (") + what + "), add it");
  if (error != std::errc() || end != digits.data() + digits.size())
    fail(in_quotes(word) + " is not a whole number (" + what + "), correct it");
  return value;
}

void TextScanner::fail(const std::string& what) const {
  throw geometry::ContentError(name_ + ":" + std::to_string(line_) + ": " + what);
}

}  // namespace furrow::io
