// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/listener.h"

#include <cstdlib>

#include "io/base/field_words.h"

namespace furrow::python {
namespace {

constexpr std::chrono::milliseconds between_calls{50};

/// As one writes it: numbers as they are, words in quotes.
std::string as_written(const std::string& value) {
  char* end = nullptr;
  std::strtod(value.c_str(), &end);
  return *end == 0 ? value : "\"" + value + "\"";
}

std::string keyword_words(const io::NamedField& named) {
  const std::string job = named.job.empty() ? "" : "furrow." + named.job;
  std::string field = named.field;
  if (field.find('.') != field.npos)
    field =
        named.value.empty() ? "settings" : "settings={\"" + field + "\": " + as_written(named.value) + "}";
  else if (!named.value.empty())
    field += "=" + as_written(named.value);
  if (job.empty() || field.empty()) return job + field;
  return job + "(" + field + (named.value.empty() ? "=True" : "") + ")";
}

}  // namespace

std::string in_python(const std::string& message) { return io::worded(message, keyword_words); }

Json report_in_python(Json report) {
  return io::with_texts(std::move(report), [](const std::string& text) { return in_python(text); });
}

void PythonListener::progress(const std::string& what, double share) {
  if (on_progress.is_none()) return;
  const auto now = Clock::now();
  if (what == what_ && share < 1 && now - told_ < between_calls) return;
  what_ = what;
  told_ = now;
  tell([&] { on_progress(what, share); });
}

void PythonListener::warn(const jobs::Warning& w) {
  tell([&] { on_warning(w.code, in_python(w.text), in_python(w.where), in_python(w.help)); });
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
