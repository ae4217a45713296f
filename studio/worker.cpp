// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/worker.h"

#include <nlohmann/json.hpp>

namespace furrow::studio {
namespace {

constexpr std::size_t longest_queue = 256;

bool is_live(const Message& message) { return message.body.value("live", Json(false)) == true; }

}  // namespace

void Worker::start() {
  thread_ = std::thread([this] { run(); });
}

void Worker::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    rooms_.cancel();
  }
  ready_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Worker::refuse(Client client, const Json& id, const std::string& why) {
  out_.tell(client, {{"id", id}, {"refused", why}});
}

void Worker::post(Client client, const std::string& text) {
  Message message;
  try {
    message = parse_message(text);
  } catch (const Refused& e) {
    return refuse(client, nullptr, e.what());
  }
  if (message.what == "cancel" || message.what == "pause") {
    rooms_.cancel();
    return out_.tell(client, {{"id", message.id}, {"done", Json::object()}});
  }
  if (message.what == "pull") return rooms_.pull(client, message);
  const std::lock_guard lock(mutex_);
  if (tasks_.size() >= longest_queue)
    return refuse(client, message.id, "too much is waiting to be done; wait a moment");
  if (is_live(message) && !tasks_.empty()) {
    Task& last = tasks_.back();
    if (last.client == client && last.message && is_live(*last.message)) {
      out_.tell(client, {{"id", last.message->id}, {"done", {{"passed_over", true}}}});
      last.message = message;
      return;
    }
  }
  tasks_.push_back({client, message, false});
  ready_.notify_one();
}

void Worker::greet(Client client) {
  const std::lock_guard lock(mutex_);
  tasks_.push_back({client, std::nullopt, false});
  ready_.notify_one();
}

void Worker::leave(Client client) {
  const std::lock_guard lock(mutex_);
  tasks_.push_back({client, std::nullopt, true});
  ready_.notify_one();
}

void Worker::run() {
  for (;;) {
    Task task;
    {
      std::unique_lock lock(mutex_);
      ready_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (stopping_) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
      rooms_.allow();
    }
    try {
      if (task.message)
        rooms_.handle(task.client, *task.message);
      else if (task.gone)
        rooms_.leave(task.client);
      else
        rooms_.greet(task.client);
    } catch (const std::exception& e) {  // for want of memory: the next page may have more luck
      refuse(task.client, nullptr, e.what());
    }
  }
}

}  // namespace furrow::studio
