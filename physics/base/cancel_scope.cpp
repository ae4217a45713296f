// SPDX-License-Identifier: MIT
#include "physics/base/cancel_scope.h"

#include <string>
#include <utility>

#include "physics/base/progress.h"

namespace furrow::physics {
namespace {

thread_local CancelScope* innermost = nullptr;

}  // namespace

CancelScope::CancelScope(std::function<bool()> cancelled)
    : cancelled_(std::move(cancelled)), outer_(innermost) {
  innermost = this;
}

CancelScope::~CancelScope() { innermost = outer_; }

bool is_cancelled() { return innermost && innermost->cancelled_(); }

void throw_if_cancelled(const char* who) {
  if (is_cancelled()) throw Cancelled(std::string(who) + ": cancelled");
}

}  // namespace furrow::physics
