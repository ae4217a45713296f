// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "studio/rooms.h"

namespace furrow::studio {

/// The thread in which drawings are worked on, and the queue before it.
class Worker {
 public:
  explicit Worker(Rooms& rooms, Outbox& out) : rooms_(rooms), out_(out) {}
  ~Worker() { stop(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void start();
  /// Cancels what runs, does no more, and waits for the thread.
  void stop();
  /// Puts what a page sent at the queue's end; "cancel", "pause" and "pull" act at once. A live message that
  /// waits for the same page gives way to a later one. A full queue refuses.
  void post(Client client, const std::string& text);
  void greet(Client client);
  void leave(Client client);

 private:
  struct Task {
    Client client;
    std::optional<Message> message;  ///< none: it has come, or gone
    bool gone = false;
  };
  void run();
  void refuse(Client client, const Json& id, const std::string& why);

  Rooms& rooms_;
  Outbox& out_;
  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Task> tasks_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace furrow::studio
