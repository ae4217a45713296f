// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/budget.h"

#include <fmt/format.h>

#include <ctime>
#include <stdexcept>

namespace furrow::jobs {
namespace {

/// Processor time that the process has used [s].
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace

Budget::Budget(const char* job, double seconds, Listener& other)
    : job_(job), seconds_(seconds), start_(processor_seconds()), other_(other) {
  if (!(seconds > 0))  // infinity is none
    throw std::invalid_argument(std::string(job) + ": budget = " + std::to_string(seconds) + " is not > 0");
}

double Budget::used() const { return processor_seconds() - start_; }

bool Budget::cancelled() {
  if (other_.cancelled()) return true;
  // It is asked at each face or point, and that clock is dear: every few milliseconds will do.
  const auto now = std::chrono::steady_clock::now();
  if (!spent_ && now >= next_look_) {
    next_look_ = now + std::chrono::milliseconds(5);
    looked_ = used();
    spent_ = looked_ >= seconds_;
  }
  return spent_;
}

void Budget::throw_spent() const {
  throw BudgetSpent(
      fmt::format("{}: its budget of {:.4g} s of processor time was spent before there was anything to "
                  "write; give it more "
                  "with `budget`, or refine less",
                  job_, seconds_));
}

}  // namespace furrow::jobs
