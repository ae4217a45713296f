// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <random>
#include <vector>

#include "io/animation/animation_file.h"
#include "io/mesh/mesh_formats.h"
#include "io/scene/scene_file.h"
#include "io/scene/state_file.h"
#include "io/stroke/stroke_file.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;
using io::MeshFormat;

namespace {

constexpr int mutants = std::max(250, FURROW_PROPERTY_CASES);

/// What breaks readers: numbers at the ends of types, words for no number, levels, texts cut off.
const std::vector<std::string> poisons = {"nan",
                                          "-1",
                                          "1e999",
                                          "1e-320",
                                          "4294967296",
                                          "9223372036854775808",
                                          "0",
                                          "\"",
                                          "[[[[[[[[",
                                          "}{",
                                          "\n",
                                          std::string(1, '\0'),
                                          "\xe9",
                                          "\xff\xff\xff\xff",
                                          std::string(4, '\0'),
                                          "\x7f\xff\xff\xff",
                                          "//",
                                          "../x"};

/// One to eight changes: bytes, bits, digits, poisons, pieces doubled, cut out or exchanged, the end cut off.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto at = [&] { return bytes.empty() ? 0 : random() % bytes.size(); };
  for (std::size_t n = 1 + random() % 8; n > 0 && !bytes.empty(); --n) {
    const std::size_t i = at();
    switch (random() % 8) {
      case 0:
        bytes[i] = static_cast<char>(random());
        break;
      case 1:
        bytes[i] = static_cast<char>(bytes[i] ^ 1 << random() % 8);
        break;
      case 2:
        bytes.replace(i, random() % 6, poisons[random() % poisons.size()]);
        break;
      case 3:
        bytes.insert(at(), bytes.substr(i, random() % 200));
        break;
      case 4:
        bytes.erase(i, random() % 50);
        break;
      case 5:
        bytes.replace(i, random() % 20, bytes.substr(at(), random() % 20));
        break;
      case 6: {
        const std::size_t digit = bytes.find_first_of("0123456789", i);
        if (digit != bytes.npos) bytes[digit] = static_cast<char>('0' + random() % 10);
        break;
      }
      default:
        if (n == 1 && random() % 4 == 0) bytes.resize(i);
    }
  }
  return bytes;
}

/// Reads mutants: each is read, or refused as content or as a wrong option. Counts both.
void check_mutants(const std::string& valid, const std::function<void(const std::string&)>& read) {
  std::mt19937 random(1017);
  REQUIRE_NOTHROW(read(valid));
  int good = 0, refused = 0;
  for (int k = 0; k < mutants; ++k) {
    const std::string bytes = mutated(valid, random);
    try {
      read(bytes);
      ++good;
    } catch (const ContentError& error) {
      ++refused;
      CHECK_FALSE(std::string(error.what()).empty());
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  INFO(good << " read, " << refused << " refused");
  CHECK(good + refused == mutants);
  CHECK(refused > mutants / 20);
}

void check_mesh_mutants(const std::string& valid, MeshFormat format) {
  check_mutants(valid, [&](const std::string& bytes) {
    const io::MeshFile file = read_from(bytes, format);
    REQUIRE(file.mesh->is_valid(false));
    REQUIRE(file.mesh->number_of_faces() > 0);
  });
}

io::MeshFile garment() {
  io::MeshFile file = decorated_grid(3);
  io::set_wrinkle_record(file, {});
  return file;
}

/// The reader of a file of that name, which takes a path.
std::function<void(const std::string&)> from_file(const std::filesystem::path& path,
                                                  const std::function<void()>& read) {
  return [=](const std::string& bytes) {
    spit(path, bytes);
    read();
  };
}

}  // namespace

TEST_CASE("mutated files: each format of meshes that is read from a text") {
  int formats = 0;
  for (const io::MeshEnding& e : io::mesh_endings())
    if (e.read && e.write && ++formats) check_mesh_mutants(written(garment(), e.format), e.format);
  CHECK(formats >= 4);
}

TEST_CASE("mutated files: PLY and STL as text") {
  check_mesh_mutants(
      "ply\nformat ascii 1.0\ncomment furrow group 0 front\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nproperty int line\nelement face 2\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nelement edge 1\n"
      "property int vertex1\nproperty int vertex2\nproperty double rest_length\nend_header\n"
      "0 0 0 -1\n1 0 0 0\n1 1 0 1\n0 1 0 -1\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n0 1 0.9\n",
      MeshFormat::ply);
  check_mesh_mutants(
      "solid front\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid\n",
      MeshFormat::stl);
}

TEST_CASE("mutated files: GLB", "[long]") {
  TemporaryFolder folder;
  const io::MeshFile file = garment();
  io::AnimationWriter writer(folder / "v.glb", file.mesh, {});
  std::vector<physics::Vec3> x;
  for (const Point& p : file.mesh->points()) x.emplace_back(p.x(), p.y(), p.z());
  writer.add(x);
  writer.close();
  check_mutants(slurp(folder / "v.glb"),
                from_file(folder / "a.glb", [&] { io::read_mesh(folder / "a.glb"); }));
}

TEST_CASE("mutated files: strokes and scenes") {
  check_mutants(R"({"strokes": [{"name": "a", "height": 0.02, "width": 0.06, "sharpness": 0.5, "press": 2,
      "points": [[0, 0, 0], [1, 0, 0.5]], "direction": [0, 1, 0], "breaks": [1]},
      {"name": "b", "vertices": [0, 5, 7], "closed": true},
      {"name": "c", "texture": [[0, 0], [0.5, 1]], "group": "front", "near": [0, 0, 1]}]})",
                [](const std::string& bytes) { io::drawn_strokes_from(bytes, "test"); });
  check_mutants(
      "title = \"a\"\n[garment]\nmesh = \"a.obj\"\n[material]\nstretch = 30.0\ndensity = 0.1\n"
      "[[pins]]\nbox = [0, 0, 0, 1, 1, 1]\n[[lines]]\nstrokes = \"s.json\"\ntime = 0.5\n"
      "[simulation]\nseconds = 2\ndt = 1e-4\n[forces]\ngravity = [0, -9.81, 0]\n"
      "[output]\nmesh = \"o.ply\"\nfps = 25\n",
      [](const std::string& bytes) { io::read_scene(io::parse_toml(bytes, "test"), "."); });
}

TEST_CASE("mutated files: states") {
  io::SavedState state;
  state.file = garment();
  auto velocity = ensure_map(state.file.mesh, attribute::velocity);
  for (const Vertex v : state.file.mesh->vertices()) velocity[v] = {0.1, 0, 0.2};
  state.pins = {{1, 2}, {}};
  *state.scene = {{"garment", {{"mesh", "../g.obj"}}}, {"simulation", {{"seconds", 2}}}};
  check_mutants(io::state_bytes(state), [](const std::string& bytes) { io::parse_state(bytes, "test"); });
}

TEST_CASE("mutated files: PC2 and MDD") {
  TemporaryFolder folder;
  const io::MeshFile file = garment();
  std::vector<physics::Vec3> x;
  for (const Point& p : file.mesh->points()) x.emplace_back(p.x(), p.y(), p.z());
  for (const char* name : {"a.pc2", "a.mdd"}) {
    io::AnimationWriter writer(folder / name, file.mesh, {});
    for (int frame = 0; frame < 3; ++frame) writer.add(x);
    writer.close();
    check_mutants(slurp(folder / name), from_file(folder / name, [&] {
                    const auto frames = io::open_frames(folder / name, x.size());
                    for (std::size_t i = 0; i < frames->frames() && i < 10; ++i) frames->positions(i);
                  }));
  }
}
