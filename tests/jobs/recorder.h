// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <climits>
#include <string>
#include <utility>
#include <vector>

#include "jobs/base/inputs.h"

namespace furrow::tests {

/// Remembers what a job says, and cancels when it was asked so many times.
class Recorder : public jobs::Listener {
 public:
  explicit Recorder(int cancel_at = INT_MAX) : cancel_at_(cancel_at) {}
  void progress(const std::string& what, double share) override { told.emplace_back(what, share); }
  void warn(const jobs::Warning& warning) override { warnings.push_back(warning); }
  bool cancelled() override { return ++asked >= cancel_at_; }

  bool warned_of(const std::string& code) const {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const jobs::Warning& w) { return w.code == code; });
  }

  int asked = 0;
  std::vector<std::pair<std::string, double>> told;
  std::vector<jobs::Warning> warnings;

 private:
  int cancel_at_;
};

/// Counts and cancels only once the field of a body is built: how often that asks depends on which of its
/// threads is quicker.
class AfterField : public Recorder {
 public:
  using Recorder::Recorder;
  void progress(const std::string& what, double share) override {
    built_ = built_ || (what == "distance field" && share == 1);
  }
  bool cancelled() override { return built_ && Recorder::cancelled(); }

 private:
  bool built_ = false;
};

}  // namespace furrow::tests
