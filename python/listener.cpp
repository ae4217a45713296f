// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/listener.h"

namespace furrow::python {
namespace {

constexpr std::chrono::milliseconds between_calls{50};

}  // namespace

void PythonListener::progress(const std::string& what, double share) {
  if (on_progress.is_none()) return;
  const auto now = Clock::now();
  if (what == what_ && share < 1 && now - told_ < between_calls) return;
  what_ = what;
  told_ = now;
  tell([&] { on_progress(what, share); });
}

void PythonListener::warn(const jobs::Warning& w) {
  tell([&] { on_warning(w.code, w.text, w.where, w.help); });
}

bool PythonListener::cancelled() {
  const auto now = Clock::now();
  if (cancelled_ || now - asked_ < between_calls) return cancelled_;
  asked_ = now;
  tell([&] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!on_cancel.is_none()) cancelled_ = py::bool_(on_cancel());
  });
  return cancelled_;
}

void PythonListener::rethrow() const {
  if (error_) std::rethrow_exception(error_);
}

}  // namespace furrow::python
