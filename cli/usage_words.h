// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace furrow::cli {

/// The word of the list that is nearest, if no more than a quarter of its letters and one are wrong; "":
/// none.
std::string nearest_of(const std::vector<std::string>& words, const std::string& word);

/// What CLI11 says of a word that it cannot take, in words that help: a length in another unit, a number out
/// of its range, a word that is none of a list. `command`: the subcommand's name.
std::string words_of_error(const CLI::App& app, const std::string& command, const std::string& what);

}  // namespace furrow::cli
