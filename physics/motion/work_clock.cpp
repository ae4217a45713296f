// SPDX-License-Identifier: MIT
#include "physics/motion/work_clock.h"

#include <ctime>

namespace furrow::physics {

const char* name_of(WorkPart part) {
  switch (part) {
    case WorkPart::other:
      return "other";
    case WorkPart::assembly:
      return "assembly";
    case WorkPart::factorisation:
      return "factorisation";
    case WorkPart::solve:
      return "solve";
    case WorkPart::elements:
      return "elements";
    case WorkPart::contact:
      return "contact";
    case WorkPart::self_contact:
      return "self_contact";
    case WorkPart::output:
      return "output";
  }
  return "";
}

double processor_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

void WorkClock::charge() {
  const double now = processor_seconds();
  times_[std::size_t(part_)] += now - since_;
  since_ = now;
}

}  // namespace furrow::physics
