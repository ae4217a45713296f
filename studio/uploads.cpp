// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/uploads.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "jobs/base/inputs.h"

namespace furrow::studio {
namespace {

constexpr std::size_t most_kept = 4, longest_name = 80;

/// The last part of a name, its ending in small letters, all else that is no letter or digit a '-'; "": no
/// mesh is called so.
std::string plain_name(const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(name).filename();
  std::string stem = file.stem().string(), ending = file.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (stem.empty() || name.size() > 255 || (!io::is_written_mesh(ending) && ending != ".fbx")) return "";
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') c = '-';
  return stem.substr(0, longest_name) + ending;
}

}  // namespace

std::string Uploads::put(const std::string& name, std::string bytes) {
  const std::string plain = plain_name(name);
  if (plain.empty()) return "";
  const std::lock_guard lock(mutex_);
  kept_.push_back({std::to_string(next_++), {plain, std::move(bytes)}});
  while (kept_.size() > most_kept) kept_.pop_front();
  return kept_.back().number;
}

std::optional<Upload> Uploads::take(const std::string& number) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(kept_, number, &Kept::number);
  if (found == kept_.end()) return std::nullopt;
  Upload upload = std::move(found->upload);
  kept_.erase(found);
  return upload;
}

}  // namespace furrow::studio
