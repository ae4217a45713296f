// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <string>

#include "jobs/base/inputs.h"
#include "physics/base/progress.h"

namespace furrow::jobs {

/// The budget of a job was spent before there was anything to write.
struct BudgetSpent : physics::Cancelled {
  using physics::Cancelled::Cancelled;
};

/// Cancels a job as soon as its budget of processor time is spent, wherever the job asks its listener; all
/// else goes to the other listener. A job that ends within its budget has the same bits as without one.
class Budget : public Listener {
 public:
  /// seconds: processor time of the whole process, its threads together, from now on [s]; > 0, infinity: no
  /// limit. Throws std::invalid_argument, naming `job`.
  Budget(const char* job, double seconds, Listener& other);

  void progress(const std::string& what, double share) override { other_.progress(what, share); }
  void warn(const Warning& warning) override { other_.warn(warning); }
  bool cancelled() override;
  bool cancelled_by_user() override { return other_.cancelled_by_user(); }
  bool allows(const std::string& demand) override { return other_.allows(demand); }
  bool replaces(const std::string& path) override { return other_.replaces(path); }

  bool is_spent() const { return spent_; }
  double seconds() const { return seconds_; }
  double used() const;                             ///< processor time since it began [s]
  double used_at_look() const { return looked_; }  ///< the same when cancelled() looked last, which is cheap

  /// work(), where Cancelled becomes BudgetSpent if it was the budget that cancelled.
  template <class Work>
  auto run(const Work& work) {
    try {
      return work();
    } catch (const physics::Cancelled&) {
      if (spent_) throw_spent();
      throw;
    }
  }

 private:
  [[noreturn]] void throw_spent() const;

  std::string job_;
  double seconds_, start_;
  Listener& other_;
  std::chrono::steady_clock::time_point next_look_ = {};
  double looked_ = 0;
  bool spent_ = false;
};

}  // namespace furrow::jobs
