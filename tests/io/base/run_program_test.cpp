// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/run_program.h"

#include <catch2/catch.hpp>
#include <csignal>

#include "io/base/shell_word.h"

using namespace furrow::io;

TEST_CASE("run_program: it tells how a program ended and what it wrote") {
  const ProgramRun run = run_program("sh", {"-c", "echo out; echo err >&2; exit 7"});
  CHECK(run.exit_code == 7);
  CHECK(run.signal == 0);
  CHECK(run.out == "out\n");
  CHECK(run.err == "err\n");
  CHECK(run.seconds > 0);
  CHECK(run.peak_bytes > 0);
  CHECK(run_program("sh", {"-c", "kill -9 $$"}).signal == SIGKILL);
  CHECK(run_program("cat", {}).exit_code == 0);  // its standard input is closed
  CHECK_THROWS_AS(run_program("furrow-is-not-called-so", {}), std::runtime_error);
}

TEST_CASE("shell_word: a shell reads the word back") {
  for (const std::string word : {"plain", "", "two words", "it's", "$HOME `x` \"y\" \\", "*?[]~#&|;<>(){}!"})
    CHECK(run_program("sh", {"-c", "printf %s " + shell_word(word)}).out == word);
  CHECK(shell_word("a/b.c") == "a/b.c");
  for (const std::string word : {"a\nb", "\x1b[2J", "tab\t", "\x7f"})
    CHECK_THROWS_AS(shell_word(word), std::invalid_argument);
}
