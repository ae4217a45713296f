// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace furrow::studio {

/// What came of doing a project again.
struct ReplayReport {
  std::size_t intentions = 0;  ///< that its log holds
  std::size_t steps = 0;       ///< of the history that they made
  std::string difference;  ///< where it first went another way, in words; empty: it ended in the same bits
  bool cancelled = false;
};

/// Does all that the log of the project in `folder` says once more, from its first step on, in the new folder
/// `into`, and compares names of steps, lines and the shape, to the last bit. The project itself is read
/// alone. `go_on`: asked before each intention; false stops. Throws as Project and jobs::open_sketch() for a
/// project that cannot be opened, std::invalid_argument where `into` is there and not empty.
ReplayReport replay(const std::filesystem::path& folder, const std::filesystem::path& into,
                    const std::function<bool(std::size_t done, std::size_t of)>& go_on);

}  // namespace furrow::studio
