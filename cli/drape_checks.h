// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "cli/common.h"
#include "io/scene/toml_document.h"
#include "jobs/drape.h"

/// What the command line of `furrow drape` says in words of its own.
namespace furrow::cli {

/// Bands as "top=0.9". Throws UsageError that tells what to write.
std::vector<Band> parse_bands(const std::vector<std::string>& texts);

/// The fabrics of --compare, parted by commas. Throws UsageError where a name is missing.
std::vector<std::string> parse_fabrics(const std::string& text);

/// Warns once of all settings that were said and that rest has no use for: what moves, and how long.
void warn_of_unused_settings(const io::TomlDocument& document, const CommonArguments& common);

}  // namespace furrow::cli
