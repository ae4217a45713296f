// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/own_output.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <functional>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"
#include "geometry/mesh/property_names.h"
#include "io/animation/animation_file.h"
#include "io/base/camera_file.h"
#include "io/base/own_mark.h"
#include "io/picture/baked_maps.h"
#include "io/picture/png_file.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/output_checks.h"
#include "jobs/mesh/smooth.h"
#include "jobs/mesh/subdivide.h"
#include "jobs/mesh/transfer.h"
#include "jobs/move/chart_files.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

io::MeshFile some_mesh() {
  io::MeshFile file;
  file.mesh = tests::jittered(8, 8, 0.2, 3);
  return file;
}

io::MeshFile coloured_mesh() {
  io::MeshFile file = some_mesh();
  auto colours = geometry::ensure_map(file.mesh, geometry::attribute::color);
  for (geometry::Vertex v : file.mesh->vertices()) colours[v] = {0.1, 1, 0.25, 1};
  return file;
}

void put(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

io::Image grey(int width, int height) {
  io::Image image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) image.rgb.push_back(std::uint8_t(37 * i * i));
  return image;
}

/// The chunk of a PNG, with a wrong checksum, which nobody looks at here.
std::string chunk(const std::string& kind, const std::string& data) {
  std::string bytes;
  for (int k = 3; k >= 0; --k) bytes += char(data.size() >> 8 * k & 255);
  return bytes + kind + data + "\1\2\3\4";
}

std::vector<physics::Vec3> frame_of(const geometry::Mesh& mesh) {
  std::vector<physics::Vec3> positions;
  for (geometry::Vertex v : mesh.vertices()) positions.push_back(bridge::to_eigen(mesh.point(v)));
  return positions;
}

/// Says whether files may be replaced, and counts the questions.
struct Replacing : jobs::Listener {
  bool answer = false;
  int asked = 0;
  bool replaces(const std::string&) override { return ++asked, answer; }
};

/// A garment as Blender writes it.
std::string of_blender() {
  return "# Blender 4.2.3 LTS\n# www.blender.org\nmtllib shirt.mtl\no Shirt\nv 0.000000 0.000000 0.000000\n"
         "v 1.000000 0.000000 -0.250000\nv 0.000000 1.000000 0.333333\nvn 0.0000 0.0000 1.0000\n"
         "vt 0.625000 0.500000\ns 0\nusemtl Cloth\nf 1/1/1 2/1/1 3/1/1\n";
}

}  // namespace

TEST_CASE("own_output: a mesh of every format that is written is known again") {
  const fs::path folder = tests::empty_folder("own_meshes");
  for (const char* ending : {"obj", "ply", "off", "stl"})
    for (const io::MeshFile& file : {some_mesh(), coloured_mesh()}) {
      const fs::path path = folder / (std::string("mesh.") + ending);
      io::write_mesh(path, file);
      INFO(path);
      CHECK(jobs::is_own_output(path));
      io::write_mesh(path, file, {0.01, io::Axis::z});
      CHECK(jobs::is_own_output(path));
    }
  io::MeshFile wrinkled = some_mesh();
  io::set_wrinkle_record(wrinkled, {});
  wrinkled.comments.push_back("Created by some other program");
  io::write_mesh(folder / "wrinkled.ply", wrinkled);
  CHECK(jobs::is_own_output(folder / "wrinkled.ply"));
}

TEST_CASE("own_output: animations, pictures and maps are known again") {
  const fs::path folder = tests::empty_folder("own_others");
  const io::MeshFile file = some_mesh();
  for (const char* name : {"a.pc2", "a.mdd", "a.glb"}) {
    io::AnimationWriter writer(folder / name, file.mesh, {});
    for (int i = 0; i < 3; ++i) writer.add(frame_of(file.mesh));
    writer.close();
    INFO(name);
    CHECK(jobs::is_own_output(folder / name));
  }
  for (const io::Image& image : {grey(3, 2), grey(300, 200)}) {
    io::write_png(folder / "a.png", image);
    CHECK(jobs::is_own_output(folder / "a.png"));
  }
  geometry::BakedMaps maps;
  for (geometry::VectorMap* map : {&maps.displacement, &maps.normal})
    map->size = 64, map->texels.assign(64 * 64, {0.1f, 0.2f, 0.3f});
  const io::BakedFiles baked = io::write_baked_maps((folder / "b").string(), maps);
  for (const fs::path& path : {baked.displacement, baked.normal, baked.record}) {
    INFO(path);
    CHECK(jobs::is_own_output(path));
  }
}

TEST_CASE("own_output: strokes, cameras and charts are known again") {
  const fs::path folder = tests::empty_folder("own_texts");
  geometry::Stroke stroke;
  stroke.points = {{0, 0, 0}, {0.1, 1.0 / 3, 0}};
  io::write_strokes(folder / "lines.json", std::vector<geometry::Stroke>{stroke});
  CHECK(jobs::is_own_output(folder / "lines.json"));
  io::write_camera(folder / "cam.json", {});
  CHECK(jobs::is_own_output(folder / "cam.json"));
  jobs::write_chart_csv((folder / "c.csv").string(), {});
  CHECK(jobs::is_own_output(folder / "c.csv"));
  put(folder / "empty.obj", "");
  CHECK(jobs::is_own_output(folder / "empty.obj"));
  CHECK_FALSE(jobs::is_own_output(folder / "absent.obj"));
}

TEST_CASE("own_output: an OBJ of another program with transferred positions is furrow's") {
  const fs::path folder = tests::empty_folder("own_transfer");
  tests::Recorder listener;
  for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
    put(folder / "a.obj", mark + of_blender());
    CHECK_FALSE(jobs::is_own_output(folder / "a.obj"));
    jobs::TransferJob job;
    job.original = job.wrinkled = folder / "a.obj";
    job.rest = job.original;
    job.output = folder / "b.obj";
    for (int again = 0; again < 2; ++again) {
      jobs::transfer(job, listener);
      CHECK(jobs::is_own_output(job.output));
      CHECK(tests::bytes_of(job.output) == mark + "# written by furrow\n" + of_blender());
    }
    job.original = job.wrinkled = folder / "b.obj";
    job.rest = job.original;
    job.output = folder / "c.obj";
    jobs::transfer(job, listener);
    CHECK(tests::bytes_of(job.output) == tests::bytes_of(folder / "b.obj"));
  }
}

TEST_CASE("own_output: what is as furrow writes it, but for the mark, is not furrow's") {
  const fs::path folder = tests::empty_folder("unmarked");
  const io::MeshFile mesh = some_mesh();
  const auto unmarked = [&](const char* name, std::string_view mark) {
    std::string bytes = tests::bytes_of(folder / name);
    const std::size_t at = bytes.rfind(mark);
    INFO(name);
    CHECK(jobs::is_own_output(folder / name));
    REQUIRE(at != bytes.npos);
    put(folder / name, bytes.erase(at, mark.size()));
    CHECK_FALSE(jobs::is_own_output(folder / name));
  };
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) io::write_mesh(folder / name, mesh);
  unmarked("a.ply", "comment written by furrow\n");  // as CGAL writes it
  unmarked("a.obj", "# written by furrow\n");
  unmarked("a.off", "# written by furrow\n");
  unmarked("a.stl", "written by furrow");
  for (const char* name : {"a.pc2", "a.mdd", "a.glb"}) {
    io::AnimationWriter writer(folder / name, mesh.mesh, {});
    writer.add(frame_of(mesh.mesh));
    writer.close();
  }
  unmarked("a.pc2", io::own_tail);
  unmarked("a.mdd", io::own_tail);
  unmarked("a.glb", "\"generator\":\"Furrow\"");
  io::write_png(folder / "a.png", grey(300, 200));
  io::write_png16(folder / "b.png", {2, 1, {1, 2, 3, 4, 5, 65535}});
  unmarked("a.png", io::png_mark);
  unmarked("b.png", io::png_mark);
  io::write_strokes(folder / "a.json", std::vector<geometry::Stroke>{
                                           {.name = "a", .points = {{0, 0, 0}, {1, 0, 0}}, .direction = {}}});
  unmarked("a.json", "\"generator\": \"furrow\"");
  io::write_camera(folder / "c.json", {});
  unmarked("c.json", ",\"generator\":\"furrow\"");
}

TEST_CASE("own_output: meshes of the repository are not furrow's outputs") {
  for (const char* name : {"skirt.obj", "shirt.obj", "mannequin.obj"}) {
    INFO(name);
    CHECK_FALSE(jobs::is_own_output(tests::source_dir() / "meshes" / name));
  }
}

TEST_CASE("own_output: files of other programs and of people are told from furrow's") {
  const fs::path folder = tests::empty_folder("foreign");
  const std::string png = "\x89PNG\r\n\x1a\n", rgb8("\0\0\0\2\0\0\0\2\10\2\0\0\0", 13),
                    rgba8("\0\0\0\2\0\0\0\2\10\6\0\0\0", 13), end = chunk("IEND", "");
  const std::string ply = "ply\nformat binary_little_endian 1.0\n";
  const std::vector<std::pair<std::string, std::string>> files{
      {"blender.obj", of_blender()},
      {"meshlab.obj", "####\n# OBJ File Generated by Meshlab\nvn 0 0 1\nv 0.5 0 0\nv 1 0 0\nf 1 2 2\n"},
      {"makehuman.obj", "v 0.1000 0.2000 0.3000\nv 1.0000 0.0000 0.0000\nf 1 2 2\n"},
      {"seventeen.obj", "v 0.10000000000000001 0.20000000000000001 0.29999999999999999\n"},
      {"crlf.obj", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n"},
      {"ascii.ply", "ply\nformat ascii 1.0\ncomment furrow wrinkle {}\nelement vertex 0\nend_header\n"},
      {"blender.ply", ply +
                          "comment Created by Blender\nelement vertex 1\nproperty float x\nproperty float y\n"
                          "property float z\nelement face 0\nproperty list uchar uint vertex_indices\n"
                          "end_header\n"},
      {"open3d.ply", ply +
                         "comment Created by Open3D\nelement vertex 1\nproperty double x\nproperty double y\n"
                         "property double z\nelement face 0\nproperty list uchar uint vertex_indices\n"
                         "end_header\n"},
      {"meshlab.off", "OFF\n3 1 0\n0.000000 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"edges.off", "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.stl", std::string(84, '\0')},
      {"ascii.stl", "solid shirt\nendsolid\n"},
      {"a.glb", "glTF....{\"asset\":{\"generator\":\"Khronos glTF Blender I/O v4\"}}"},
      // a script that writes single precision as three.js does
      {"three.obj",
       "# my own work\no Mesh\nv 0.10000000149011612 0.20000000298023224 0.30000001192092896\n"
       "v 1.100000023841858 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n"},
      {"script.obj", "v 0 0 0\nv 0.1 0 0.30000000000000004\nv 0 1 0\nf 1 2 3\n"},
      {"cgal.ply", ply + "comment Generated by the CGAL library\nelement vertex 0\nproperty double x\n"
                         "property double y\nproperty double z\nelement face 0\n"
                         "property list uchar int vertex_indices\nend_header\n"},
      {"one.pc2",
       std::string("POINTCACHE2\0\1\0\0\0\1\0\0\0\0\0\0\0\0\0\x80\x3f\1\0\0\0", 32) + std::string(12, '\0')},
      {"one.mdd", std::string("\0\0\0\1\0\0\0\1\0\0\0\0", 12) + std::string(12, '\0')},
      {"deep16.png",
       png + chunk("IHDR", std::string("\0\0\0\2\0\0\0\2\20\2\0\0\0", 13)) + chunk("IDAT", "x") + end},
      {"python.json", "{\n \"strokes\": [\n  {\n   \"height\": 0.02\n  }\n ]\n}\n"},
      {"page.html", "<!DOCTYPE html>\n<html><body>my report</body></html>\n"},
      {"short.pc2", std::string("POINTCACHE2\0\1\0\0\0\4\0\0\0\0\0\0\0\0\0\x80\x3f\1\0\0\0", 32)},
      {"a.mdd", "not an animation at all"},
      {"plain.png", png + chunk("IHDR", rgb8) + chunk("IDAT", "x") + end},
      {"alpha.png", png + chunk("IHDR", rgba8) + chunk("sRGB", "\1") + chunk("IDAT", "x") + end},
      {"text.png", png + chunk("IHDR", rgb8) + chunk("sRGB", "\1") + chunk("tEXt", "Software") +
                       chunk("IDAT", "x") + end},
      {"pieces.png", png + chunk("IHDR", rgb8) + chunk("sRGB", "\1") + chunk("IDAT", std::string(9000, 'x')) +
                         chunk("IDAT", "x") + end},
      {"cut.png", png + chunk("IHDR", rgb8)},
      {"mine.json", "{\"strokes\": [{\"name\": \"a\", \"height\": 0.02, \"vertices\": [0, 1]}]}\n"},
      {"package.json", "{\n \"name\": \"x\"\n}\n"},
      {"list.json", "[1, 2]\n"},
      {"broken.json", "{\"strokes\": "},
      {"deep.json", "{" + std::string(200000, '[')},
      {"notes.txt", "v for victory\n"},
      {"shirt.blend", "BLENDER-v402"},
      {"a.csv", "name,price\n"}};
  for (const auto& [name, bytes] : files) {
    put(folder / name, bytes);
    INFO(name);
    CHECK_FALSE(jobs::is_own_output(folder / name));
  }
}

TEST_CASE("check_replaced: asks once a file that is there and is not furrow's, and throws where it may not") {
  const fs::path folder = tests::empty_folder("replaced");
  const std::string foreign = (folder / "foreign.obj").string(), own = (folder / "own.ply").string();
  put(foreign, of_blender());
  io::write_mesh(own, some_mesh());
  Replacing listener;
  jobs::check_replaced({own, "", "-", "/dev/null", (folder / "new.obj").string()}, {}, listener);
  CHECK(listener.asked == 0);
  CHECK_THROWS_WITH(jobs::check_replaced({own, foreign}, {}, listener),
                    Contains("foreign.obj: exists, and furrow did not write it") && Contains("`replace`"));
  CHECK(listener.asked == 1);
  listener.answer = true;
  jobs::check_replaced({own, foreign}, {}, listener);
  CHECK_THROWS_WITH(jobs::check_replaced({foreign}, {foreign}, listener), Contains("would replace"));
}

TEST_CASE("own_output: jobs keep a foreign file unless their listener replaces it") {
  const fs::path folder = tests::empty_folder("jobs_replace");
  const fs::path out = folder / "precious.obj";
  const auto smooth = [&](jobs::Listener& listener) {
    jobs::SmoothJob job;
    job.mesh = some_mesh();
    job.output = out;
    jobs::smooth(job, listener);
  };
  const auto subdivide = [&](jobs::Listener& listener) {
    jobs::SubdivideJob job{some_mesh()};
    job.refinement = jobs::Refinement::linear;
    job.steps = 1;
    job.output = out;
    jobs::subdivide(job, listener);
  };
  for (const std::function<void(jobs::Listener&)>& run :
       std::vector<std::function<void(jobs::Listener&)>>{smooth, subdivide}) {
    put(out, of_blender());
    Replacing listener;
    CHECK_THROWS_AS(run(listener), std::invalid_argument);
    CHECK(tests::bytes_of(out) == of_blender());
    listener.answer = true;
    run(listener);
    CHECK(jobs::is_own_output(out));
    listener.asked = 0;
    run(listener);
    CHECK(listener.asked == 0);
  }
}
