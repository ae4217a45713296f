// SPDX-License-Identifier: GPL-3.0-or-later
// Completion and man pages know every command and option that --help knows, and shells and roff take them.
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;

namespace {

/// Of the list at the end of furrow --help.
std::vector<std::string> commands() {
  std::istringstream help(run_furrow("--help").out);
  std::vector<std::string> names;
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (line.rfind("Subcommands:", 0) == 0) listed = true;
    if (std::smatch m; listed && std::regex_search(line, m, std::regex("^  ([a-z][a-z-]*)(\\s|$)")))
      names.push_back(m[1]);
  }
  return names;
}

std::set<std::string> options_in(const std::string& help) {
  std::set<std::string> names;
  const std::regex option("^  (?:-[a-zA-Z],)?(--[a-z][a-z0-9-]*)");
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);)
    if (std::smatch m; std::regex_search(line, m, option)) names.insert(m[1]);
  return names;
}

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  pclose(pipe);
  return text;
}

/// What bash offers for these words, the last of which is begun.
std::string bash_offers(const std::string& script, const std::string& words) {
  std::string file = script + ".try";
  write_text(file, "source " + script + "\nCOMP_WORDS=(" + words +
                       ")\nCOMP_CWORD=$((${#COMP_WORDS[@]}-1))\n_furrow\necho \" ${COMPREPLY[*]} \"\n");
  return output_of("bash " + file + " 2>&1");
}

/// What furrow writes to a terminal, with the variable set for it.
std::string on_terminal(const std::vector<std::string>& arguments, const char* variable) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  REQUIRE(child >= 0);
  if (child == 0) {
    unsetenv("NO_COLOR");
    setenv("TERM", "xterm", 1);
    if (variable) setenv(variable, "1", 1);
    std::vector<char*> words;
    static const std::string program = std::string(FURROW_BINARY_DIR) + "/furrow";
    words.push_back(const_cast<char*>(program.c_str()));
    for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
    words.push_back(nullptr);
    execv(program.c_str(), words.data());
    _exit(127);
  }
  std::string text;
  char part[4096];
  for (ssize_t n; (n = read(terminal, part, sizeof part)) > 0;) text.append(part, std::size_t(n));
  close(terminal);
  waitpid(child, nullptr, 0);
  return text;
}

}  // namespace

TEST_CASE("completion: every command of --help has its words in all shells", "[long]") {
  const ScratchDirectory scratch;
  std::vector<std::string> scripts;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Run run = run_furrow(std::string("completion ") + shell);
    REQUIRE(run.exit_code == 0);
    REQUIRE(run.err.empty());
    scripts.push_back(run.out);
    write_text(scratch / shell, run.out);
    if (is_installed(shell))
      CHECK(output_of(std::string(shell) + " -n " + (scratch / shell) + " 2>&1") == "");
    else
      WARN(shell << " is not installed: its script is not parsed");
  }
  const std::vector<std::string> names = commands();
  REQUIRE(names.size() >= 16);
  for (const std::string& name : names) {
    const std::set<std::string> options = options_in(run_furrow(name + " --help-all").out);
    INFO(name);
    CHECK(!options.empty());
    const std::string offered = bash_offers(scratch / "bash", "furrow " + name + " --");
    for (const std::string& option : options) {
      INFO(option);
      CHECK(offered.find(" " + option + " ") != std::string::npos);
      CHECK(scripts[1].find(option) != std::string::npos);
      CHECK(scripts[2].find(" -l " + option.substr(2) + " ") != std::string::npos);
    }
    for (const std::string& script : scripts) CHECK(script.find(name) != std::string::npos);
  }
}

TEST_CASE("completion: bash offers commands, words of an option, and leaves file names to the shell") {
  const ScratchDirectory scratch;
  write_text(scratch / "bash", run_furrow("completion bash").out);
  const auto offers = [&](const std::string& words) { return bash_offers(scratch / "bash", words); };
  CHECK(offers("furrow dr") == " drape \n");
  CHECK(offers("furrow help wri") == " wrinkle \n");
  CHECK(offers("furrow drape --colour ''") == " strain distance \n");
  CHECK(offers("furrow drape --colour = s") == " strain \n");
  CHECK(offers("furrow simulate --integrator xp") == " xpbd \n");
  CHECK(offers("furrow info --unit c") == " cm \n");
  CHECK(offers("furrow drape shi") == "  \n");
}

TEST_CASE("man: every command of --help has a page with its options, which roff takes", "[release]") {
  const ScratchDirectory scratch;
  REQUIRE(run_furrow("man --into " + scratch.path().string()).exit_code == 0);
  for (const std::string& name : commands()) {
    INFO(name);
    const std::string file = scratch / ("furrow-" + name + ".1"), page = read_text(file);
    CHECK(run_furrow("man " + name).out == page);
    CHECK(page.rfind(".TH \"FURROW", 0) == 0);
    for (std::string option : options_in(run_furrow(name + " --help-all").out)) {
      option = std::regex_replace(option, std::regex("-"), "\\-");
      CHECK(page.find("\\fB" + option + "\\fR") != std::string::npos);
    }
    CHECK(read_text(scratch / "furrow.1").find("furrow\\-" + name + " (1)") != std::string::npos);
    if (is_installed("groff")) CHECK(output_of("groff -man -Tutf8 -ww -z " + file + " 2>&1") == "");
  }
  CHECK(run_furrow("man").out == read_text(scratch / "furrow.1"));
  CHECK(run_furrow("man drap").exit_code == 2);
  CHECK(run_furrow("man --into " + (scratch / "none")).exit_code == 1);
}

TEST_CASE("usage: NO_COLOR, and what is no terminal, gets no control codes", "[release]") {
  const ScratchDirectory scratch;
  const std::string sheet = (source_dir() / "meshes/sheet.obj").string();
  const std::vector<std::string> call{"simulate", sheet, "--pin-vertices", "0", "--seconds",
                                      "0.05",     "-o",  scratch / "o.ply"};
  CHECK(on_terminal(call, nullptr).find('\033') != std::string::npos);
  CHECK(on_terminal(call, "NO_COLOR").find('\033') == std::string::npos);
  std::string line;
  for (const std::string& word : call) line += word + " ";
  const Run run = run_furrow(line + "--progress bar");
  CHECK(run.exit_code == 0);
  CHECK(run.err.find('\033') == std::string::npos);
  CHECK(run.err.find('\r') == std::string::npos);
}
