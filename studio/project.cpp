// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/project.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "jobs/sketch.h"

namespace furrow::studio {
namespace {

namespace fs = std::filesystem;
using jobs::write_whole;

constexpr std::size_t kept_frames = 60;

std::optional<std::string> read_whole(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return std::move(bytes).str();
}

Json read_json(const fs::path& path) {
  const auto text = read_whole(path);
  if (!text) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    return Json::parse(*text);
  } catch (const Json::exception&) {
    throw std::runtime_error(path.string() + ": is damaged; move the project's folder away to begin anew");
  }
}

/// Nothing is there, or a folder with files to draw on alone.
bool is_free(const fs::path& folder) {
  if (!fs::exists(folder)) return true;
  if (!fs::is_directory(folder)) return false;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != "files") return false;
  return true;
}

}  // namespace

bool Project::is_there(const fs::path& folder) { return fs::is_regular_file(folder / "project.json"); }

Project::Project(fs::path folder, const Json& opened_with, const Step& first)
    : folder_(std::move(folder)), opened_with_(opened_with) {
  if (is_there(folder_)) {
    *this = Project(folder_);
    if (opened_with_ == opened_with) return;
    throw std::invalid_argument(
        folder_.string() +
        ": holds a drawing that was begun with another garment or other options: go on "
        "with it by furrow studio " +
        folder_.string() + ", or name another folder with --project");
  }
  if (!is_free(folder_))
    throw std::invalid_argument(
        folder_.string() + ": is there, and is no project of the studio; name another folder with --project");
  std::error_code failed;
  fs::create_directories(folder_ / "history", failed);
  if (failed) throw std::runtime_error(folder_.string() + ": the folder cannot be made: " + failed.message());
  now_ = first;
  write_whole(step_file(0), Json{{"what", first.what}, {"drawing", first.drawing}}.dump());
  write_state();
}

Project::Project(fs::path folder) : folder_(std::move(folder)) {
  const Json state = read_json(folder_ / "project.json");
  if (!state.is_object() || state.value("furrow_studio", 0) != 1)
    throw std::invalid_argument(folder_.string() + ": was made by another version of the studio");
  opened_with_ = state.value("opened_with", Json());
  count_ = state.value("count", std::size_t{1});
  std::error_code none;
  const std::uintmax_t size = fs::file_size(folder_ / "log.jsonl", none);
  logged_ = state.value("logged", none ? std::uintmax_t{0} : size);
  go_to(state.value("at", std::size_t{0}));
}

fs::path Project::step_file(std::size_t step) const {
  return folder_ / "history" / (std::to_string(step) + ".json");
}
fs::path Project::frame_file(std::size_t step) const {
  return folder_ / "history" / (std::to_string(step) + ".frame");
}

Step Project::read_step(std::size_t step) const {
  const Json json = read_json(step_file(step));
  return {json.value("what", ""), json.value("drawing", Json::object())};
}

void Project::write_state() const {
  write_whole(folder_ / "project.json", Json{{"furrow_studio", 1},
                                             {"at", at_},
                                             {"count", count_},
                                             {"logged", logged_},
                                             {"opened_with", opened_with_}}
                                            .dump(1));
}

void Project::go_to(std::size_t step) {
  now_ = read_step(step);
  at_ = step;
  redo_what_ = at_ + 1 < count_ ? read_step(at_ + 1).what : "";
}

void Project::add(const Step& step, const Json& did) {
  drop_undone();
  write_whole(step_file(at_ + 1), Json{{"what", step.what}, {"drawing", step.drawing}}.dump());
  write_log(did);
  now_ = step;
  count_ = ++at_ + 1;
  write_state();
}

/// There is no way to what was undone any more. Said first, so that a program that is killed does not come
/// back with steps of two branches.
void Project::drop_undone() {
  const std::size_t before = std::exchange(count_, at_ + 1);
  if (before == count_) return;
  redo_what_.clear();
  write_state();
  std::error_code ignored;
  for (std::size_t i = at_ + 1; i < before; ++i) {
    fs::remove(frame_file(i), ignored);
    fs::remove(step_file(i), ignored);
  }
}

std::string Project::undo() {
  const std::string what = now_.what;
  go_to(at_ - 1);
  write_log({{"do", "undo"}});
  write_state();
  return what;
}

std::string Project::redo() {
  go_to(at_ + 1);
  write_log({{"do", "redo"}});
  write_state();
  return now_.what;
}

std::vector<std::string> Project::names_from(std::size_t first) const {
  std::vector<std::string> names;
  for (std::size_t i = first; i < count_; ++i) names.push_back(read_step(i).what);
  return names;
}

std::optional<std::string> Project::frame() const { return read_whole(frame_file(at_)); }

void Project::keep_frame(const std::string& bytes) {
  write_whole(frame_file(at_), bytes);
  std::error_code ignored;
  if (at_ >= kept_frames) fs::remove(frame_file(at_ - kept_frames), ignored);
}

void Project::write_log(const Json& line) {
  const fs::path path = folder_ / "log.jsonl";
  const std::string text = line.dump() + '\n';
  std::error_code none;
  if (fs::file_size(path, none) > logged_ && !none)
    fs::resize_file(path, logged_);  // of a step that was lost
  std::ofstream out(path, std::ios::app | std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written");
  logged_ += text.size();
}

std::vector<Json> Project::log() const {
  std::vector<Json> lines;
  std::istringstream in(read_whole(folder_ / "log.jsonl").value_or("").substr(0, logged_));
  for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
  return lines;
}

}  // namespace furrow::studio
