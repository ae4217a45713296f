// SPDX-License-Identifier: GPL-3.0-or-later
// Every public function that takes a mesh, each with every way in which a mesh can be broken.
#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>

#include "bridge/draping/drape.h"
#include "bridge/draping/fit_report.h"
#include "bridge/keeping/draw_more.h"
#include "bridge/keeping/keep.h"
#include "geometry/figure/repair_body.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/bake_maps.h"
#include "geometry/refine/subdivide.h"
#include "geometry/refine/transfer_shape.h"
#include "geometry/rest/rest_state.h"
#include "io/animation/animation_file.h"
#include "io/scene/state_file.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/mesh/bake.h"
#include "jobs/mesh/transfer.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/fit.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/public_functions.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<Stroke> ridge() {
  Stroke stroke;
  stroke.name = "ridge";
  stroke.points = {{0.05, 0.14, 0}, {0.25, 0.16, 0}};
  return {stroke};
}

WrinkleOptions with_rule(InsertionRule rule, int first_line) {
  WrinkleOptions options;
  options.insertion.rule = rule;
  options.first_line = first_line;
  return options;
}

/// A sheet with a line, with texture coordinates and all maps that gathering needs.
Mesh whole_mesh() {
  Mesh mesh = tests::grid(6, 6, 0.3, 0.3);
  auto texture = ensure_map(mesh, attribute::texture);
  for (const Halfedge h : mesh.halfedges()) {
    const Point& p = mesh.point(mesh.target(h));
    texture[h] = {p.x() / 0.3, p.y() / 0.3};
  }
  wrinkle(mesh, ridge(), with_rule(InsertionRule::safe, 0));
  auto group = ensure_map(mesh, attribute::group), material = ensure_map(mesh, attribute::material);
  for (const Face f : mesh.faces()) group[f] = material[f] = 0;
  return mesh;
}

/// What an operation may do with a mesh: a kind that it does not take, it must refuse.
enum Kind : unsigned {
  sound = 0,
  removed = 1,   ///< some elements are removed, and still there
  polygon = 2,   ///< a face with four corners
  no_place = 4,  ///< a position that is not finite
  odd = 8,       ///< what some operations have no use for: nothing may happen but a refusal or a sound end
  broken = 16    ///< its half-edges do not fit together
};

constexpr Kind gone_in_name = Kind(broken | removed);

struct Damage {
  const char* name;
  Kind kind;
  std::function<void(Mesh&)> make;
};

void put_position(Mesh& mesh, double x) { mesh.point(Vertex(7)) = Point(x, 0, 0); }
Halfedge inner(const Mesh& mesh) {
  for (const Halfedge h : mesh.halfedges())
    if (!mesh.is_border(h) && !mesh.is_border(mesh.opposite(h))) return h;
  return {};
}
/// Two triangles become a face of four corners.
void join_faces(Mesh& mesh) { CGAL::Euler::join_face(inner(mesh), mesh), mesh.collect_garbage(); }

template <class Name>
void put_first(Mesh& mesh, const Name& name, typename Name::Value value) {
  ensure_map(mesh, name)[typename Name::Key(0)] = value;
}

std::vector<Damage> damages() {
  using M = Mesh&;
  return {
      {"empty", odd, [](M m) { m.clear(); }},
      {"no faces", odd,
       [](M m) {
         m = Mesh(), m.add_vertex({0, 0, 0}), m.add_vertex({0.1, 0, 0});
       }},
      {"a vertex alone", odd,
       [](M m) {
         m.add_vertex({9, 9, 9});
       }},
      {"all at one place", odd,
       [](M m) {
         for (const Vertex v : m.vertices()) m.point(v) = {0, 0, 0};
       }},
      {"face without area", odd, [](M m) { m.point(m.target(inner(m))) = m.point(m.source(inner(m))); }},
      {"not a number", no_place, [](M m) { put_position(m, not_a_number); }},
      {"infinite", no_place, [](M m) { put_position(m, HUGE_VAL); }},
      {"1e300", odd, [](M m) { put_position(m, 1e300); }},
      {"face removed", removed, [](M m) { CGAL::Euler::remove_face(inner(m), m); }},
      {"edge removed", polygon, [](M m) { join_faces(m); }},
      {"edge removed, garbage", Kind(polygon | removed), [](M m) { CGAL::Euler::join_face(inner(m), m); }},
      {"vertex called removed", gone_in_name, [](M m) { m.remove_vertex(Vertex(7)); }},
      {"face called removed", gone_in_name, [](M m) { m.remove_face(Face(7)); }},
      {"edge called removed", gone_in_name, [](M m) { m.remove_edge(Edge(7)); }},
      {"next beyond", broken, [](M m) { m.set_next_only(inner(m), Halfedge(1 << 28)); }},
      {"next null", broken, [](M m) { m.set_next_only(inner(m), Mesh::null_halfedge()); }},
      {"next itself", broken, [](M m) { m.set_next(inner(m), inner(m)); }},
      {"next never returns", broken, [](M m) { m.set_next_only(inner(m), Halfedge(0)); }},
      {"previous beyond", broken, [](M m) { m.set_prev_only(inner(m), Halfedge(1 << 28)); }},
      {"target beyond", broken, [](M m) { m.set_target(inner(m), Vertex(1 << 28)); }},
      {"target another", broken, [](M m) { m.set_target(inner(m), Vertex(0)); }},
      {"face beyond", broken, [](M m) { m.set_face(inner(m), Face(1 << 28)); }},
      {"face of a half-edge gone", broken, [](M m) { m.set_face(inner(m), Mesh::null_face()); }},
      {"half-edge of a vertex beyond", broken, [](M m) { m.set_halfedge(Vertex(7), Halfedge(1 << 28)); }},
      {"half-edge of a vertex gone", broken, [](M m) { m.set_halfedge(Vertex(7), Mesh::null_halfedge()); }},
      {"half-edge of a face beyond", broken, [](M m) { m.set_halfedge(Face(7), Halfedge(1 << 28)); }},
      {"half-edge of another face", broken, [](M m) { m.set_halfedge(Face(7), m.halfedge(Face(8))); }},
      {"line beyond", odd, [](M m) { put_first(m, attribute::line, 1 << 30); }},
      {"line before", odd, [](M m) { put_first(m, attribute::line, -7); }},
      {"group beyond", odd, [](M m) { put_first(m, attribute::group, 1 << 30); }},
      {"material beyond", odd, [](M m) { put_first(m, attribute::material, 1 << 30); }},
      {"material before", odd, [](M m) { put_first(m, attribute::material, -7); }},
      {"rest length 0", odd, [](M m) { put_first(m, attribute::rest_length, 0); }},
      {"rest length < 0", odd, [](M m) { put_first(m, attribute::rest_length, -1); }},
      {"rest length infinite", odd, [](M m) { put_first(m, attribute::rest_length, HUGE_VAL); }},
      {"mass none", odd, [](M m) { put_first(m, attribute::mass, not_a_number); }},
      {"mass < 0", odd, [](M m) { put_first(m, attribute::mass, -1); }},
      {"texture none", odd,
       [](M m) {
         put_first(m, attribute::texture, {not_a_number, not_a_number});
       }},
      {"generation", odd, [](M m) { put_first(m, attribute::generation, 1 << 30); }}};
}

struct Door {
  const char* name;
  std::function<void(Mesh&)> enter;
  unsigned takes = sound;
};

bridge::GatherOptions springs() {
  bridge::GatherOptions options;
  options.mean_structural_length = 0.05;
  options.mean_bending_length = 0.08;
  return options;
}

void add_geometry(std::vector<Door>& all) {
  using M = Mesh&;
  all.push_back({"repair_body", [](M m) { repair_body(m); }});
  all.push_back({"taubin_smooth", [](M m) { taubin_smooth(m, {}); }, removed | polygon});
  all.push_back({"taubin_smooth",
                 [](M m) {
                   TaubinOptions o;
                   o.weights = SmoothingWeights::cotangent;
                   o.lines = LineRule::keep;
                   taubin_smooth(m, {}, o);
                 },
                 removed});
  const Touch ironing{TouchKind::iron, Point(0.15, 0.15, 0), 0.1, 1, {}};
  all.push_back({"touch_weights", [ironing](M m) { touch_weights(m, ironing); }});
  all.push_back({"apply_touch", [ironing](M m) { apply_touch(m, ironing, touch_weights(m, ironing)); }});
  for (const auto rule : {InsertionRule::safe, InsertionRule::paper, InsertionRule::fold})
    all.push_back({"wrinkle", [rule](M m) { wrinkle(m, ridge(), with_rule(rule, 1)); }});
  all.push_back({"loop_subdivide", [](M m) { loop_subdivide(m, 1); }, removed});
  all.push_back({"midpoint_subdivide", [](M m) { midpoint_subdivide(m, 1); }, removed});
  all.push_back({"sqrt3_subdivide", [](M m) { sqrt3_subdivide(m, 2); }, removed});
  all.push_back({"take_rest_snapshot", [](M m) { take_rest_snapshot(m); }});
  all.push_back({"apply_rest_rule", [](M m) {
                   RestSnapshot before;
                   before.positions.assign(m.num_vertices(), Point(0, 0, 0));
                   before.angles.assign(m.num_edges(), 0);
                   before.edges = m.num_edges();
                   apply_rest_rule(m, before, RestRule::copied);
                 }});
  all.push_back({"rest_area", [](M m) {
                   const double area = rest_area(m);
                   CHECK_FALSE(std::isnan(area));
                 }});
  all.push_back({"audit_rest_metric", [](M m) {
                   const double area = audit_rest_metric(m).area;
                   CHECK_FALSE(std::isnan(area));
                 }});
  const BakeOptions small{16, 1};
  all.push_back({"bake_maps", [=](M m) { bake_maps(m, whole_mesh(), small); }});
  all.push_back({"bake_maps", [=](M m) { bake_maps(whole_mesh(), m, small); }});
  all.push_back({"transfer_shape", [](M m) { transfer_shape(m, whole_mesh()); }, removed | polygon});
  all.push_back({"transfer_shape",
                 [](M m) {
                   Mesh original = tests::grid(6, 6, 0.3, 0.3);
                   transfer_shape(original, m);
                 },
                 removed});
}

void add_bridge(std::vector<Door>& all) {
  using M = Mesh&;
  static const physics::TriangleMesh ball = bridge::to_triangle_mesh(repair_body(tests::icosphere(1, 0.1)));
  static const physics::ExactDistance distance(ball);
  all.push_back({"drape", [](M m) {
                   physics::Cloth cloth;
                   bridge::DrapeOptions o;
                   o.settle.max_iterations = 2;
                   bridge::drape(m, cloth, nullptr, o, [](Mesh& made) {
                     physics::Cloth c = bridge::gather(made, springs());
                     if (c.particles.size()) c.particles.inv_mass[0] = 0;
                     return c;
                   });
                 }});
  all.push_back({"fit_report", [](M m) { bridge::fit_report(m, ball, distance); }});
  all.push_back({"strain_report", [](M m) { bridge::strain_report(m); }});
  for (const auto membrane : {bridge::Membrane::paper, bridge::Membrane::triangles, bridge::Membrane::tension,
                              bridge::Membrane::patches}) {
    bridge::GatherOptions o = springs();
    o.membrane = membrane;
    o.bending = membrane == bridge::Membrane::paper ? bridge::Bending::cross : bridge::Bending::plate;
    all.push_back({"gather", [o](M m) { bridge::gather(m, o); }});
    all.push_back({"gather_with_origin", [o](M m) { bridge::gather_with_origin(m, o); }});
  }
  const auto particles = [](const Mesh& m) {
    physics::Particles p;
    p.x.assign(m.number_of_vertices(), {0, 0, 0});
    p.v = p.x;
    return p;
  };
  // These two write to vertices alone, whatever half-edges say.
  all.push_back({"scatter", [=](M m) { bridge::scatter(particles(m), m); }, polygon | no_place | broken});
  all.push_back({"scatter_velocities", [=](M m) { bridge::scatter_velocities(particles(m), m); },
                 polygon | no_place | broken});
  all.push_back({"keep_lines", [](M m) {
                   static const physics::Cloth whole = bridge::gather(whole_mesh(), springs());
                   physics::Cloth cloth = whole;
                   cloth.particles.inv_mass[0] = 0;
                   bridge::KeepOptions o;
                   o.seconds = o.gust_seconds = o.calm_seconds = 0.01;
                   o.presses.clear(), o.struts.clear();
                   o.height_trials = 0;
                   bridge::keep_lines(m, cloth, {}, {}, o);
                 }});
  all.push_back({"draw_more", [](M m) {
                   physics::SimulateState state;
                   bridge::DrawMoreOptions o;
                   o.springs = springs();
                   o.wrinkle = with_rule(InsertionRule::safe, 1);
                   bridge::draw_more(m, state, ridge(), o);
                 }});
}

io::MeshFile as_file(const Mesh& mesh) {
  io::MeshFile file;
  file.mesh = mesh;
  file.group_names = file.material_names = {"front"};
  return file;
}

io::SavedState state_of(const Mesh& mesh) {
  io::SavedState state;
  state.file = as_file(mesh);
  return state;
}

void add_io(std::vector<Door>& all) {
  using M = Mesh&;
  static const std::filesystem::path folder = tests::empty_folder("mesh_doors");
  for (const char* name : {"a.pc2", "a.mdd", "a.glb"})
    all.push_back({"AnimationWriter",
                   [name](M m) {
                     io::AnimationWriter writer(folder / name, m);
                     writer.add(std::vector<physics::Vec3>(m.number_of_vertices(), {0, 0, 0}));
                   },
                   no_place});
  for (const auto format : {io::MeshFormat::obj, io::MeshFormat::ply, io::MeshFormat::off,
                            io::MeshFormat::stl, io::MeshFormat::gltf})
    all.push_back({"write_mesh",
                   [format](M m) {
                     std::ostringstream out;
                     io::write_mesh(out, format, as_file(m));
                   },
                   removed});
  for (const char* name : {"a.obj", "a.ply"})
    all.push_back({"write_mesh", [name](M m) { io::write_mesh(folder / name, as_file(m)); }, removed});
  all.push_back({"state_bytes", [](M m) { io::state_bytes(state_of(m)); }});
  all.push_back({"write_state", [](M m) { io::write_state(folder / "s.ply", state_of(m)); }});
}

jobs::SceneInput scene_of(const Mesh& mesh) {
  jobs::SceneInput scene;
  scene.memory.meshes["sheet"] = as_file(mesh);
  scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sheet\"\n[material]\nmembrane = \"paper\"\n[simulation]\nseconds = 0.01\n"
      "[[pins]]\nbox = [-1, 0.29, -1, 1, 1, 1]\n",
      "test");
  return scene;
}

void add_jobs(std::vector<Door>& all) {
  static tests::Recorder nobody;
  using M = Mesh&;
  all.push_back({"jobs::bake", [](M m) {
                   jobs::BakeJob job;
                   job.low = as_file(m);
                   job.high = as_file(whole_mesh());
                   job.options = {16, 1};
                   jobs::bake(job, nobody);
                 }});
  all.push_back({"jobs::fit", [](M m) {
                   jobs::FitJob job;
                   job.worn = {as_file(m)};
                   job.bodies = {as_file(tests::icosphere(1, 0.1))};
                   jobs::fit(job, nobody);
                 }});
  all.push_back({"jobs::fit body", [](M m) {
                   jobs::FitJob job;
                   Mesh garment = tests::grid(3, 3, 0.2, 0.2);
                   tests::lift(garment, [](double, double) { return 0.05; });
                   job.worn = {as_file(garment)};
                   job.bodies = {as_file(m)};
                   jobs::fit(job, nobody);
                 }});
  all.push_back({"jobs::transfer", [](M m) {
                   jobs::TransferJob job;
                   job.original = as_file(tests::grid(6, 6, 0.3, 0.3));
                   job.wrinkled = as_file(m);
                   jobs::transfer(job, nobody);
                 }});
  all.push_back({"jobs::wrinkle", [](M m) {
                   jobs::WrinkleJob job;
                   job.garment = as_file(m);
                   io::DrawnStroke stroke;
                   stroke.stroke = ridge()[0];
                   job.strokes = std::vector<io::DrawnStroke>{stroke};
                   jobs::wrinkle(job, nobody);
                 }});
  all.push_back({"jobs::simulate", [](M m) {
                   jobs::SimulateJob job;
                   job.scene = scene_of(m);
                   jobs::simulate(job, nobody);
                 }});
  all.push_back({"jobs::drape", [](M m) {
                   jobs::DrapeJob job;
                   job.scene = scene_of(m);
                   job.subdivide = 0;
                   jobs::drape(job, nobody);
                 }});
}

std::vector<Door> doors() {
  std::vector<Door> all;
  add_geometry(all);
  add_bridge(all);
  add_io(all);
  add_jobs(all);
  return all;
}

bool is_same(const Mesh& a, const Mesh& b) {
  return a.num_vertices() == b.num_vertices() && a.num_edges() == b.num_edges() &&
         a.num_faces() == b.num_faces() &&
         std::equal(a.points().begin(), a.points().end(), b.points().begin(), b.points().end(),
                    [](const Point& p, const Point& q) { return std::memcmp(&p, &q, sizeof p) == 0; });
}

/// "" if it went well; what was thrown, if that is a refusal.
std::string words_of(const Door& door, Mesh& mesh) {
  try {
    door.enter(mesh);
    return "";
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  } catch (const ContentError& refused) {
    return refused.what();
  }
}

}  // namespace

TEST_CASE("mesh doors: every public function refuses every broken mesh, and leaves it as it was") {
  const Mesh whole = whole_mesh();
  for (const Door& door : doors()) {
    DYNAMIC_SECTION(door.name) {
      Mesh mesh = whole;
      CHECK(words_of(door, mesh) == "");
      for (const Damage& damage : damages()) {
        CAPTURE(door.name, damage.name);
        mesh = whole;
        damage.make(mesh);
        const Mesh before = mesh;
        const std::string words = words_of(door, mesh);
        if (damage.kind != odd && (damage.kind & ~door.takes)) CHECK(words != "");
        if (damage.kind != odd && !(damage.kind & ~door.takes)) CHECK(words == "");
        if (words != "") CHECK(is_same(mesh, before));
      }
    }
  }
}

namespace {

/// Enters with each of the values in each of the numbers: none may be taken.
template <class Options, class Enter>
void refuses(const char* door, const std::vector<double Options::*>& numbers,
             const std::vector<double>& values, const Enter& enter, const Options& right = {}) {
  const Mesh whole = whole_mesh();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (const double value : values) {
      Options options = right;
      options.*numbers[i] = value;
      Mesh mesh = whole;
      CAPTURE(door, i, value);
      CHECK(words_of({door, [&](Mesh& m) { enter(m, options); }}, mesh) != "");
      CHECK(is_same(mesh, whole));
    }
}

void smooth_often(Mesh& mesh, int iterations) {
  TaubinOptions options;
  options.iterations = iterations;
  taubin_smooth(mesh, {}, options);
}

const std::vector<double> none_of_any{not_a_number, HUGE_VAL, -HUGE_VAL};

}  // namespace

TEST_CASE("mesh doors: no number out of its range is taken, and the mesh stays as it was") {
  const auto smooth = [](Mesh& m, const TaubinOptions& o) { taubin_smooth(m, {}, o); };
  refuses<TaubinOptions>("taubin_smooth", {&TaubinOptions::lambda, &TaubinOptions::mu}, none_of_any, smooth);
  const auto draw = [](Mesh& m, const WrinkleOptions& o) { wrinkle(m, ridge(), o); };
  refuses<WrinkleOptions>("wrinkle", {&WrinkleOptions::density}, {not_a_number, HUGE_VAL, 0, -1}, draw);
  const auto insert = [](Mesh& m, const InsertionOptions& o) {
    WrinkleOptions options;
    options.insertion = o;
    wrinkle(m, ridge(), options);
  };
  using I = InsertionOptions;
  refuses<I>("wrinkle", {&I::max_distance, &I::min_barycentric, &I::min_angle_deg}, {not_a_number, -1},
             insert);
  const auto line = [](Mesh& m, const Stroke& s) {
    Stroke stroke = s;
    stroke.points = ridge()[0].points;
    wrinkle(m, std::vector{stroke});
  };
  refuses<Stroke>("wrinkle", {&Stroke::height, &Stroke::press, &Stroke::smooth, &Stroke::set}, none_of_any,
                  line);
  const auto shape = [](Mesh& m, const TransferOptions& o) { transfer_shape(m, whole_mesh(), o); };
  refuses<TransferOptions>("transfer_shape", {&TransferOptions::max_distance}, {not_a_number, 0, -1}, shape);
  using F = bridge::FitOptions;
  const auto measure = [](Mesh& m, const F& o) { bridge::strain_report(m, o); };
  refuses<F>("strain_report", {&F::tight_strain, &F::loose_distance, &F::contact_distance, &F::smallest_zone},
             {not_a_number, HUGE_VAL, -1}, measure);
  using G = bridge::GatherOptions;
  const auto gather = [](Mesh& m, const G& o) { bridge::gather(m, o); };
  refuses<G>(
      "gather",
      {&G::structural_stiffness, &G::bending_stiffness, &G::mean_structural_length, &G::mean_bending_length,
       &G::stretch, &G::poisson, &G::rigidity, &G::tension, &G::compression, &G::shear},
      {not_a_number, HUGE_VAL, -1.5}, gather, springs());
  using D = bridge::DrapeOptions;
  const auto put_on = [](Mesh& m, const D& o) {
    physics::Cloth cloth;
    bridge::drape(m, cloth, nullptr, o, [](Mesh& made) { return bridge::gather(made, springs()); });
  };
  refuses<D>("drape", {&D::coarse_tolerance, &D::disturbance, &D::soft_start, &D::bending_friction},
             {not_a_number, HUGE_VAL, -1}, put_on);
  using K = bridge::KeepOptions;
  const auto keep = [](Mesh& m, const K& o) {
    physics::Cloth cloth = bridge::gather(m, springs());
    bridge::keep_lines(m, cloth, {}, {}, o);
  };
  refuses<K>("keep_lines",
             {&K::seconds, &K::gust, &K::gust_seconds, &K::calm_seconds, &K::push, &K::kept, &K::least_height,
              &K::largest_turn},
             {not_a_number, HUGE_VAL, -1}, keep);
  using M = bridge::DrawMoreOptions;
  const auto more = [](Mesh& m, const M& o) {
    physics::SimulateState state;
    bridge::draw_more(m, state, ridge(), o);
  };
  M right;
  right.springs = springs();
  refuses<M>("draw_more", {&M::fade}, {not_a_number, 0, -1}, more, right);
  const auto move = [](Mesh& m, const io::AnimationOptions& o) {
    io::AnimationWriter(tests::empty_folder("mesh_doors") / "a.pc2", m, o);
  };
  refuses<io::AnimationOptions>("AnimationWriter", {&io::AnimationOptions::fps, &io::AnimationOptions::start},
                                {not_a_number, HUGE_VAL, -1}, move);
  const auto write = [](Mesh& m, const io::WriteOptions& o) {
    std::ostringstream out;
    io::write_mesh(out, io::MeshFormat::obj, as_file(m), o);
  };
  refuses<io::WriteOptions>("write_mesh", {&io::WriteOptions::metres_per_unit},
                            {not_a_number, HUGE_VAL, 0, -1}, write);
}

TEST_CASE("mesh doors: no count and no handle out of its range is taken") {
  const Mesh whole = whole_mesh();
  std::vector<Door> all;
  for (const int n : {-1, 7, 1 << 30}) {
    all.push_back({"loop_subdivide", [n](Mesh& m) { loop_subdivide(m, n); }});
    all.push_back({"midpoint_subdivide", [n](Mesh& m) { midpoint_subdivide(m, n); }});
    all.push_back({"sqrt3_subdivide", [n](Mesh& m) { sqrt3_subdivide(m, n); }});
  }
  for (const int n : {-1, 0, 1 << 30})
    all.push_back({"bake_maps", [n](Mesh& m) { bake_maps(m, m, {n, 1}); }});
  for (const int n : {-1, 1 << 30}) {
    all.push_back({"bake_maps", [n](Mesh& m) { bake_maps(m, m, {16, n}); }});
    all.push_back({"taubin_smooth", [n](Mesh& m) { smooth_often(m, n); }});
    all.push_back({"wrinkle", [n](Mesh& m) { wrinkle(m, ridge(), with_rule(InsertionRule::safe, n)); }});
    all.push_back({"line_shapes", [n](Mesh&) { line_shapes(ridge(), n); }});
  }
  for (const Vertex v : {Vertex(), Vertex(1 << 28), Vertex(whole.num_vertices())}) {
    all.push_back({"taubin_smooth", [v](Mesh& m) { taubin_smooth(m, std::vector{v}); }});
    all.push_back({"wrinkle", [v](Mesh& m) {
                     WrinkleOptions o;
                     o.held = {v};
                     wrinkle(m, ridge(), o);
                   }});
  }
  all.push_back({"apply_rest_rule", [](Mesh& m) { apply_rest_rule(m, {}, RestRule::drawn); }});
  all.push_back({"scatter", [](Mesh& m) { bridge::scatter({}, m); }});
  all.push_back({"scatter_velocities", [](Mesh& m) {
                   physics::Particles p;
                   p.x.resize(m.number_of_vertices());
                   bridge::scatter_velocities(p, m);
                 }});
  all.push_back({"keep_lines", [](Mesh& m) {
                   physics::Cloth cloth = bridge::gather(m, springs());
                   cloth.particles.inv_mass.pop_back();
                   bridge::keep_lines(m, cloth, {}, {}, {});
                 }});
  all.push_back({"keep_shape", [](Mesh& m) {
                   physics::Cloth cloth = bridge::gather(m, springs());
                   cloth.particles.inv_mass.pop_back();
                   bridge::keep_shape(cloth, {}, {});
                 }});
  for (std::size_t i = 0; i < all.size(); ++i) {
    Mesh mesh = whole;
    CAPTURE(all[i].name, i);
    CHECK(words_of(all[i], mesh) != "");
    CHECK(is_same(mesh, whole));
  }
}

TEST_CASE("mesh doors: no public function is left out") {
  std::set<std::string> entered{"ensure_map", "find_map",  // read no element
                                "find_wrinkle_record", "set_wrinkle_record",
                                "drop_motion"};  // comments and maps alone
  for (const Door& door : doors()) entered.insert(door.name);
  for (const char* folder : {"geometry", "bridge", "io"})
    for (const std::string& name : tests::public_functions_of(folder, "Mesh|MeshFile|SavedState")) {
      INFO(folder << ": " << name << "() is given a mesh: add it to the table above");
      CHECK(entered.count(name));
    }
}
