// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/exit_codes.h"

#include <cstdlib>

#include "cli/common.h"

namespace furrow::cli {

int exit_code_of(const jobs::Judgement& j) {
  if (j.broken == jobs::Broken::interrupted) return exit_interrupted;
  return j.broken == jobs::Broken::clock || j.chosen < 0 ? exit_not_converged : exit_ok;
}

double parse_share(const std::string& text, const std::string& option) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || std::string(end) != "%" || !(value > 0 && value < 100))
    throw UsageError(option + " takes a share of the garment's size such as 1%, not '" + text + "'");
  return value / 100;
}

}  // namespace furrow::cli
