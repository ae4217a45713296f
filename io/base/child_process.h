// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace furrow::io {

struct ChildLimits {
  /// Address space beyond this process's own [bytes]; > 0. Not held under the address sanitizer, which needs
  /// terabytes of it.
  std::size_t memory_bytes = std::size_t{1} << 30;
  unsigned cpu_seconds = 60;                        ///< [s]; > 0
  unsigned seconds = 120;                           ///< of waiting for the next bytes of the answer [s]; > 0
  std::size_t answer_bytes = std::size_t{1} << 30;  ///< longest answer [bytes]; > 0
};

/// Runs `work` in a forked child with limits and returns what it returned, for a library that may crash, hang
/// or devour memory on a bad file. The child has no output but its answer (standard output and error are
/// closed), runs no exit handlers, and ends with this process. Throws geometry::ContentError with the reason
/// if `work` throws, crashes or exceeds a limit; std::runtime_error if no child can be started. Cost: a fork
/// and a copy of the answer.
std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits = {});

}  // namespace furrow::io
