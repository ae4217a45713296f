// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/project.h"

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "studio/drawing.h"

namespace furrow::studio {
namespace {

namespace fs = std::filesystem;
using jobs::OutputsBelow;
using jobs::write_whole;

constexpr std::size_t kept_frames = 60, most_steps = 1'000'000;

[[noreturn]] void refuse_damaged(const fs::path& path, const std::string& why) {
  throw geometry::ContentError(path.string() + ": is damaged (" + why +
                               "); move the project's folder away to begin anew");
}

Json read_json(const fs::path& path) {
  const auto text = jobs::read_regular(path);
  if (!text) refuse_damaged(path, "it is missing");
  Json json = jobs::parse_json(*text, path.string());
  if (!json.is_object()) refuse_damaged(path, "it is no table");
  return json;
}

/// Nothing is there but what these names say, and what a write that was broken off has left.
bool holds_only(const fs::path& folder, const std::set<std::string>& names) {
  if (!fs::is_directory(folder)) return false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!names.contains(name) && name.find(".json.furrow-") == name.npos) return false;
  }
  return true;
}

/// Nothing is there but files to draw on, and what a start that was broken off has left.
bool is_free(const fs::path& folder) {
  const fs::path history = folder / "history";
  return !fs::exists(folder) || (holds_only(folder, {"files", "lock", "history"}) &&
                                 (!fs::exists(history) || holds_only(history, {"0.json"})));
}

void make_folders(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw std::runtime_error(folder.string() + ": the folder cannot be made: " + failed.message());
}

std::string text_of_step(const Step& step) {
  return Json{{"what", step.what}, {"drawing", step.drawing}}.dump();
}

}  // namespace

bool Project::is_there(const fs::path& folder) {
  std::error_code none;
  return fs::is_regular_file(fs::symlink_status(folder / "project.json", none));
}

Project::Project(fs::path folder, const Json& opened_with, const Step& first) : folder_(std::move(folder)) {
  if (!is_there(folder_)) {
    if (!is_free(folder_))
      throw std::invalid_argument(
          folder_.string() +
          ": is there, and is no project of the studio; name another folder with --project");
    make_folders(folder_);
    lock();
    if (!is_there(folder_)) {
      begin(opened_with, first);
      return;
    }
    lock_.reset();  // another program made it meanwhile
  }
  *this = Project(folder_);
  if (opened_with_ == opened_with) return;
  throw std::invalid_argument(folder_.string() +
                              ": holds a drawing that was begun with another garment or other options: go on "
                              "with it by furrow studio " +
                              folder_.string() + ", or name another folder with --project");
}

void Project::begin(const Json& opened_with, const Step& first) {
  const OutputsBelow below(folder_);
  OutputsBelow::check(folder_ / "history");
  make_folders(folder_ / "history");
  write_whole(step_file(0), text_of_step(first));
  opened_with_ = opened_with;
  write_state(state_);
  now_ = first;
}

Project::Project(fs::path folder, Access access) : folder_(std::move(folder)) {
  if (access == Access::write) lock();
  const Json json = read_json(folder_ / "project.json");
  state_ = read_state(json);
  opened_with_ = json.value("opened_with", Json());
  now_ = read_step(state_.at);
  redo_what_ = state_.at + 1 < state_.count ? read_step(state_.at + 1).what : "";
}

void Project::lock() {
  lock_ = std::make_unique<jobs::FolderLock>(folder_);
  if (!lock_->is_held())
    throw std::runtime_error(folder_.string() +
                             ": is open in another studio; draw there, or end that one and try again");
}

fs::path Project::step_file(std::size_t step, const char* ending) const {
  return folder_ / "history" / (std::to_string(step) + ending);
}

Step Project::read_step(std::size_t step) const {
  fs::path file = step_file(step, ".new");
  if (state_.fresh != step || !fs::exists(file)) file = step_file(step);
  const Json json = read_json(file);
  const std::string fault = fault_of_drawing(json.value("drawing", Json()));
  if (!fault.empty()) refuse_damaged(file, fault);
  if (!json.contains("what") || !json["what"].is_string()) refuse_damaged(file, "its step has no name");
  return {json["what"], json["drawing"]};
}

Project::State Project::read_state(const Json& json) const {
  const fs::path file = folder_ / "project.json";
  if (json.value("furrow_studio", Json()) != 1)
    throw std::invalid_argument(folder_.string() + ": was made by another version of the studio");
  const auto number = [&](const char* key, std::uint64_t otherwise) {
    if (!json.contains(key)) return otherwise;
    if (!json[key].is_number_unsigned()) refuse_damaged(file, std::string(key) + " is no whole number");
    return json[key].get<std::uint64_t>();
  };
  State state;
  state.at = number("at", 0);
  state.count = number("count", 1);
  if (state.at >= state.count || state.count > most_steps) refuse_damaged(file, "at and count cannot be");
  std::error_code none;
  const std::uintmax_t size = fs::file_size(folder_ / "log.jsonl", none);
  state.logged = number("logged", none ? 0 : size);
  if (json.contains("fresh")) state.fresh = number("fresh", 0);
  return state;
}

void Project::write_state(const State& state) const {
  Json json{{"furrow_studio", 1}, {"at", state.at}, {"count", state.count}, {"logged", state.logged}};
  if (state.fresh) json["fresh"] = *state.fresh;
  json["opened_with"] = opened_with_;
  write_whole(folder_ / "project.json", json.dump(1));
}

/// All that can fail comes before the state is replaced, on disk and then here.
void Project::commit(State next, const Json& did) {
  next.logged = jobs::append_at(folder_ / "log.jsonl", state_.logged, did.dump() + '\n');
  write_state(next);
  state_ = next;
}

void Project::add(const Step& step, const Json& did) {
  const OutputsBelow below(folder_);
  if (state_.fresh) {
    settle();
    write_state(state_);
  }
  State next = state_;
  const std::size_t before = std::exchange(next.count, ++next.at + 1);
  next.fresh = next.at;
  OutputsBelow::check(step_file(next.at, ".frame"));
  fs::remove(step_file(next.at, ".frame"));  // of a step that was undone
  write_whole(step_file(next.at, ".new"), text_of_step(step));
  Step now = step;
  commit(next, did);
  now_ = std::move(now);
  redo_what_.clear();
  drop_undone(before);
}

/// A new step's file gets its own name, over that of one that was undone.
void Project::settle() {
  const fs::path file = step_file(state_.fresh.value(), ".new");
  OutputsBelow::check(file);
  if (fs::exists(file)) fs::rename(file, step_file(*state_.fresh));
  state_.fresh.reset();
}

/// What cannot be done now is done with the next step, or harms nothing.
void Project::drop_undone(std::size_t count) noexcept {
  try {
    settle();
    for (std::size_t i = at() + 1; i < count; ++i)
      for (const char* ending : {".json", ".frame"}) fs::remove(step_file(i, ending));
  } catch (const std::exception&) {
    return;
  }
}

void Project::go_to(std::size_t step, const char* word) {
  const OutputsBelow below(folder_);
  Step to = read_step(step);
  std::string redo_what = step + 1 < count() ? read_step(step + 1).what : "";
  State next = state_;
  next.at = step;
  commit(next, {{"do", word}});
  now_ = std::move(to);
  redo_what_ = std::move(redo_what);
}

std::string Project::undo() {
  std::string what = now_.what;
  go_to(at() - 1, "undo");
  return what;
}

std::string Project::redo() {
  go_to(at() + 1, "redo");
  return now_.what;
}

std::vector<std::string> Project::names_from(std::size_t first) const {
  std::vector<std::string> names;
  for (std::size_t i = first; i < count(); ++i) names.push_back(read_step(i).what);
  return names;
}

std::optional<std::string> Project::frame(std::size_t step) const {
  try {
    return jobs::read_regular(step_file(step, ".frame"));
  } catch (const geometry::ContentError&) {
    return std::nullopt;
  }
}

std::string Project::keep_frame(const std::string& bytes) noexcept {
  try {
    const OutputsBelow below(folder_);
    write_whole(step_file(at(), ".frame"), bytes);
    if (at() >= kept_frames) fs::remove(step_file(at() - kept_frames, ".frame"));
    return "";
  } catch (const std::exception& e) {
    return e.what();
  }
}

std::vector<Json> Project::log() const {
  const fs::path file = folder_ / "log.jsonl";
  std::vector<Json> lines;
  std::istringstream in(jobs::read_regular(file).value_or("").substr(0, state_.logged));
  for (std::string line; std::getline(in, line);) {
    lines.push_back(jobs::parse_json(line, file.string()));
    if (!lines.back().is_object() || !lines.back().value("do", Json()).is_string())
      refuse_damaged(file, "line " + std::to_string(lines.size()) + " says nothing to do");
  }
  return lines;
}

}  // namespace furrow::studio
