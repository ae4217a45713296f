// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/studio.h"

#include "studio/project.h"
#include "studio/rooms.h"
#include "studio/server.h"
#include "studio/worker.h"

namespace furrow::studio {

struct Studio::Parts {
  template <class... What>
  explicit Parts(unsigned short port, const Places& places, const What&... what)
      : server(port), rooms(places, uploads, server, what...), worker(rooms, server) {
    worker.start();
    server.start(worker, uploads);
  }
  ~Parts() {
    server.stop();
    worker.stop();
  }

  Uploads uploads;
  Server server;
  Rooms rooms;
  Worker worker;
};

Studio::Studio(const Places& places, unsigned short port) : parts_(std::make_unique<Parts>(port, places)) {}
Studio::Studio(const jobs::SceneInput& scene, const std::filesystem::path& folder, unsigned short port,
               const Places& places, const std::filesystem::path& made_for)
    : parts_(std::make_unique<Parts>(port, places, scene, folder, made_for)) {}
Studio::Studio(const std::filesystem::path& folder, unsigned short port, const Places& places)
    : parts_(std::make_unique<Parts>(port, places, folder)) {}
Studio::~Studio() = default;

bool Studio::is_project(const std::filesystem::path& folder) { return Project::is_there(folder); }

std::string Studio::url() const {
  return "http://127.0.0.1:" + std::to_string(port()) + "/?token=" + token();
}
unsigned short Studio::port() const { return parts_->server.port(); }
const std::string& Studio::token() const { return parts_->server.token(); }

}  // namespace furrow::studio
