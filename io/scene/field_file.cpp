// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/field_file.h"

#include <cstdint>
#include <cstring>

#include "geometry/mesh/errors.h"
#include "io/base/bytes_file.h"

namespace furrow::io {
namespace {

/// FNV-1a of the triangles' corner positions, in order.
std::uint64_t fingerprint(const physics::TriangleMesh& body) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const auto& triangle : body.triangles)
    for (int corner : triangle)
      for (int k = 0; k < 3; ++k) {
        std::uint64_t bits;
        std::memcpy(&bits, &body.vertices[corner][k], sizeof bits);
        for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> (8 * byte) & 255)) * 1099511628211ull;
      }
  return hash;
}

}  // namespace

void write_field(const std::filesystem::path& path, const physics::DistanceField& field,
                 const physics::TriangleMesh& body) {
  const std::uint64_t mark = fingerprint(body);
  std::vector<std::byte> bytes(sizeof mark);
  std::memcpy(bytes.data(), &mark, sizeof mark);
  const std::vector<std::byte> block = field.to_bytes();
  bytes.insert(bytes.end(), block.begin(), block.end());
  write_bytes(path, bytes);
}

physics::DistanceField read_field(const std::filesystem::path& path, const physics::TriangleMesh& body) {
  const std::vector<std::byte> bytes = read_bytes(path);
  const auto fail = [&](const std::string& what) {
    return geometry::ContentError(path.string() + ": " + what + "; make it again with `furrow sdf`");
  };
  std::uint64_t mark = 0;
  if (bytes.size() < sizeof mark) throw fail("not a distance field");
  std::memcpy(&mark, bytes.data(), sizeof mark);
  try {
    physics::DistanceField field = physics::DistanceField::from_bytes(std::span(bytes).subspan(sizeof mark));
    if (mark != fingerprint(body))
      throw fail("the distance field of another body, or of this one in another unit (`unit`, `up`)");
    return field;
  } catch (const std::invalid_argument& e) {
    throw fail(e.what());
  }
}

}  // namespace furrow::io
