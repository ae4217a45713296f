// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace furrow::cli {

/// Parses the flags `recorded` into `options`, and over them those that were `typed` on the command line;
/// of `typed`, what `options` does not know is passed over. Throws CLI::ParseError for recorded flags that
/// cannot be read.
void parse_recorded(CLI::App& options, const std::string& recorded, const CLI::App& typed);

}  // namespace furrow::cli
