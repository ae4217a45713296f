// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace furrow::tests {

inline std::string source_text(const std::string& path) {
  std::ifstream in(FURROW_SOURCE_DIR "/" + path);
  if (!in) throw std::runtime_error("there is no " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The functions and constructors of a folder's public headers that are given something of these types, as
/// the headers declare it: "Mesh" finds `const geometry::Mesh& mesh`. `types`: alternatives of a regular
/// expression.
inline std::set<std::string> public_functions_of(const std::string& folder, const std::string& types) {
  const std::string lists = source_text(folder + "/CMakeLists.txt");
  std::smatch list;
  if (!std::regex_search(lists, list, std::regex("furrow_public_headers\\(" + folder + "([^)]*)\\)")))
    throw std::runtime_error(folder + " lists no public header");
  const std::string files = list[1];
  const std::regex file("[a-z_/]+\\.h"), comment("//[^\n]*|/\\*[^]*?\\*/"),
      declared("\\s(\\w+)\\([^()]*\\b(" + types + ")(&|\\s+\\w)");
  const std::sregex_iterator end;
  std::set<std::string> names;
  for (std::sregex_iterator f(files.begin(), files.end(), file); f != end; ++f) {
    const std::string text = std::regex_replace(source_text(folder + "/" + f->str()), comment, "");
    for (std::sregex_iterator d(text.begin(), text.end(), declared); d != end; ++d) names.insert((*d)[1]);
  }
  return names;
}

}  // namespace furrow::tests
