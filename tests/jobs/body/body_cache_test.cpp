// SPDX-License-Identifier: GPL-3.0-or-later
// What is made of bodies' files, kept for other runs.
#include "jobs/body/body_cache.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "io/base/bytes_file.h"
#include "jobs/rest/drape.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

/// A ball with a hole, which is filled and told of.
struct Ball {
  fs::path folder;
  io::SceneBody body;

  explicit Ball(const std::string& name) : folder(tests::empty_folder(name)) {
    io::MeshFile ball;
    ball.mesh = tests::icosphere(2, 0.1);
    CGAL::Euler::remove_face(ball.mesh->halfedge(geometry::Face(7)), *ball.mesh);
    io::write_mesh(folder / "ball.obj", ball);
    body.mesh = folder / "ball.obj";
    body.cache = folder / "cache";
  }

  jobs::BodyCollider load(jobs::Listener& listener, double at_most = 1) const {
    return jobs::load_body(body, {{}, listener}, at_most);
  }
  fs::path kept(const std::string& ending) const {
    for (const auto& entry : fs::directory_iterator(body.cache))
      if (entry.path().extension() == ending) return entry.path();
    return {};
  }
};

bool is_same(const jobs::BodyCollider& a, const jobs::BodyCollider& b) {
  return a.triangles.vertices == b.triangles.vertices && a.triangles.triangles == b.triangles.triangles &&
         a.field.to_bytes() == b.field.to_bytes() && a.outline.box.isApprox(b.outline.box, 0) &&
         a.outline.closed == b.outline.closed && a.outline.nearly_closed == b.outline.nearly_closed &&
         a.outline.figure == b.outline.figure;
}

std::vector<std::string> texts_of(const tests::Recorder& recorder) {
  std::vector<std::string> texts;
  for (const jobs::Warning& w : recorder.warnings)
    texts.push_back(w.code + "|" + w.text + "|" + w.where + "|" + w.help);
  return texts;
}

}  // namespace

TEST_CASE("body_cache: a body is the same, and what is told of it, whether it was kept or not") {
  Ball ball("body_cache");
  tests::Recorder without, making, with;
  const jobs::BodyCollider made = ball.load(making), found = ball.load(with);
  CHECK(tests::names_in(ball.body.cache).size() == 4);  // a body, its field, and their locks
  ball.body.cache.clear();
  const jobs::BodyCollider own = ball.load(without);
  CHECK(is_same(own, made));
  CHECK(is_same(own, found));
  CHECK(without.warned_of("body_holes_filled"));
  CHECK(texts_of(without) == texts_of(making));
  CHECK(texts_of(without) == texts_of(with));
}

TEST_CASE("body shelf: a body is loaded once, and anew where its file or its field is another") {
  Ball ball("body_shelf");
  ball.body.cache.clear();
  jobs::MemoryFiles memory;
  memory.shelf = std::make_shared<jobs::BodyShelf>();
  const auto load = [&](const io::SceneBody& body) {
    tests::Recorder told;
    const jobs::BodyCollider loaded = jobs::load_body(body, {{}, told, &memory}, 1);
    return std::pair(loaded.triangles.vertices, told.warned_of("body_holes_filled"));
  };
  const auto first = load(ball.body), again = load(ball.body);
  CHECK(first.second);  // it is read, and its hole is told of
  CHECK_FALSE(again.second);
  CHECK(first.first == again.first);
  io::SceneBody other = ball.body;
  other.options.tolerance = 0.004;
  CHECK(load(other).second);
  fs::last_write_time(ball.body.mesh, fs::last_write_time(ball.body.mesh) + std::chrono::seconds(2));
  CHECK(load(ball.body).second);
  CHECK_FALSE(load(ball.body).second);
}

TEST_CASE("body_cache: another unit, another tolerance and another content are other files", "[long]") {
  Ball ball("body_cache_keys");
  jobs::Listener nobody;
  const double usual = ball.load(nobody).field.report().tolerance;
  CHECK(ball.load(nobody, usual / 2).field.report().tolerance == usual / 2);
  CHECK(tests::names_in(ball.body.cache).size() == 6);
  ball.body.unit = "cm";
  ball.body.options.tolerance = 0.0001;
  CHECK_THROWS_AS(ball.load(nobody), geometry::ContentError);  // 2 mm: what is refused is not kept
  CHECK(tests::names_in(ball.body.cache).size() == 7);         // but for its lock
  ball.body.unit.reset();
  ball.body.options.tolerance.reset();
  io::MeshFile other;
  other.mesh = tests::icosphere(1, 0.1);
  io::write_mesh(ball.body.mesh, other);
  CHECK(ball.load(nobody).triangles.triangles.size() == other.mesh->number_of_faces());
}

TEST_CASE("body_cache: a damaged file is told of, and made again", "[long]") {
  Ball ball("body_cache_broken");
  jobs::Listener nobody;
  const jobs::BodyCollider whole = ball.load(nobody);
  for (const std::string ending : {".body", ".field"}) {
    const fs::path path = ball.kept(ending);
    const std::vector<std::byte> good = io::read_bytes(path);
    std::vector<std::byte> bad = good;
    bad[bad.size() / 2] ^= std::byte{1};
    for (const std::size_t size : {bad.size(), bad.size() / 3, std::size_t{0}}) {
      bad.resize(size);
      io::write_bytes(path, bad);
      tests::Recorder recorder;
      CHECK(is_same(ball.load(recorder), whole));
      CHECK(recorder.warned_of("cache_broken"));
      CHECK(io::read_bytes(path) == good);
    }
  }
}

TEST_CASE("body_cache: a folder that cannot be written is told of, and the body is there all the same") {
  Ball ball("body_cache_unwritable");
  jobs::Listener nobody;
  ball.body.cache = ball.body.mesh / "cache";
  tests::Recorder recorder;
  CHECK(ball.load(recorder).triangles.triangles.size() > 0);
  CHECK(recorder.warned_of("cache_unwritten"));
}

TEST_CASE("body_cache: a garment brought from another body rests by the same bits", "[release]") {
  const fs::path folder = tests::empty_folder("body_cache_made_for"), meshes = tests::source_dir() / "meshes";
  const auto worn = [&](const std::string& name, bool keeps) {
    jobs::DrapeJob job;
    job.scene.settings =
        io::parse_toml("[garment]\nmesh = \"" + (meshes / "skirt.obj").string() + "\"\n", "test");
    const auto set = [&](const std::string& path, const io::Json& value) {
      io::set_value(job.scene.settings, path, value, "the test");
    };
    set("body.mesh", (meshes / "mannequin.obj").string());
    set("body.tolerance", 0.004);
    if (keeps) set("body.cache", (folder / "cache").string());
    job.settings.made_for = meshes / "mannequin.obj";
    job.settings.iterations = 3;
    job.subdivide = 0;
    job.output = folder / (name + ".ply");
    tests::Recorder recorder;
    const jobs::DrapeJobReport report = jobs::drape(job, recorder);
    REQUIRE(report.garments[0].placed);
    return std::pair{tests::bytes_of(job.output), texts_of(recorder)};
  };
  const auto without = worn("without", false), making = worn("making", true), with = worn("with", true);
  CHECK(without == making);
  CHECK(without == with);
  std::set<std::string> endings;
  for (const std::string& name : tests::names_in(folder / "cache"))
    endings.insert(fs::path(name).extension());
  CHECK(endings == std::set<std::string>{".body", ".field", ".lock", ".skeleton"});
}
