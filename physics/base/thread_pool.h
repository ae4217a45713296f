// SPDX-License-Identifier: MIT
#pragma once
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace furrow::physics {

/// Threads that share a range in fixed, contiguous chunks: who does what depends on n and the number of
/// threads only. Waiting threads sleep (no spinning). One thread = plain calls.
class ThreadPool {
 public:
  using Work = std::function<void(int begin, int end)>;

  /// threads >= 1, the caller included; throws std::invalid_argument otherwise.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return int(workers_.size()) + 1; }
  /// Calls work on chunks of [0, n), one a thread, and returns when all are done. An exception of any chunk
  /// is thrown again here (that of the lowest chunk). Not reentrant.
  void run(int n, const Work& work);
  /// Calls work(i, thread) for each i of [0, n), thread in [0, threads()): a thread takes the next i when it
  /// is free. What an i does must not depend on the thread. Otherwise as run().
  void share(int n, const std::function<void(int i, int thread)>& work);

 private:
  void serve(int worker);
  void do_chunk(int chunk);

  std::vector<std::thread> workers_;
  std::vector<std::exception_ptr> errors_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const Work* work_ = nullptr;
  int n_ = 0, pending_ = 0;
  std::uint64_t round_ = 0;
  bool stop_ = false;
};

}  // namespace furrow::physics
