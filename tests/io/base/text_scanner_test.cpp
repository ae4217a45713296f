// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/text_scanner.h"

#include <catch2/catch.hpp>
#include <clocale>

#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;
using io::TextScanner;

TEST_CASE("text_scanner: words, lines and comments") {
  TextScanner in("a  b\tc\r\n\n  # nothing\n d#e rest  of it  \nlast", "t");
  REQUIRE(in.next_line());
  CHECK(in.word() == "a");
  CHECK(in.word() == "b");
  CHECK(in.word() == "c");
  CHECK(in.word().empty());
  CHECK(in.next_word() == "d#e");
  CHECK(in.line() == 4);
  CHECK(in.rest_of_line() == "rest  of it");
  CHECK(in.next_word() == "last");
  CHECK(in.next_word().empty());
  CHECK_FALSE(in.next_line());
  CHECK(in.line() == 5);
}

TEST_CASE("text_scanner: a backslash joins lines only where asked for") {
  TextScanner joined("f 1\\\n2 \\\r\n 3\nx", "t", TextScanner::Continuation::backslash);
  REQUIRE(joined.next_line());
  for (const char* word : {"f", "1", "2", "3", ""}) CHECK(joined.word() == word);
  CHECK(joined.line() == 3);
  CHECK((joined.next_line() && joined.word() == "x"));
  TextScanner plain("a\\\nb", "t");
  CHECK((plain.next_word() == "a\\" && plain.next_word() == "b"));
  TextScanner end("a \\", "t", TextScanner::Continuation::backslash);
  CHECK((end.next_word() == "a" && end.next_word() == "\\" && end.next_word().empty()));
  TextScanner last("a \\\n", "t", TextScanner::Continuation::backslash);
  CHECK((last.next_word() == "a" && last.next_word().empty()));
}

TEST_CASE("text_scanner: numbers") {
  const TextScanner in("", "t");
  CHECK(in.finite_number("+0.1", "x") == 0.1);
  CHECK(in.finite_number("-1e-320", "x") == -1e-320);
  CHECK(in.finite_number("1e-9999", "x") == 0);
  CHECK(std::isnan(in.any_number("nan", "x")));
  CHECK(in.integer("-9223372036854775808", "i") == INT64_MIN);
  CHECK_THROWS_AS(in.integer("9223372036854775808", "i"), geometry::ContentError);
  CHECK_THROWS_AS(in.integer("1.0", "i"), geometry::ContentError);
  CHECK_THROWS_AS(in.finite_number("1e9999", "x"), geometry::ContentError);
  CHECK_THROWS_AS(in.any_number("", "x"), geometry::ContentError);
}

TEST_CASE("text_scanner: messages quote foreign bytes safely") {
  CHECK(io::in_quotes(std::string("a\x01\nb")) == "'a??b'");
  CHECK(io::in_quotes(std::string(100, 'x')) == "'" + std::string(30, 'x') + "…'");
}
