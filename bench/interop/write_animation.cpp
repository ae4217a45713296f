// SPDX-License-Identifier: GPL-3.0-or-later
// What other programs are to read: write_animation MESH FOLDER deforms a mesh by formulas, writes the frames
// in every format, and the same positions in double precision, to compare with.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <span>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "geometry/mesh/property_names.h"
#include "io/animation/animation_file.h"
#include "io/base/bytes_file.h"

namespace {

using namespace furrow;
using physics::Vec3;

constexpr int frames = 12;
constexpr double frame_rate = 25;

/// A wave that runs through the cloth while it bends and moves on.
std::vector<Vec3> deformed(std::span<const Vec3> rest, int frame) {
  const double t = frame / frame_rate;
  std::vector<Vec3> x;
  for (const Vec3& p : rest)
    x.push_back(p + Vec3(0.3 * t, 0.05 * std::sin(9 * p.x() - 12 * t), 0.08 * std::sin(7 * p.y() + 5 * t)));
  return x;
}

/// Two islands, so that the vertices between them have two texture coordinates.
void add_texture(geometry::Mesh& mesh) {
  auto texture = geometry::ensure_map(mesh, geometry::attribute::texture);
  for (const geometry::Face f : mesh.faces()) {
    const geometry::Halfedge around = mesh.halfedge(f);
    const bool left = mesh.point(mesh.target(around)).x() + mesh.point(mesh.source(around)).x() < 0;
    for (const geometry::Halfedge h : mesh.halfedges_around_face(around)) {
      const geometry::Point& p = mesh.point(mesh.target(h));
      texture[h] = {p.x() / 2 + (left ? 0.25 : 0.75), p.y()};
    }
  }
}

void run(const std::filesystem::path& in, const std::filesystem::path& folder) {
  io::MeshFile file = io::read_mesh(in);
  add_texture(file.mesh);
  const std::vector<Vec3> rest = bridge::positions_of(file.mesh);
  std::vector<io::AnimationWriter> writers;
  for (const char* name : {"sheet.pc2", "sheet.mdd", "sheet-linear.glb"})
    writers.emplace_back(folder / name, file.mesh, io::AnimationOptions{.fps = frame_rate});
  writers.emplace_back(folder / "sheet-step.glb", file.mesh,
                       io::AnimationOptions{.fps = frame_rate, .interpolation = io::Interpolation::step});
  std::vector<Vec3> expected;
  for (int i = 0; i < frames; ++i) {
    const std::vector<Vec3> x = deformed(rest, i);
    for (io::AnimationWriter& writer : writers) writer.add(x);
    expected.insert(expected.end(), x.begin(), x.end());
  }
  for (io::AnimationWriter& writer : writers) writer.close();
  io::write_bytes(folder / "expected.f64", std::as_bytes(std::span(expected)));
  physics::Particles first;
  first.x.assign(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(rest.size()));
  bridge::scatter(first, file.mesh);
  io::write_mesh(folder / "sheet.obj", file);
  std::cout << frames << " frames of " << rest.size() << " vertices in " << folder.string() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::invalid_argument("write_animation MESH FOLDER");
    run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
}
