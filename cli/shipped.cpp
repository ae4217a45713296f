// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/shipped.h"

#include "io/base/run_program.h"

namespace furrow::cli {

std::filesystem::path shipped(const std::string& name) {
  std::error_code none;
  std::filesystem::path at = io::this_program().parent_path();
  const std::filesystem::path installed = at.parent_path() / "share/furrow" / name;
  if (std::filesystem::exists(installed, none)) return installed;
  for (int up = 0; up < 3; ++up, at = at.parent_path())
    if (std::filesystem::exists(at / name, none)) return at / name;
  return {};
}

}  // namespace furrow::cli
