// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "studio/gallery.h"
#include "studio/session.h"
#include "studio/studio.h"
#include "studio/uploads.h"

namespace furrow::studio {

/// The drawing that is open, if one is, and the door to the next: what pages talk to. `open` makes a new
/// project of a gallery's scene or of files that a page has sent, and leaves the old one in its folder; all
/// else goes to the session. All of it runs in one thread, but for cancel(), allow() and pull().
class Rooms {
 public:
  /// Nothing is open.
  Rooms(const Places& places, Uploads& uploads, Outbox& out);
  /// A drawing is, as Session takes it.
  Rooms(const Places& places, Uploads& uploads, Outbox& out, const jobs::SceneInput& scene,
        const std::filesystem::path& folder, const std::filesystem::path& made_for);
  Rooms(const Places& places, Uploads& uploads, Outbox& out, const std::filesystem::path& folder);

  void greet(Client client);
  void leave(Client client);
  void handle(Client client, const Message& message);
  void cancel();
  void allow();
  void pull(Client client, const Message& message);

 private:
  std::shared_ptr<Session> present() const;
  Json gallery_rows() const;
  Json open(Client client, const Json& body);
  Json show_folder(Client client, const Json& body) const;
  Json open_item(const std::string& name);
  Json open_files(const Json& body);
  std::optional<Upload> sent(const Json& body, const char* key);
  void enter(const jobs::SceneInput& scene, const std::filesystem::path& folder,
             const std::filesystem::path& made_for = {});

  const Places places_;
  Uploads& uploads_;
  Outbox& out_;
  const std::vector<GalleryItem> items_;
  std::set<Client> pages_;
  mutable std::mutex mutex_;  // of what follows
  std::shared_ptr<Session> session_;
};

}  // namespace furrow::studio
