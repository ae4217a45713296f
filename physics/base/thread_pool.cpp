// SPDX-License-Identifier: MIT
#include "physics/base/thread_pool.h"

#include <atomic>
#include <stdexcept>
#include <string>

namespace furrow::physics {

namespace {

constexpr int most_threads = 1024;  // more is a mistake

}  // namespace

ThreadPool::ThreadPool(int threads) {
  if (threads < 1 || threads > most_threads)
    throw std::invalid_argument("threads = " + std::to_string(threads) + " is not in [1, " +
                                std::to_string(most_threads) + "]");
  errors_.resize(std::size_t(threads));
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this, i] { serve(i); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::run(int n, const Work& work) {
  if (workers_.empty()) {
    if (n > 0) work(0, n);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    n_ = n;
    pending_ = int(workers_.size());
    ++round_;
  }
  start_.notify_all();
  do_chunk(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return pending_ == 0; });
  std::exception_ptr first;
  for (std::exception_ptr& error : errors_) {
    if (error && !first) first = error;
    error = nullptr;
  }
  if (first) std::rethrow_exception(first);
}

void ThreadPool::share(int n, const std::function<void(int i, int thread)>& work) {
  std::atomic<int> next = 0;
  run(threads(), [&](int thread, int) {
    for (int i = next++; i < n; i = next++) work(i, thread);
  });
}

void ThreadPool::do_chunk(int chunk) {
  const auto total = std::int64_t(threads());
  const int begin = int(n_ * std::int64_t(chunk) / total), end = int(n_ * std::int64_t(chunk + 1) / total);
  try {
    if (begin < end) (*work_)(begin, end);
  } catch (...) {
    errors_[std::size_t(chunk)] = std::current_exception();
  }
}

void ThreadPool::serve(int worker) {
  std::uint64_t seen = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
    }
    do_chunk(worker);
    const std::lock_guard lock(mutex_);
    if (--pending_ == 0) done_.notify_one();
  }
}

}  // namespace furrow::physics
