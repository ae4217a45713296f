// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/rooms.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "jobs/base/guess_frame.h"
#include "jobs/base/project_files.h"
#include "jobs/base/read_inputs.h"

namespace furrow::studio {
namespace {

namespace fs = std::filesystem;

/// A new project's folder, made here and by nobody else, which goes again if nothing comes of it.
class Ground {
 public:
  Ground(const fs::path& drawings, const std::string& name) {
    for (int n = 1; folder_.empty(); ++n) {
      const fs::path folder = drawings / (name + "-studio" + (n > 1 ? "-" + std::to_string(n) : ""));
      std::error_code failed, none;
      if (fs::create_directory(folder, failed)) folder_ = folder;
      if (failed && !fs::exists(fs::symlink_status(folder, none)))
        throw std::runtime_error(folder.string() + ": cannot be made: " + failed.message());
    }
  }
  ~Ground() {
    std::error_code none;
    if (!keeps_) fs::remove_all(folder_, none);
  }
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;
  const fs::path& folder() const { return folder_; }
  void keep() { keeps_ = true; }
  /// Writes an upload below the folder, and returns its path from there; `word` goes before a name that is
  /// taken.
  std::string take(const Upload& upload, const std::string& word) {
    fs::path file = fs::path("files") / upload.name;
    while (fs::exists(folder_ / file)) file.replace_filename(word + "-" + file.filename().string());
    std::error_code failed;
    fs::create_directories(folder_ / "files", failed);
    if (failed) throw std::runtime_error(folder_.string() + ": cannot be made: " + failed.message());
    jobs::write_whole(folder_ / file, upload.bytes);
    return file.generic_string();
  }

 private:
  fs::path folder_;
  bool keeps_ = false;
};

std::string choice_of(const Json& body, const char* key, std::initializer_list<const char*> all) {
  if (!body.contains(key)) return "";
  const std::string word = text_of(body, key, 8);
  if (std::ranges::find(all, word) == all.end())
    throw Refused(std::string(key) + ": there is no '" + word + "'");
  return word;
}

std::string words_of(const jobs::GuessedFrame& frame, bool has_body) {
  char text[200];
  std::snprintf(
      text, sizeof text, "Taken as %s with %s upwards, so the %s is %.2f m tall%s", frame.unit.c_str(),
      frame.up.c_str(), has_body ? "body" : "garment", frame.height,
      frame.sure ? "." : ". That is not certain: if it is wrong, open it again and say unit and axis.");
  return text;
}

}  // namespace

Rooms::Rooms(const Places& places, Uploads& uploads, Outbox& out)
    : places_(places), uploads_(uploads), out_(out), items_(gallery(places.gallery)) {}

Rooms::Rooms(const Places& places, Uploads& uploads, Outbox& out, const jobs::SceneInput& scene,
             const fs::path& folder, const fs::path& made_for)
    : Rooms(places, uploads, out) {
  session_ = std::make_shared<Session>(scene, folder, out, made_for);
}

Rooms::Rooms(const Places& places, Uploads& uploads, Outbox& out, const fs::path& folder)
    : Rooms(places, uploads, out) {
  session_ = std::make_shared<Session>(folder, out);
}

std::shared_ptr<Session> Rooms::present() const {
  const std::lock_guard lock(mutex_);
  return session_;
}

void Rooms::cancel() {
  if (const auto session = present()) session->cancel();
}

void Rooms::allow() {
  if (const auto session = present()) session->allow();
}

Json Rooms::gallery_rows() const {
  Json rows = Json::array();
  for (const GalleryItem& item : items_) {
    rows.push_back({{"name", item.name}, {"title", item.title}});
    if (!item.picture.empty()) rows.back()["picture"] = item.picture;
  }
  return rows;
}

void Rooms::greet(Client client) {
  pages_.insert(client);
  const auto session = present();
  out_.tell(client, {{"gallery", gallery_rows()}, {"open", session != nullptr}});
  if (session) return session->greet(client);
  out_.tell(client, {{"you", client}});
}

void Rooms::leave(Client client) {
  pages_.erase(client);
  if (const auto session = present()) session->leave(client);
}

void Rooms::pull(Client client, const Message& message) {
  if (const auto session = present()) return session->pull(client, message);
  out_.tell(client, {{"id", message.id}, {"refused", "nothing is open yet; choose a garment first"}});
}

void Rooms::handle(Client client, const Message& message) {
  const auto session = present();
  const bool is_own = message.what == "open" || message.what == "folder";
  if (session && !is_own) return session->handle(client, message);
  std::string why = "nothing is open yet; choose a garment first";
  try {
    if (message.what == "open")
      return out_.tell(client, {{"id", message.id}, {"done", open(client, message.body)}});
    if (session && message.what == "folder")
      return out_.tell(client, {{"id", message.id}, {"done", show_folder(client, message.body)}});
  } catch (const std::bad_alloc&) {
    why = "not enough memory for that; nothing was opened";
  } catch (const std::exception& e) {
    why = e.what();
  }
  out_.tell(client, {{"id", message.id}, {"refused", why}});
}

Json Rooms::open(Client client, const Json& body) {
  const auto session = present();
  if (session && !session->may_command(client))
    throw Refused("another page is drawing; press \"Take the pen\" here to open another garment");
  Json answer = body.contains("item") ? open_item(text_of(body, "item")) : open_files(body);
  out_.tell(everybody, {{"opened", answer.at("project")}});
  present()->greet(client);  // who opened it draws
  for (const Client page : pages_)
    if (page != client) present()->greet(page);
  return answer;
}

/// That of the drawing, or the one in it where things are given away: no other can be asked for.
Json Rooms::show_folder(Client client, const Json& body) const {
  const auto session = present();
  if (!session->may_command(client)) throw Refused("another page is drawing");
  const std::string of = choice_of(body, "of", {"project", "give"});
  const fs::path& project = session->project().folder();
  const fs::path folder = fs::absolute(of == "give" ? project / "give" : project).lexically_normal();
  if (!fs::is_directory(fs::symlink_status(folder)))
    throw Refused(folder.string() + ": is no folder any more");
  if (!places_.show_folder) throw Refused("nothing here shows folders; this one is " + folder.string());
  places_.show_folder(folder);
  return {{"folder", folder.string()}};
}

void Rooms::enter(const jobs::SceneInput& scene, const fs::path& folder, const fs::path& made_for) {
  auto session = std::make_shared<Session>(scene, folder, out_, made_for);
  const std::lock_guard lock(mutex_);
  session_ = std::move(session);
}

Json Rooms::open_item(const std::string& name) {
  const auto item = std::ranges::find(items_, name, &GalleryItem::name);
  if (item == items_.end()) throw Refused("item: the gallery has nothing of that name");
  Ground ground(places_.drawings, name);
  enter({jobs::settings_of(item->scene.string(), "", std::nullopt), item->scene.parent_path()},
        ground.folder());
  ground.keep();
  return {{"project", ground.folder().string()}};
}

/// The file that a message names, if it names one.
std::optional<Upload> Rooms::sent(const Json& body, const char* key) {
  if (!body.contains(key)) return std::nullopt;
  std::optional<Upload> upload = uploads_.take(text_of(body, key, 16));
  if (!upload) throw Refused(std::string(key) + ": the file has not arrived; choose it again");
  return upload;
}

Json Rooms::open_files(const Json& body) {
  const std::string unit = choice_of(body, "unit", {"m", "cm", "mm", "inch"}),
                    up = choice_of(body, "up", {"y", "z"});
  if (body.contains("made_for") && !body.contains("body"))
    throw Refused(
        "made for: the garment is brought from one body to another; choose the other one as its body");
  if (!body.contains("garment")) throw Refused("the message has no 'garment'");
  const std::optional<Upload> garment = sent(body, "garment"), worn_by = sent(body, "body"),
                              made_for = sent(body, "made_for");
  Ground ground(places_.drawings, fs::path(garment->name).stem().string());
  const Json figures = body.value("figures", Json::object());
  if (!figures.is_object()) throw Refused("figures: no object");
  const auto named = [&](const std::string& file, const char* role) {
    return file + (figures.contains(role) ? "#" + text_of(figures, role, 200) : "");
  };
  const std::string mesh = named(ground.take(*garment, "garment"), "garment"),
                    figure = worn_by ? named(ground.take(*worn_by, "body"), "body") : "",
                    other = made_for ? named(ground.take(*made_for, "made-for"), "made_for") : "";
  const jobs::GuessedFrame guess =
      jobs::guess_frame(ground.folder() / mesh, worn_by ? ground.folder() / figure : fs::path());
  std::string toml = "unit = \"" + (unit.empty() ? guess.unit : unit) + "\"\nup = \"" +
                     (up.empty() ? guess.up : up) + "\"\n[garment]\nmesh = " + Json(mesh).dump() + "\n";
  if (worn_by) toml += "[body]\nmesh = " + Json(figure).dump() + "\n";
  const jobs::SceneInput scene{io::parse_toml(toml, garment->name), ground.folder()};
  enter(scene, ground.folder(), made_for ? ground.folder() / other : fs::path());
  ground.keep();
  Json answer{{"project", ground.folder().string()}};
  if (unit.empty() || up.empty()) answer["told"] = Json::array({words_of(guess, worn_by.has_value())});
  return answer;
}

}  // namespace furrow::studio
