// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

namespace furrow::physics {

/// While it lives, what takes long asks it whether to go on: work within one step or iteration, too, which no
/// observer sees, and in geometry each face or point. It counts in its own thread, where it is asked, as
/// often as every microsecond; the innermost one counts, threads of a ThreadPool follow the one that called
/// them.
class CancelScope {
 public:
  /// cancelled: cheap; true: what asks throws Cancelled, or ends as if its observer had stopped it.
  explicit CancelScope(std::function<bool()> cancelled);
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  friend bool is_cancelled();
  std::function<bool()> cancelled_;
  CancelScope* outer_;
};

/// Asks the scope of this thread; false without one.
bool is_cancelled();
/// Throws Cancelled, "<who>: cancelled", if it is.
void throw_if_cancelled(const char* who);

}  // namespace furrow::physics
