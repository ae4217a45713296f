// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <exception>
#include <string>

#include "python/values.h"

namespace furrow::python {

/// A message with the keywords that its fields are here: cloth_thickness, self_contact="on",
/// furrow.doctor(repair=True).
std::string in_python(const std::string& message);
/// The same for every text of a report.
Json report_in_python(Json report);

/// Tells Python's callables how a job goes on. The job runs without the interpreter's lock, which is taken
/// for each call; at most every 50 ms, warnings aside. An exception of a callable, or that of a signal
/// (Ctrl-C), cancels the job and is kept for rethrow().
class PythonListener : public jobs::Listener {
 public:
  py::object on_progress = py::none();  ///< (what, share)
  py::object on_cancel = py::none();    ///< () -> whether to stop
  py::object on_warning = py::none();   ///< (code, text, where, help)
  bool force = false, replace = false;

  void progress(const std::string& what, double share) override;
  void warn(const jobs::Warning& warning) override;
  bool cancelled() override;
  bool allows(const std::string&) override { return force; }
  bool replaces(const std::string&) override { return replace; }

  bool failed() const { return bool(error_); }
  /// Throws what a callable or a signal raised, if anything did. With the interpreter's lock.
  void rethrow() const;

  /// Does it with the interpreter's lock; what it raises cancels the job.
  template <class Python>
  void tell(const Python& python) {
    if (error_) return;
    const py::gil_scoped_acquire lock;
    try {
      python();
    } catch (const py::error_already_set&) {
      error_ = std::current_exception();
      cancelled_ = true;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::exception_ptr error_;
  bool cancelled_ = false;
  std::string what_;
  Clock::time_point told_ = {}, asked_ = {};
};

}  // namespace furrow::python
