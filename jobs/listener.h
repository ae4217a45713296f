// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <utility>

/// What users ask for, as functions of structs: `Report job(const Job&, Listener&)`. Nothing here prints or
/// exits; what a job has to say, it says to its listener and in its report. Several jobs may run in one
/// process at once, each with a listener of its own.
namespace furrow::jobs {

/// What is no error, and hardly what was meant.
struct Warning {
  std::string code;   ///< stable, for programs: "lines_after_end"
  std::string text;   ///< a whole sentence for people; names file and remedy, too
  std::string where;  ///< the file or setting that it is about; "": the result
  std::string help;   ///< the option or setting that helps; "": none
};

/// Told how a job goes on, in the thread that runs it. By default it wants to hear nothing.
class Listener {
 public:
  virtual ~Listener() = default;
  /// `share` of `what` is done, in [0, 1]; 1 is told at its end, also where it was broken off. Must not
  /// throw.
  virtual void progress(const std::string& /*what*/, double /*share*/) {}
  virtual void warn(const Warning&) {}
  /// Asked often. true: the job ends within half a second, and leaves no output half written.
  virtual bool cancelled() { return false; }
};

/// Passes on nothing but whether the other one cancels.
class SilentListener : public Listener {
 public:
  explicit SilentListener(Listener& other) : other_(other) {}
  bool cancelled() override { return other_.cancelled(); }

 private:
  Listener& other_;
};

/// A stretch of work that a listener sees: its progress, and its end with the scope.
class ProgressScope {
 public:
  ProgressScope(Listener& listener, std::string what) : listener_(listener), what_(std::move(what)) {}
  ~ProgressScope() { listener_.progress(what_, 1); }
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
  /// Tells the share that is done; returns whether to go on.
  bool operator()(double share) const {
    listener_.progress(what_, share);
    return !listener_.cancelled();
  }

 private:
  Listener& listener_;
  std::string what_;
};

}  // namespace furrow::jobs
