// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"

/// Files that the tests of jobs write, and what is in them.
namespace furrow::tests {

/// Folders of this process alone, since tests run beside each other. They are removed when it ends, but not
/// when a child that it forked does.
class OwnFolders {
 public:
  ~OwnFolders() {
    std::error_code none;
    if (::getpid() == process_)
      for (const std::filesystem::path& folder : made_) std::filesystem::remove_all(folder, none);
  }
  std::filesystem::path add(const std::string& name) {
    const std::string own = "furrow_jobs_" + name + "_" + std::to_string(process_);
    return *made_.insert(std::filesystem::temp_directory_path() / own).first;
  }

 private:
  const pid_t process_ = ::getpid();
  std::set<std::filesystem::path> made_;
};

inline std::filesystem::path empty_folder(const std::string& name) {
  static OwnFolders own;
  const std::filesystem::path folder = own.add(name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline io::MeshFile mesh_of(const jobs::MeshInput& input) { return std::get<io::MeshFile>(input); }

inline std::vector<geometry::Point> positions(const io::MeshFile& file) {
  return {file.mesh->points().begin(), file.mesh->points().end()};
}

}  // namespace furrow::tests
