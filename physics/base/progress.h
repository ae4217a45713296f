// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <stdexcept>

namespace furrow::physics {

/// Asked now and then by a long operation, in the thread that called it, with the share that is done (in [0,
/// 1], never falling; of the work, not of the time). false: stop. Empty: nobody asks.
using Progress = std::function<bool(double)>;

/// Thrown by an operation whose Progress said false. Nothing is left half done.
struct Cancelled : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown by an operation that would take more than one of its options allows, before it does. The message
/// says how much, and which other option makes it less.
struct TooMuchWork : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace furrow::physics
