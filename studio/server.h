// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>

#include "studio/outbox.h"

namespace furrow::studio {

class Worker;
class Uploads;
class Page;
class Connection;

/// HTTP and WebSocket on 127.0.0.1, in one thread. Without the token every request is refused (403), with a
/// foreign Host, too (421), and a WebSocket or a file of a foreign Origin (403).
class Server : public Outbox {
 public:
  /// Port 0: a free one. Throws std::runtime_error if it cannot be had.
  explicit Server(unsigned short port);
  ~Server() override;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// From now on what pages send goes to the worker, and files to the uploads.
  void start(Worker& worker, Uploads& uploads);
  /// Closes all connections and ends the thread.
  void stop();
  unsigned short port() const;
  const std::string& token() const;

  void tell(Client client, const jobs::Json& message) override;
  void show(Client client, Bytes frame) override;

 private:
  friend class Page;
  friend class Connection;
  struct Parts;
  void send(Client client, Bytes bytes, bool binary);
  std::shared_ptr<Parts> parts_;
};

}  // namespace furrow::studio
