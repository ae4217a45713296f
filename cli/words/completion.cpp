// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "cli/words/command_words.h"
#include "io/base/atomic_file.h"

namespace furrow::cli {
namespace {

struct ManArguments : CommonArguments {
  std::string command, folder;
};

void write_pages(const CLI::App& app, const std::string& folder, Listener& listener) {
  if (!std::filesystem::is_directory(folder))
    throw std::runtime_error(folder + ": there is no such folder; make it first");
  const auto write = [&](const std::string& name, const std::string& page) {
    const std::filesystem::path path = std::filesystem::path(folder) / (name + ".1");
    check_replaced({path.string()}, {}, listener);
    io::write_atomically(path, [&](std::ostream& out) { out << page; });
  };
  write("furrow", man_page(app));
  for (const CLI::App* sub : shown_subcommands(app)) write("furrow-" + sub->get_name(), man_page(app, *sub));
}

void print_page(const CLI::App& app, const ManArguments& a) {
  if (!a.folder.empty()) {
    Terminal terminal(a);
    return write_pages(app, a.folder, terminal);
  }
  if (a.command.empty()) {
    std::cout << man_page(app);
    return flush_output();
  }
  for (const CLI::App* sub : shown_subcommands(app))
    if (sub->get_name() == a.command) {
      std::cout << man_page(app, *sub);
      return flush_output();
    }
  throw UsageError("there is no subcommand '" + a.command + "'; furrow --help lists them");
}

void add_completion(CLI::App& app, int&) {
  auto shell = std::make_shared<std::string>();
  CLI::App* sub =
      app.add_subcommand("completion",
                         "Print the script that completes furrow's words in a shell\n\n"
                         "The installed package has it where shells look for it.\n\n"
                         "  furrow completion bash > ~/.local/share/bash-completion/completions/furrow");
  sub->add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  sub->callback([shell, &app] {
    std::cout << completion_script(app, *shell);
    flush_output();
  });
}

const Subcommand completion_subcommand(900, add_completion);

void add_man(CLI::App& app, int&) {
  auto a = std::make_shared<ManArguments>();
  CLI::App* sub = app.add_subcommand("man",
                                     "Print a manual page, as man reads it\n\n"
                                     "  furrow man drape | man -l -");
  sub->add_option("command", a->command, "page of this subcommand; none: of furrow itself");
  sub->add_option("--into", a->folder, "write all pages into this folder, as furrow.1, furrow-drape.1, ...");
  sub->add_flag("--replace", a->replace, "write over pages that furrow did not write");
  sub->callback([a, &app] { print_page(app, *a); });
}

const Subcommand man_subcommand(910, add_man);

}  // namespace
}  // namespace furrow::cli
