// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/material_libraries.h"

#include <optional>
#include <sstream>

namespace furrow::io {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> named_from(const std::string& name, const fs::path& there, const fs::path& here) {
  std::error_code none;
  if (name.empty() || !fs::path(name).is_relative() || !fs::is_regular_file(there / name, none)) return {};
  const std::string from_here = (there / name).lexically_normal().lexically_relative(here).generic_string();
  if (from_here.empty()) return {};
  return from_here;
}

}  // namespace

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

std::string library_from(const std::string& library, const fs::path& there_named,
                         const fs::path& here_named) {
  std::error_code error;
  if (there_named.empty() || here_named.empty()) return library;
  if (library.find_first_of("\\\n\r") != std::string::npos) return library;  // lines joined, or other paths
  const fs::path there = fs::canonical(there_named, error);
  if (error) return library;
  const fs::path here = fs::canonical(here_named, error);
  if (error || here == there) return library;
  if (const auto one = named_from(library, there, here)) return *one;
  std::istringstream words(library);
  std::string all;
  bool other = false;
  for (std::string word; words >> word;) {
    const std::optional<std::string> name = named_from(word, there, here);
    if (name && name->find(' ') != std::string::npos) return library;  // it would be read as two
    other = other || name;
    all += (all.empty() ? "" : " ") + name.value_or(word);
  }
  return other ? all : library;
}

}  // namespace furrow::io
