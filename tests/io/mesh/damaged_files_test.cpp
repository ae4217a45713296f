// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;
using io::MeshFormat;

namespace {

std::string valid_file(MeshFormat format) {
  io::MeshFile file = decorated_grid(3);
  file.polylines = {{{Point(0, 0, 0), Point(1, 0, 0)}, {}, false}};
  return written(file, format);
}

std::string text_ply() {
  return "ply\nformat ascii 1.0\ncomment furrow group 0 front\nelement vertex 4\nproperty float x\nproperty "
         "float y\n"
         "property float z\nproperty int line\nproperty double mass\nelement face 2\n"
         "property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int group\n"
         "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty double "
         "rest_length\nproperty double stiffness\nelement strut 1\nproperty int vertex1\nproperty int "
         "vertex2\n"
         "property double rest_length\nproperty double stiffness\nend_header\n"
         "0 0 0 -1 0.1\n1 0 0 0 0.1\n1 1 0 1 nan\n0 1 0 -1 0.1\n3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 0 -1\n"
         "0 1 0.9 5\n2 0 1.5 nan\n1 3 1.4 0.3\n";
}

std::string text_stl() {
  return "solid front\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\n"
         "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
         "0\nendloop\nendfacet\nendsolid\n";
}

/// Reads damaged bytes: a mesh that is whole, or a content error.
void survive(const std::string& bytes, MeshFormat format) {
  try {
    const io::MeshFile file = read_from(bytes, format);
    RC_ASSERT(file.mesh->is_valid(false));
    RC_ASSERT(file.mesh->number_of_faces() > 0u);
    for (const Vertex v : file.mesh->vertices())
      for (int k = 0; k < 3; ++k) RC_ASSERT(std::abs(file.mesh->point(v)[k]) <= 1e9);
  } catch (const ContentError& error) {
    RC_ASSERT(std::string(error.what()).starts_with("test:"));
  }
}

std::string damaged(std::string bytes, const std::vector<std::pair<unsigned short, unsigned char>>& changes) {
  for (const auto& [at, value] : changes) bytes[at % bytes.size()] = static_cast<char>(value);
  return bytes;
}

void check_damage(const std::string& valid, MeshFormat format) {
  REQUIRE(read_from(valid, format).mesh->number_of_faces() > 1);
  CHECK(rc::check("cut short",
                  [&](unsigned short at) { survive(valid.substr(0, at % valid.size()), format); }));
  using Changes = std::vector<std::pair<unsigned short, unsigned char>>;
  CHECK(
      rc::check("bytes changed", [&](const Changes& changes) { survive(damaged(valid, changes), format); }));
  CHECK(rc::check("a digit changed", [&](unsigned short at, unsigned char digit) {
    const std::size_t i = valid.find_first_of("0123456789", at % valid.size());
    std::string bytes = valid;
    if (i != valid.npos) bytes[i] = static_cast<char>('0' + digit % 10);
    survive(bytes, format);
  }));
  CHECK(rc::check("a piece doubled", [&](unsigned short from, unsigned short to) {
    std::string bytes = valid;
    bytes.insert(to % valid.size(), valid.substr(from % valid.size(), 100));
    survive(bytes, format);
  }));
}

}  // namespace

TEST_CASE("damaged files: damaged OBJ files are read or refused") {
  check_damage(valid_file(MeshFormat::obj), MeshFormat::obj);
}
TEST_CASE("damaged files: damaged binary PLY files are read or refused") {
  check_damage(valid_file(MeshFormat::ply), MeshFormat::ply);
}
TEST_CASE("damaged files: damaged text PLY files are read or refused") {
  check_damage(text_ply(), MeshFormat::ply);
}
TEST_CASE("damaged files: damaged OFF files are read or refused") {
  check_damage(valid_file(MeshFormat::off), MeshFormat::off);
}
TEST_CASE("damaged files: damaged binary STL files are read or refused") {
  check_damage(valid_file(MeshFormat::stl), MeshFormat::stl);
}
TEST_CASE("damaged files: damaged text STL files are read or refused") {
  check_damage(text_stl(), MeshFormat::stl);
}
