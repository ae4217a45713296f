// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>

#include "jobs/base/card.h"

namespace furrow::cli {

/// Flags that set the fields of a job, one for each row of its card, in the groups of --help that the rows
/// name. The job must stay where it is until the command line is parsed.
void add_card(CLI::App& sub, const std::vector<jobs::CardRow>& card);

}  // namespace furrow::cli
