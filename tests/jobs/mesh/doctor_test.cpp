// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/doctor.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/sheet.h"
#include "io/mesh/weld.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/fit.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

io::MeshFile file_of(geometry::Mesh mesh) {
  io::MeshFile file;
  file.mesh = std::move(mesh);
  return file;
}

/// Every triangle with vertices of its own.
geometry::Mesh loose(const geometry::Mesh& mesh) {
  geometry::Mesh soup;
  for (geometry::Face f : mesh.faces()) {
    std::vector<geometry::Vertex> v;
    for (geometry::Vertex corner : mesh.vertices_around_face(mesh.halfedge(f)))
      v.push_back(soup.add_vertex(mesh.point(corner)));
    soup.add_face(v[0], v[1], v[2]);
  }
  return soup;
}

geometry::Mesh scaled(geometry::Mesh mesh, double by) {
  for (auto v : mesh.vertices()) {
    const auto p = mesh.point(v);
    mesh.point(v) = {by * p.x(), by * p.y(), by * p.z()};
  }
  return mesh;
}

/// What stands along y lies along z.
geometry::Mesh lying(geometry::Mesh mesh) {
  for (auto v : mesh.vertices()) {
    const auto p = mesh.point(v);
    mesh.point(v) = {p.x(), -p.z(), p.y()};
  }
  return mesh;
}

geometry::Mesh mannequin() { return tests::read_plain_obj(tests::source_dir() / "meshes/mannequin.obj"); }
geometry::Mesh shirt() { return tests::read_plain_obj(tests::source_dir() / "meshes/shirt.obj"); }

const jobs::Ailment* find(const std::vector<jobs::Ailment>& found, const std::string& code) {
  for (const jobs::Ailment& a : found)
    if (a.code == code) return &a;
  return nullptr;
}

jobs::DoctorReport examine(geometry::Mesh mesh, std::optional<geometry::Mesh> body = {}) {
  tests::Recorder recorder;
  jobs::DoctorJob job;
  job.mesh = file_of(std::move(mesh));
  if (body) job.body = file_of(std::move(*body));
  return jobs::doctor(job, recorder);
}

/// The message with which a drape of files in memory is refused.
std::string drape_refused(geometry::Mesh garment, geometry::Mesh body, const std::string& body_unit = "") {
  jobs::DrapeJob job;
  job.scene.memory.meshes["garment"] = file_of(std::move(garment));
  job.scene.memory.meshes["body"] = file_of(std::move(body));
  job.scene.settings =
      io::parse_toml("[garment]\nmesh = \"garment\"\n[body]\nmesh = \"body\"\ntolerance = 0.01\n", "test");
  if (!body_unit.empty()) io::set_value(job.scene.settings, "body.unit", body_unit, "test");
  tests::Recorder recorder(1000000);
  try {
    jobs::drape(job, recorder);
  } catch (const geometry::ContentError& e) {
    return e.what();
  } catch (const std::exception&) {
  }
  return "";
}

}  // namespace

TEST_CASE("doctor: a sound garment on its body is well, and so is the body") {
  const jobs::DoctorReport report = examine(shirt(), mannequin());
  for (const jobs::Ailment& a : report.found) CHECK(a.code + ": " + a.text == "");
  CHECK(report.well());
  tests::Recorder recorder;
  jobs::DoctorJob job;
  job.mesh = file_of(mannequin());
  job.is_body = true;
  CHECK(jobs::doctor(job, recorder).well());
}

TEST_CASE("doctor: a soup of loose triangles is told and joined, and other jobs take it as one") {
  const geometry::Mesh sheet = geometry::equilateral_sheet(0.4, 0.4, 0.05), soup = loose(sheet);
  tests::Recorder recorder;
  jobs::DoctorJob job;
  job.mesh = file_of(soup);
  job.repair = true;
  const fs::path folder = tests::empty_folder("doctor_soup");
  job.output = folder / "mended.obj";
  const jobs::DoctorReport report = jobs::doctor(job, recorder);
  const jobs::Ailment* found = find(report.found, "soup");
  REQUIRE(found);
  CHECK(found->count == soup.number_of_vertices() - sheet.number_of_vertices());
  CHECK((found->fatal && found->mendable && !found->places.empty()));
  CHECK(report.left.empty());
  CHECK(report.well());
  CHECK(report.mesh.mesh->number_of_vertices() == sheet.number_of_vertices());
  CHECK(report.mesh.mesh->number_of_faces() == sheet.number_of_faces());
  CHECK(geometry::measure(report.mesh.mesh).boundary_loops == 1);
  CHECK(io::read_mesh(folder / "mended.obj").mesh->number_of_vertices() == sheet.number_of_vertices());
  const geometry::Mesh as_one = io::with_seams_as_one(file_of(soup), "soup").mesh;  // what other jobs take
  CHECK(geometry::measure(as_one).boundary_loops == 1);
  CHECK(as_one.number_of_vertices() == soup.number_of_vertices());
}

TEST_CASE(
    "doctor: seams that are not joined, small holes and a second side are found where they are and mended") {
  geometry::Mesh sheet = geometry::equilateral_sheet(0.4, 0.4, 0.05);
  geometry::Mesh holed = sheet;
  for (geometry::Face f : sheet.faces()) {
    bool inner = true;
    for (geometry::Vertex v : sheet.vertices_around_face(sheet.halfedge(f)))
      inner = inner && !sheet.is_border(v);
    if (!inner) continue;
    CGAL::Euler::remove_face(holed.halfedge(f), holed);
    break;
  }
  holed.collect_garbage();
  geometry::Mesh apart = holed, other = holed;
  for (auto v : other.vertices()) {
    const auto p = other.point(v);
    other.point(v) = {p.x(), -p.y(), p.z()};  // its mirror image, joined along y = 0 but for the vertices
  }
  tests::append(apart, other);
  const jobs::DoctorReport report = examine(apart);
  REQUIRE(find(report.found, "holes"));
  CHECK(find(report.found, "holes")->count == 2);
  REQUIRE(find(report.found, "unjoined"));
  CHECK_FALSE(find(report.found, "unjoined")->fatal);
  for (const geometry::Point& p : find(report.found, "unjoined")->places) CHECK(std::abs(p.y()) < 1e-9);

  geometry::Mesh two = sheet, back;
  for (auto v : sheet.vertices()) back.add_vertex(sheet.point(v));
  for (auto f : sheet.faces()) {
    const auto h = sheet.halfedge(f);
    back.add_face(sheet.target(h), sheet.source(h), sheet.target(sheet.next(h)));
  }
  tests::append(two, back);
  tests::Recorder recorder;
  jobs::DoctorJob job;
  job.mesh = file_of(two);
  job.repair = true;
  const jobs::DoctorReport mended = jobs::doctor(job, recorder);
  REQUIRE(find(mended.found, "two_sided"));
  CHECK(find(mended.found, "two_sided")->count == sheet.number_of_faces());
  CHECK(mended.mesh.mesh->number_of_faces() == sheet.number_of_faces());
  CHECK(mended.left.empty());
}

TEST_CASE("doctor: seams that lie open by a rounding are told with their places, and joined, bodies' too") {
  geometry::Mesh panels = tests::grid(6, 6, 0.6, 0.6), right = panels;
  for (auto v : right.vertices()) right.point(v) = right.point(v) + geometry::Vector(0.60001, 0, 0);
  tests::append(panels, right);
  const jobs::DoctorReport report = examine(panels);
  REQUIRE(find(report.found, "seams_apart"));
  const jobs::Ailment& apart = *find(report.found, "seams_apart");
  CHECK(apart.count == 7);
  CHECK_FALSE(apart.fatal);
  CHECK(apart.text.find("up to 0.01 mm from the other side") != apart.text.npos);
  CHECK(apart.text.find("here 1 mm") != apart.text.npos);
  CHECK(apart.text.find("the first at (0.600, 0.000, 0.000) m") != apart.text.npos);
  for (const geometry::Point& p : apart.places) CHECK(p.x() == Approx(0.60001));
  CHECK_FALSE(find(report.found, "t_junctions"));
  for (const bool is_body : {false, true}) {
    tests::Recorder recorder;
    jobs::DoctorJob job;
    job.mesh = file_of(panels);
    job.is_body = is_body, job.repair = true;
    const jobs::DoctorReport mended = jobs::doctor(job, recorder);
    CHECK(find(mended.found, "seams_apart"));
    CHECK_FALSE(find(mended.left, "seams_apart"));
    CHECK(geometry::measure(mended.mesh.mesh).components == 1);
  }
}

TEST_CASE("doctor: vertices amid the edges of a seam are told, and the faces there split") {
  geometry::Mesh yoke = tests::grid(6, 5, 0.6, 0.5), skirt = tests::grid(6, 10, 0.6, 0.5);
  for (auto v : skirt.vertices()) skirt.point(v) = skirt.point(v) + geometry::Vector(0.6, 0, 0);
  tests::append(yoke, skirt);
  tests::Recorder recorder;
  jobs::DoctorJob job;
  job.mesh = file_of(yoke);
  job.repair = true;
  const jobs::DoctorReport mended = jobs::doctor(job, recorder);
  REQUIRE(find(mended.found, "t_junctions"));
  CHECK(find(mended.found, "t_junctions")->count == 5);
  CHECK(find(mended.found, "unjoined"));
  CHECK(mended.left.empty());
  CHECK(mended.mesh.mesh->number_of_faces() == yoke.number_of_faces() + 5);
  CHECK(geometry::measure(mended.mesh.mesh).boundary_loops == 1);
}

TEST_CASE("doctor: corners of a soup that differ by the rounding of single precision are joined") {
  const geometry::Mesh sheet = geometry::equilateral_sheet(0.4, 0.4, 0.05);
  geometry::Mesh soup = loose(sheet);
  for (auto v : soup.vertices())
    if (v.idx() % 7 == 0) soup.point(v) = soup.point(v) + geometry::Vector(3e-8, -3e-8, 0);
  tests::Recorder recorder;
  jobs::DoctorJob job;
  job.mesh = file_of(soup);
  job.repair = true;
  const jobs::DoctorReport mended = jobs::doctor(job, recorder);
  CHECK(find(mended.found, "soup"));
  CHECK(mended.left.empty());
  CHECK(mended.mesh.mesh->number_of_vertices() == sheet.number_of_vertices());
  CHECK(mended.mesh.mesh->number_of_edges() == sheet.number_of_edges());
}

TEST_CASE("doctor: garments that fell apart at their seams elsewhere are whole after repair", "[release]") {
  const fs::path wild = tests::shared_dir() / "wild";
  if (!fs::exists(wild / "tjunction.obj")) {
    WARN("skipped: no shared data");
    return;
  }
  const auto mended = [&](const char* name) {
    tests::Recorder recorder;
    jobs::DoctorJob job;
    job.mesh = wild / name;
    job.repair = true;
    return jobs::doctor(job, recorder);
  };
  const jobs::DoctorReport seam = mended("seam_1e-5.obj"), yoke = mended("tjunction.obj");
  REQUIRE(find(seam.found, "seams_apart"));
  CHECK(find(seam.found, "seams_apart")->count == 52);
  REQUIRE(find(yoke.found, "t_junctions"));
  CHECK(find(yoke.found, "t_junctions")->count == 18);
  for (const jobs::DoctorReport* report : {&seam, &yoke}) {
    CHECK(report->left.empty());
    CHECK(geometry::measure(report->mesh.mesh).components == 1);
    CHECK(geometry::measure(report->mesh.mesh).boundary_loops == 2);
  }
}

TEST_CASE("doctor: a body that lies along z is asked about, unless somebody says what is up") {
  tests::Recorder recorder;
  const jobs::DoctorReport report = examine(shirt(), lying(mannequin()));
  REQUIRE(find(report.found, "z_up"));
  CHECK(find(report.found, "z_up")->help == "`up=z`");
  CHECK(drape_refused(shirt(), lying(mannequin())).find("`up=z`") != std::string::npos);
  jobs::FitJob fit;
  fit.worn = {file_of(shirt())};
  fit.bodies = {file_of(lying(mannequin()))};
  CHECK_THROWS_AS(jobs::fit(fit, recorder), geometry::ContentError);
  fit.frame.up = "y";
  CHECK_NOTHROW(jobs::fit(fit, recorder));
}

TEST_CASE("doctor: a garment whose file has another axis up than its body's is told by the axis, and refused",
          "[long]") {
  const auto moved = [](geometry::Mesh mesh, double down) {
    for (auto v : mesh.vertices()) mesh.point(v) = mesh.point(v) - geometry::Vector(0, down, 0);
    return mesh;
  };
  for (const char* name : {"shirt.obj", "skirt.obj"})
    for (const double down : {0.0, 0.875}) {  // feet at 0, or the middle
      INFO(name << " " << down);
      const io::MeshFile upright =
          file_of(moved(tests::read_plain_obj(tests::source_dir() / "meshes" / name), down));
      const io::MeshFile body = file_of(moved(mannequin(), down));
      jobs::DoctorJob job;
      job.mesh = upright;
      job.body = body;
      tests::Recorder recorder;
      CHECK(jobs::doctor(job, recorder).well());
      job.mesh = file_of(lying(upright.mesh));
      const jobs::DoctorReport report = jobs::doctor(job, recorder);
      REQUIRE(report.found.size() == 1);
      CHECK(report.found[0].code == "axes_differ");
      CHECK(report.found[0].text.find("its file has z up, the body's has y up") != std::string::npos);
    }
  const std::string refused =
      drape_refused(lying(tests::read_plain_obj(tests::source_dir() / "meshes/shirt.obj")), mannequin());
  CHECK(refused.find("garment: the garment lies along z") != std::string::npos);
}

TEST_CASE("doctor: garment and body in two units, or exchanged, are asked about by the option that mends it",
          "[long]") {
  const std::string small = drape_refused(scaled(shirt(), 0.01), mannequin());
  CHECK(small.find("`body_unit=") != std::string::npos);
  const jobs::DoctorReport larger = examine(scaled(shirt(), 10), scaled(mannequin(), 0.06));
  REQUIRE(find(larger.found, "two_units"));
  CHECK(find(larger.found, "two_units")->help == "`unit=cm` `body_unit=m`");
  const std::string turned = drape_refused(mannequin(), shirt());
  CHECK(turned.find("exchanged") != std::string::npos);
  CHECK(examine(shirt(), mannequin()).well());
}

TEST_CASE("doctor: a slab, a floor and a ball are no figures that lie") {
  geometry::Mesh slab = tests::cube(), bowl = tests::grid(20, 20);
  for (auto v : slab.vertices()) {
    const auto p = slab.point(v);
    slab.point(v) = {0.9 * p.x(), 0.1 * p.y(), 1.2 * p.z()};
  }
  tests::lift(bowl, [](double x, double y) { return 0.3 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)); });
  for (const geometry::Mesh& body : {slab, lying(bowl), tests::icosphere(2, 0.6)}) {
    const jobs::DoctorReport report = examine(shirt(), body);
    CHECK_FALSE(find(report.found, "z_up"));
  }
}

TEST_CASE("doctor: --body-unit brings a body in centimetres to a garment in metres") {
  const fs::path folder = tests::empty_folder("doctor_units");
  io::write_mesh(folder / "body.obj", file_of(scaled(mannequin(), 100)));
  jobs::FitJob job;
  job.worn = {file_of(shirt())};
  job.bodies = {folder / "body.obj"};
  job.body_unit = "cm";
  tests::Recorder recorder;
  const jobs::FitJobReport report = jobs::fit(job, recorder);
  CHECK(report.garments[0].report.body_high - report.garments[0].report.body_low ==
        Approx(1.7).epsilon(0.01));
  job.body_unit = "ell";
  CHECK_THROWS_AS(jobs::fit(job, recorder), std::invalid_argument);
}

TEST_CASE("doctor: a height in millimetres is asked about before a fold of ten metres is drawn") {
  jobs::SimulateJob job;
  job.scene.memory.meshes["sheet"] = file_of(geometry::equilateral_sheet(0.4, 0.4, 0.05));
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = 10;
  ridge.stroke.points = {{-0.1, 0.2, 0}, {0.1, 0.2, 0}};
  job.scene.memory.strokes["ridge"] = {ridge};
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sheet\"\n[[lines]]\nstrokes = \"ridge\"\n[simulation]\nseconds = 0.001\n", "test");
  tests::Recorder recorder;
  std::string message;
  try {
    jobs::simulate(job, recorder);
  } catch (const geometry::ContentError& e) {
    message = e.what();
  }
  CHECK(message.find("stroke 'ridge': its height is 10") != std::string::npos);
  CHECK(message.find("write 0.01 for") != std::string::npos);
}

TEST_CASE("doctor: an open body is closed, and a wrong call refused") {
  geometry::Mesh open = tests::cylinder(0.2, 1.0, 24, 10);
  tests::Recorder recorder;
  jobs::DoctorJob job;
  job.mesh = file_of(open);
  job.is_body = job.repair = true;
  const jobs::DoctorReport report = jobs::doctor(job, recorder);
  REQUIRE(find(report.found, "open"));
  CHECK(report.well());
  CHECK(geometry::measure(report.mesh.mesh).closed);
  CHECK(*geometry::measure(report.mesh.mesh).volume > 0);
  job.repair = false;
  job.output = "never.obj";
  CHECK_THROWS_AS(jobs::doctor(job, recorder), std::invalid_argument);
}
