// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <random>

/// A disk that fails now and then: this program's own write(), pwrite(), fsync(), ftruncate(), rename() and
/// remove() stand before those of the system, also for the libraries that it is linked with.
namespace furrow::tests {

/// While one of these lives, each of the calls of its thread fails with this probability; of a write, half of
/// the bytes may be written before.
class FailingDisk {
 public:
  FailingDisk(double share, std::uint64_t seed);
  ~FailingDisk();
  FailingDisk(const FailingDisk&) = delete;
  FailingDisk& operator=(const FailingDisk&) = delete;
  /// Calls that failed so far.
  int failed() const { return failed_; }
  /// Whether the next call of this thread is to fail.
  static bool fails();

 private:
  static thread_local FailingDisk* present_;
  const double share_;
  std::mt19937_64 random_;
  int failed_ = 0;
};

}  // namespace furrow::tests
