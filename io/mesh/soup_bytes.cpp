// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/soup_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

using geometry::Point;

template <class T>
void put(std::string& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t n = values.size();
  bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  bytes.append(reinterpret_cast<const char*>(values.data()), n * sizeof(T));
}

void put(std::string& bytes, const std::vector<std::string>& names) {
  put(bytes, std::vector<std::size_t>{names.size()});
  for (const std::string& name : names) put(bytes, std::vector<char>(name.begin(), name.end()));
}

void put(std::string& bytes, const GltfSource& gltf) {
  put(bytes, std::vector<std::string>{gltf.document, gltf.binary});
  put(bytes, gltf.places);
  put(bytes, gltf.materials);
  put(bytes, gltf.lost);
}

[[noreturn]] void fail() { throw geometry::ContentError("the reader sent nonsense: the file is damaged"); }

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void get(std::vector<T>& values) {
    std::size_t n = 0;
    take(&n, sizeof n, 1);
    if (n > bytes_.size() / sizeof(T)) fail();
    values.resize(n);
    take(values.data(), sizeof(T), n);
  }

  void get(std::vector<std::string>& names) {
    std::vector<std::size_t> count;
    get(count);
    if (count.size() != 1 || count[0] > bytes_.size() / sizeof(std::size_t)) fail();
    std::vector<char> name;
    for (std::size_t i = 0; i < count[0]; ++i) {
      get(name);
      names.emplace_back(name.begin(), name.end());
    }
  }

  void get(GltfSource& gltf) {
    std::vector<std::string> texts;
    get(texts);
    if (texts.size() != 2) fail();
    gltf.document = std::move(texts[0]);
    gltf.binary = std::move(texts[1]);
    get(gltf.places);
    get(gltf.materials);
    get(gltf.lost);
  }

  bool at_end() const { return bytes_.empty(); }

 private:
  void take(void* to, std::size_t size, std::size_t n) {
    if (n > bytes_.size() / size) fail();
    if (n > 0) std::memcpy(to, bytes_.data(), n * size);
    bytes_.remove_prefix(n * size);
  }

  std::string_view bytes_;
};

void check(const SoupFile& file) {
  const PolygonSoup& s = file.soup;
  const auto fits = [](std::size_t size, std::size_t wanted) { return size == 0 || size == wanted; };
  if (s.first_corner.empty() || s.first_corner.front() != 0 || s.first_corner.back() != s.corners.size() ||
      !std::ranges::is_sorted(s.first_corner))
    fail();
  if (!fits(s.colors.size(), s.points.size()) || !fits(s.textures.size(), s.corners.size()) ||
      !fits(s.second_textures.size(), s.corners.size()) || !fits(s.groups.size(), s.faces()) ||
      !fits(s.materials.size(), s.faces()))
    fail();
  if (std::ranges::any_of(s.attributes, [&](const auto& a) { return a.values.size() != s.points.size(); }))
    fail();
  if (std::ranges::any_of(s.corners, [&](std::size_t c) { return c >= s.points.size(); })) fail();
  if (!fits(file.gltf.places.size(), file.group_names.size()) ||
      !fits(file.gltf.materials.size(), file.material_names.size()))
    fail();
  for (const Point& p : s.points)
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) fail();
}

}  // namespace

std::string to_bytes(const SoupFile& file) {
  std::string bytes;
  std::vector<double> coordinates;
  for (const Point& p : file.soup.points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  put(bytes, coordinates);
  put(bytes, file.soup.colors);
  std::vector<std::string> names;
  for (const SoupAttribute& attribute : file.soup.attributes) names.push_back(attribute.name);
  put(bytes, names);
  put(bytes, file.soup.first_corner);
  put(bytes, file.soup.corners);
  put(bytes, file.soup.textures);
  put(bytes, file.soup.second_textures);
  put(bytes, file.soup.groups);
  put(bytes, file.soup.materials);
  for (const SoupAttribute& attribute : file.soup.attributes) put(bytes, attribute.values);
  put(bytes, file.group_names);
  put(bytes, file.material_names);
  put(bytes, file.warnings);
  put(bytes, file.gltf);
  put(bytes, std::vector<std::size_t>{file.merged_vertices});
  return bytes;
}

SoupFile soup_from_bytes(std::string_view bytes) {
  SoupFile file;
  Reader in(bytes);
  std::vector<double> coordinates;
  std::vector<std::size_t> merged;
  in.get(coordinates);
  in.get(file.soup.colors);
  std::vector<std::string> names;
  in.get(names);
  for (std::string& name : names) file.soup.attributes.push_back({std::move(name), {}});
  in.get(file.soup.first_corner);
  in.get(file.soup.corners);
  in.get(file.soup.textures);
  in.get(file.soup.second_textures);
  in.get(file.soup.groups);
  in.get(file.soup.materials);
  for (SoupAttribute& attribute : file.soup.attributes) in.get(attribute.values);
  in.get(file.group_names);
  in.get(file.material_names);
  in.get(file.warnings);
  in.get(file.gltf);
  in.get(merged);
  if (!in.at_end() || merged.size() != 1 || coordinates.size() % 3 != 0) fail();
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    file.soup.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  file.merged_vertices = merged[0];
  check(file);
  return file;
}

}  // namespace furrow::io
