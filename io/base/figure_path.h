// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "io/base/lower_case.h"

namespace furrow::io {

/// One figure of a file that has several, as users name it: "avatar.glb#Skirt".
struct FigurePath {
  std::filesystem::path file;
  std::string figure;  ///< a node, or a mesh; empty: all of the file
};

inline FigurePath figure_path(const std::filesystem::path& path) {
  const std::string text = path.string(), low = lower_case(text);
  for (const std::string ending : {".glb#", ".gltf#", ".vrm#", ".fbx#", ".dae#"})
    if (const std::size_t at = low.find(ending); at != low.npos)
      return {text.substr(0, at + ending.size() - 1), text.substr(at + ending.size())};
  return {path, ""};
}

/// The file of it.
inline std::filesystem::path file_of_figure(const std::filesystem::path& path) {
  return figure_path(path).file;
}

/// What a mesh is called by its path: "worn" of "here/worn.ply", "Skirt" of "avatar.glb#Skirt".
inline std::string stem_of(const std::filesystem::path& path) {
  FigurePath named = figure_path(path);
  for (char& c : named.figure)
    if (c == '/') c = '-';
  return named.figure.empty() ? named.file.stem().string() : named.figure;
}

/// ".ply" of "worn.PLY", ".glb" of "avatar.glb#Skirt": the one way in which formats are told by names.
inline std::string ending_of(const std::filesystem::path& path) {
  return lower_case(file_of_figure(path).extension().string());
}

}  // namespace furrow::io
