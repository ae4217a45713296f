// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "jobs/judge/judge.h"

/// What reports mean to whom calls the program, and numbers that several subcommands take.
namespace furrow::cli {

/// exit_ok, exit_not_converged where nothing meets the tolerance or the clock broke off, exit_interrupted.
int exit_code_of(const jobs::Judgement& j);

/// "1%" as 0.01. Throws UsageError, naming the option, for anything but a percentage in (0, 100).
double parse_share(const std::string& text, const std::string& option);

}  // namespace furrow::cli
