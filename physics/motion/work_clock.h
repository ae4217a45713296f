// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion/simulate.h"

namespace furrow::physics {

/// Of this process, all its threads [s].
double processor_seconds();

/// Divides processor time among parts. Only what it is asked for comes of it: nothing decides by it. A clock
/// that is off costs a comparison, one that is on about a microsecond for a part.
class WorkClock {
 public:
  /// A part's time, from here until it ends; parts within it are not its own.
  class Within {
   public:
    Within(WorkClock& clock, WorkPart part) : clock_(clock), outer_(clock.part_) { clock_.change(part); }
    ~Within() { clock_.change(outer_); }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

   private:
    WorkClock& clock_;
    WorkPart outer_;
  };

  explicit WorkClock(bool on) : on_(on), since_(on ? processor_seconds() : 0) {}
  /// Until now; zeros if it is off.
  WorkTimes times() {
    change(part_);
    return times_;
  }

 private:
  void change(WorkPart to) {
    if (on_) charge();
    part_ = to;
  }
  void charge();

  bool on_;
  WorkPart part_ = WorkPart::other;
  double since_;
  WorkTimes times_{};
};

}  // namespace furrow::physics
