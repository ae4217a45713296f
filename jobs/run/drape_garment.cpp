// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/run/drape_garment.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "bridge/convert.h"
#include "bridge/gather.h"
#include "geometry/fold/fold_base.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/struts.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/rest/rest_metric.h"
#include "io/animation/animation_file.h"
#include "jobs/check/gate.h"
#include "jobs/check/seam_ties.h"
#include "jobs/read_inputs.h"
#include "jobs/run/drape_starts.h"
#include "jobs/run/fall_watch.h"
#include "jobs/run/measure_crossings.h"
#include "jobs/run/measure_shape.h"
#include "jobs/run/pins.h"
#include "jobs/run/prepare_garment.h"
#include "jobs/run/scene_cloth.h"
#include "physics/base/progress.h"
#include "physics/body/collider.h"
#include "physics/cloth/elastic_band.h"
#include "physics/cloth/pins.h"

namespace furrow::jobs {
namespace {

/// The way to rest, a frame an iteration of the finest level.
class WayRecorder {
 public:
  WayRecorder(const std::filesystem::path& path, int last_level, const Context& context)
      : path_(path), last_level_(last_level), context_(context) {}
  void observe(int level, const physics::Cloth& cloth) {
    if (path_.empty() || level < last_level_) return;
    if (!writer_) {
      geometry::Mesh mesh;
      for (const physics::Vec3& x : cloth.particles.x) mesh.add_vertex({x.x(), x.y(), x.z()});
      for (const auto& t : cloth.triangles)
        mesh.add_face(geometry::Vertex(t[0]), geometry::Vertex(t[1]), geometry::Vertex(t[2]));
      io::AnimationOptions options;
      options.frame = write_options(context_.frame);
      writer_ = std::make_unique<io::AnimationWriter>(path_, mesh, options);
    }
    writer_->add(cloth.particles.x);
  }
  /// Whether there is anything to see.
  bool close() {
    if (writer_) writer_->close();
    return writer_ != nullptr;
  }

 private:
  const std::filesystem::path& path_;
  int last_level_;
  const Context& context_;
  std::unique_ptr<io::AnimationWriter> writer_;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A vertex of the loop that a name means on the mesh as it was read: refinement keeps its index, but may
/// change which loop is the longest.
int vertex_of_loop(const geometry::Mesh& mesh, const std::string& name) {
  const auto loops = geometry::border_loops(mesh);
  return int(loops[geometry::find_border_loop(loops, name)].vertices.at(0));
}

std::vector<int> loop_through(const geometry::Mesh& mesh, int vertex) {
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh)) {
    std::vector<int> vertices;
    for (const geometry::Vertex v : loop.vertices) vertices.push_back(int(v));
    if (std::find(vertices.begin(), vertices.end(), vertex) != vertices.end()) return vertices;
  }
  return {};
}

/// As struts, so that the garment's file has them; a band that was there is taken off.
void sew_band(geometry::Mesh& mesh, const std::vector<int>& loop,
              const physics::ElasticBandOptions& options) {
  physics::Cloth band;
  band.particles.x = bridge::positions_of(mesh);
  physics::add_elastic_band(band, loop, options);
  std::vector<geometry::Strut> all = geometry::struts(mesh);
  std::erase_if(all, [&](const geometry::Strut& s) {
    return std::any_of(band.bending.begin(), band.bending.end(),
                       [&](const physics::Spring& b) { return int(s.a) == b.a && int(s.b) == b.b; });
  });
  using Index = geometry::Vertex::size_type;
  for (const physics::Spring& s : band.bending)
    all.push_back({geometry::Vertex(Index(s.a)), geometry::Vertex(Index(s.b)), s.rest_length, s.stiffness});
  geometry::set_struts(mesh, all);
}

/// Vertices of a garment that was measured.
std::size_t count_nearer(const geometry::Mesh& mesh, double distance) {
  std::size_t n = 0;
  for (const geometry::VertexAttribute& a : geometry::vertex_attributes(mesh))
    if (a.name == bridge::fit_distance)
      for (geometry::Vertex v : mesh.vertices()) n += a.values[v] < distance;
  return n;
}

/// Makes cloth of the garment on each level; pins and bands are found again there.
class Maker {
 public:
  /// Throws std::invalid_argument for a pin's or a band's loop that the garment does not have.
  Maker(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& settings,
        const io::MeshFile& as_read, const Context& context)
      : scene_(scene), body_(body), settings_(settings), as_read_(as_read), context_(context) {
    for (const io::ScenePins& pins : scene.pins)
      pin_vertices_.push_back(pins.loop.empty() ? -1 : vertex_of_loop(as_read.mesh, pins.loop));
    for (const Band& band : settings.bands) try {
        band_vertices_.push_back(vertex_of_loop(as_read.mesh, band.loop));
      } catch (const std::invalid_argument& e) {
        throw std::invalid_argument("--band: " + std::string(e.what()));
      }
  }

  physics::Cloth operator()(geometry::Mesh& mesh) {
    made = as_read_;
    made.mesh = mesh;
    const auto pins = find_pins(made, pins_on(mesh));
    complete_garment(made, scene_.material);
    tie_seams(mesh);
    for (std::size_t i = 0; i < band_vertices_.size(); ++i)
      sew_band(made.mesh, loop_through(mesh, band_vertices_[i]),
               {settings_.bands[i].length, settings_.band_stiffness});
    physics::Cloth cloth = naming(scene_.garment.string(), [&] {
      return bridge::gather(made.mesh, spring_options(made, scene_.material));
    });
    pin_cloth(cloth, pins, nullptr, 0, context_);
    held_.assign(cloth.particles.size(), 0);
    for (const std::vector<int>& held : pins)
      for (const int i : held) held_[std::size_t(i)] = 1;
    if (!loose.empty()) hold_loose(mesh, cloth);
    told_thin_ |= couple_cloth(made, scene_, cloth, context_, !told_thin_);  // once, not at each level
    int moved = 0;
    if (body_)
      for (const std::vector<int>& held : pins)
        moved += physics::push_out(cloth.particles.x, held, body_->exact).moved;
    if (moved)
      context_.warn("pins_inside_body",
                    std::to_string(moved) + " of " + std::to_string(mesh.number_of_vertices()) +
                        " vertices are pinned inside the body; moved onto it",
                    "pins");
    mesh = made.mesh;
    return cloth;
  }

  /// Whether a pin holds one of the last level's particles.
  bool any_held() const { return std::find(held_.begin(), held_.end(), 1) != held_.end(); }
  const std::vector<char>& held() const { return held_; }

  io::MeshFile made;       ///< of the last level
  std::vector<int> loose;  ///< a vertex of each part that nothing holds: those parts are held as they lie

 private:
  /// Those of the level; the finer one's are found by what this one is.
  void tie_seams(const geometry::Mesh& mesh) {
    if (mesh.num_vertices() == as_read_.mesh.num_vertices())
      ties_ = seam_ties(as_read_.mesh);
    else
      ties_ = refined_ties(tied_, ties_);
    if (ties_.empty()) return;
    tied_ = mesh;
    set_seam_ties(made.mesh, ties_, scene_.material);
  }

  void hold_loose(const geometry::Mesh& mesh, physics::Cloth& cloth) const {
    const geometry::Parts parts = geometry::find_parts(mesh);
    for (const int seed : loose)
      for (std::size_t i = 0; i < parts.of_vertex.size(); ++i)
        if (parts.of_vertex[i] == parts.of_vertex[std::size_t(seed)])
          physics::pin(cloth.particles, std::vector<int>{int(i)});
  }

  std::vector<io::ScenePins> pins_on(const geometry::Mesh& mesh) const {
    std::vector<io::ScenePins> result = scene_.pins;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (pin_vertices_[i] < 0) continue;
      const std::vector<int> loop = loop_through(mesh, pin_vertices_[i]);
      result[i].loop.clear();
      result[i].vertices.insert(result[i].vertices.end(), loop.begin(), loop.end());
    }
    return result;
  }

  const io::Scene& scene_;
  const BodyCollider* body_;
  const DrapeSettings& settings_;
  const io::MeshFile& as_read_;
  const Context& context_;
  std::vector<int> pin_vertices_, band_vertices_;
  SeamTies ties_;
  geometry::Mesh tied_;  ///< of the level that has them
  std::vector<char> held_;
  bool told_thin_ = false;
};

/// Of the refined garment: its edges are half as long a level, their sag a quarter.
double refined_sag(geometry::Mesh garment, int levels) {
  geometry::ensure_rest_lengths(garment);
  return edge_sag(garment) / std::pow(4, levels);
}

double gap_with(double wanted, double sag, double tolerance) { return std::max(wanted, sag + tolerance); }

/// What lowers a gap that the edges' sag and the field's tolerance raised.
std::string remedy_of_gap(const geometry::Mesh& garment, double sag, int levels, double wanted,
                          double tolerance) {
  if (sag <= tolerance)
    return fmt::format("--set body.tolerance={:.2g} asks for a finer field of the body", tolerance / 2);
  const double vertices = double(garment.number_of_vertices()) * std::pow(4, levels + 1);
  const bool drawn = geometry::find_map(garment, geometry::attribute::line).has_value();
  return std::string("its edges are long: ") +
         (drawn ? "refine it before its lines are drawn (furrow subdivide), or " : "") + "with --subdivide " +
         std::to_string(levels + 1) + " (some " + std::to_string(std::llround(vertices)) +
         " vertices) it is " + geometry::length_text(gap_with(wanted, sag / 4, tolerance));
}

/// What is wanted, or what the sag and the field's tolerance need; warns where that is much more.
double gap_of(const io::Scene& scene, const BodyCollider* body, const geometry::Mesh& garment,
              const Context& context) {
  const double wanted = scene.simulation.contact_gap;
  if (!body) return wanted;
  const double tolerance = body->field.report().tolerance;
  const double sag = refined_sag(garment, scene.subdivide), gap = gap_with(wanted, sag, tolerance);
  if (gap > 1.5 * wanted)
    context.warn("gap_raised",
                 scene.garment.stem().string() + ": keeps " + geometry::length_text(gap) +
                     " from the body, not " + geometry::length_text(wanted) +
                     ", so strain and ease come out too large; " +
                     remedy_of_gap(garment, sag, scene.subdivide, wanted, tolerance),
                 scene.garment.string(), sag > tolerance ? "garment.subdivide" : "body.tolerance");
  return gap;
}

/// How the way to rest is looked for on a garment that was read.
struct DrapePlan {
  const io::Scene& scene;
  const BodyCollider* body;  ///< null: none
  const DrapeSettings& settings;
  const io::MeshFile& as_read;
  bridge::DrapeOptions options;
};

/// With contact of cloth with cloth, whose piles take many steps to lie still.
void hold_apart(bridge::DrapeOptions& options, const DrapeSettings& s) {
  options.settle.self.on = true;
  options.settle.max_iterations = s.iterations.value_or(1000);
}

bridge::DrapeOptions options_of(const io::Scene& scene, const DrapeSettings& s, double gap) {
  bridge::DrapeOptions options;
  options.refinements = scene.subdivide;
  options.settle.gravity = scene.simulation.gravity;
  options.settle.friction = scene.simulation.friction;
  options.settle.tolerance = s.residual;
  if (s.contact_depth) options.settle.contact_depth = *s.contact_depth;
  options.settle.self.thickness = s.thickness;
  options.plain = s.plain;
  options.bending_friction = s.bending_friction;
  options.settle.max_iterations = s.iterations.value_or(s.plain ? 20000 : options.settle.max_iterations);
  if (s.self_contact == SelfContactUse::on) hold_apart(options, s);
  options.settle.gap = gap;
  options.settle.threads =
      scene.threads ? scene.threads : int(std::max(1u, std::thread::hardware_concurrency()));
  return options;
}

/// A way to rest that was gone.
struct Gone {
  bridge::DrapeReport report;
  geometry::Mesh mesh;
  physics::Cloth cloth;
  std::vector<int> falling;  ///< a vertex of each part that fell, which ended it
};

/// Told how far one way is, in [0, 1]; returns whether to go on.
using Progress = std::function<bool(double)>;

Gone go(const DrapePlan& plan, Maker& maker, WayRecorder& way, const FallWatch& watch,
        const Progress& progress) {
  Gone gone;
  double first = 0;
  const auto observe = [&](int level, const physics::SettleProgress& p, const physics::Cloth& cloth) {
    way.observe(level, cloth);
    if (level == 0 && maker.loose.empty() && p.iteration > 0 && p.iteration % 5 == 0)
      gone.falling = watch.find(cloth, maker.held());
    if (p.iteration == 0 || p.residual > first) first = p.residual;
    const double least = plan.options.settle.tolerance;
    const bool far = std::isfinite(p.residual) && p.residual > least && first > least;
    const double way_there = far ? std::log(first / p.residual) / std::log(first / least) : 1;
    const int levels = plan.options.refinements + 1;
    return progress((level + std::clamp(way_there, 0.0, 1.0)) / levels) && gone.falling.empty();
  };
  gone.mesh = plan.as_read.mesh;
  gone.report = bridge::drape(gone.mesh, gone.cloth, plan.body ? &plan.body->field : nullptr, plan.options,
                              std::ref(maker), observe);
  return gone;
}

/// Whether a garment that nothing carries balances all the same, or is pulled by more than any cloth is.
/// (What falls lacks one weight.)
bool is_broken(const physics::SettleReport& last) {
  return !std::isfinite(last.residual) || last.residual > 1e9 || last.residual < 0.5;
}

void take_result(Gone gone, Maker& maker, const DrapePlan& plan, const FallWatch& watch, Draped& draped) {
  draped.report = std::move(gone.report);
  draped.refinements = int(draped.report.levels.size()) - 1;
  draped.file = std::move(maker.made);
  draped.file.mesh = std::move(gone.mesh);
  close_seam_ties(draped.file.mesh);
  const physics::SettleReport& last = draped.report.levels.back().settle;
  const bool uncarried = last.touching == 0 && !plan.scene.simulation.gravity.isZero() && !maker.any_held();
  draped.broken = uncarried && is_broken(last);
  draped.falls = uncarried && !draped.broken;
  draped.parts = watch.count();
  for (const int seed : maker.loose)
    draped.loose.push_back(
        name_of_part(plan.as_read, watch.parts(), watch.parts().of_vertex[std::size_t(seed)]));
}

void measure(const DrapePlan& plan, Draped& draped) {
  const CrossedStart crossed = crossed_start(plan.as_read.mesh, draped.refinements);
  draped.self_contact = draped.contact_tried = plan.options.settle.self.on;
  draped.thickness = plan.settings.thickness;
  draped.crossings = measure_crossings(draped.file, &crossed);
  draped.angle_defect = geometry::angle_defect(draped.file.mesh);
  for (const geometry::BorderLoop& loop : geometry::border_loops(draped.file.mesh))
    draped.hem_height = std::min(draped.hem_height.value_or(loop.mean_height), loop.mean_height);
  draped.lines = measure_lines(draped.file, line_heights_by_id(plan.as_read));
  if (!plan.body) {
    draped.fit = bridge::strain_report(draped.file.mesh, draped.fit_options);
    return;
  }
  draped.gap = plan.options.settle.gap;
  draped.wanted_gap = plan.scene.simulation.contact_gap;
  draped.fit_options.contact_distance = contact_distance(draped.gap);
  draped.fit =
      bridge::fit_report(draped.file.mesh, plan.body->triangles, plan.body->exact, draped.fit_options);
  if (draped.gap == draped.wanted_gap)
    draped.too_near = count_nearer(draped.file.mesh, 0.9 * draped.gap - plan.body->field.report().tolerance);
}

/// One way to rest. loose: a vertex of each part that nothing holds, where that is known; else it is found.
Draped drape_once(const DrapePlan& plan, const FallWatch& watch, std::vector<int>& loose,
                  const Progress& progress, const Context& context) {
  const double start = now();
  Maker maker(plan.scene, plan.body, plan.settings, plan.as_read, context);
  maker.loose = loose;
  Draped draped;
  const auto recorder = [&](std::optional<WayRecorder>& way) {
    way.emplace(plan.settings.animation, plan.scene.subdivide, context);
  };
  std::optional<WayRecorder> way;
  recorder(way);
  Gone gone = go(plan, maker, *way, watch, progress);
  if (!gone.falling.empty()) {
    loose = maker.loose = gone.falling;
    recorder(way);
    gone = go(plan, maker, *way, watch, progress);
  }
  take_result(std::move(gone), maker, plan, watch, draped);
  draped.seconds = now() - start;
  draped.animated = way->close();
  way.reset();
  measure(plan, draped);
  return draped;
}

/// Whether contact of cloth with cloth would have kept it from what it came to.
bool asks_for_contact(const DrapePlan& plan, const Draped& d) {
  const std::size_t allowed = std::size_t(plan.scene.allow_crossings);
  return plan.settings.self_contact == SelfContactUse::automatic && !plan.settings.plain &&
         !d.report.stopped && d.rests() && d.crossings.pairs > std::max(allowed, d.crossings.from_start);
}

/// The better one of a rest to which cloth passed through cloth, and one with contact of cloth with cloth,
/// which is looked for now.
Draped drape_with_contact(Draped without, DrapePlan plan, const FallWatch& watch, std::vector<int>& loose,
                          const Context& context) {
  SilentListener silent(context.listener);
  const Context quiet{context.frame, silent, context.memory};  // what was warned of is so still
  const ProgressScope progress(context.listener, "keeping cloth off cloth");
  const bridge::DrapeOptions free = plan.options;
  hold_apart(plan.options, plan.settings);
  plan.options.work = nullptr;
  Draped with = drape_once(plan, watch, loose, std::ref(progress), quiet);
  const double seconds = without.seconds + with.seconds;
  if (with.report.stopped) {
    without.report.stopped = true;
  } else if (with.rests() && with.crossings.pairs < without.crossings.pairs) {
    with.crossings_without = without.crossings.pairs;
    without = std::move(with);
  } else if (!plan.settings.animation.empty()) {  // it shows the way that is not taken
    plan.options = free;
    without = drape_once(plan, watch, loose, std::ref(progress), quiet);
  }
  without.contact_tried = true;
  without.seconds = seconds;
  return without;
}

/// Goes on from the first start to all of them, and returns the one with the lowest energy, with what all
/// tell. start(i, context) is the i-th. What is cancelled ends with the starts that there are.
template <class Start>
Draped choose_start(Draped best, int count, const Start& start, const Context& context) {
  SilentListener silent(context.listener);
  const Context quiet{context.frame, silent, context.memory};  // the first one warned
  DrapeStarts all{count, 0, {start_of(best, 0)}, {}};
  bool stopped = best.report.stopped;
  for (int i = 1; i < count && !stopped; ++i) try {
      Draped next = start(i, quiet);
      stopped = next.report.stopped;
      if (stopped) break;
      all.runs.push_back(start_of(next, std::uint64_t(i)));
      if (!is_better(all.runs.back(), all.runs[all.chosen])) continue;
      all.chosen = all.runs.size() - 1;
      best = std::move(next);
    } catch (const physics::Cancelled&) {
      stopped = true;
    }
  best.report.stopped = stopped;
  all.spread = spread_of(all.runs);
  best.seconds = 0;
  for (const DrapeStart& run : all.runs) best.seconds += run.seconds;
  best.starts = std::move(all);
  return best;
}

/// The garment as it was given, and the scene with as many refinements as it is draped with.
struct Given {
  io::Scene scene;
  io::MeshFile file;
};

Given read_given(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& s, bool choose,
                 const Context& context) {
  Given given{scene, {}};
  given.scene.subdivide = 0;
  given.file = begin_garment(given.scene, context);
  if (body)
    heed(faults_of_pair(given.file.mesh, body->outline, scene.body->unit.has_value()), scene.garment.string(),
         context);
  given.scene.subdivide = scene.subdivide;
  if (choose && !s.plain && body)
    given.scene.subdivide =
        refinements_for_gap(given.file.mesh, scene.simulation.contact_gap, body->field.report().tolerance);
  require_refinement(given.file.mesh.number_of_faces(), 4, given.scene.subdivide, "--subdivide", context);
  if (given.scene.subdivide > 0 &&
      geometry::struts(given.file.mesh).size() > seam_ties(given.file.mesh).size())
    context.warn("struts_dropped",
                 "--subdivide drops the struts that the garment has, its bands among them; say --band again",
                 "garment.subdivide", "bands");
  return given;
}

}  // namespace

double soft_start_of(const io::MeshFile& garment, bool pinned) {
  constexpr double times_softer = 30;  // 10 and 100 do as well
  const auto record = io::find_wrinkle_record(garment);
  return pinned && record && record->options.find("--rule fold") != std::string::npos ? times_softer : 1;
}

int refinements_for_gap(const geometry::Mesh& garment, double wanted, double tolerance) {
  constexpr double most_vertices = 60000, slack = 1.05;
  if (geometry::find_map(garment, geometry::attribute::rest_length) || garment.number_of_edges() == 0)
    return 0;
  int levels = 0;
  double sag = refined_sag(garment, 0), vertices = 4.0 * double(garment.number_of_vertices());
  while (levels < 4 && vertices <= most_vertices && sag > tolerance / 4 && sag + tolerance > slack * wanted) {
    ++levels;
    sag /= 4;
    vertices *= 4;
  }
  return levels;
}

Draped drape_garment(const io::Scene& asked, const BodyCollider* body, const DrapeSettings& s, bool choose,
                     const Context& context) {
  const Given given = read_given(asked, body, s, choose, context);
  const io::Scene& scene = given.scene;
  const double gap = s.gap.value_or(0) > 0 ? *s.gap : gap_of(scene, body, given.file.mesh, context);
  DrapePlan plan{scene, body, s, given.file, options_of(scene, s, gap)};
  plan.options.soft_start = soft_start_of(given.file, !scene.pins.empty());
  if (body) plan.options.settle.faces = {&body->exact, body->field.report().tolerance};
  const FallWatch watch(given.file.mesh, body, gap);
  const ProgressScope progress(context.listener, "draping");
  const int count = scene.starts;
  bridge::DrapeWork work;
  if (count > 1) plan.options.work = &work;
  std::vector<int> loose;  // as the first start found
  const auto start = [&](int i, const Context& told) {
    plan.options.seed = std::uint64_t(i);
    Draped draped = drape_once(
        plan, watch, loose, [&](double share) { return progress((i + share) / count); }, told);
    if (!asks_for_contact(plan, draped)) return draped;
    return drape_with_contact(std::move(draped), plan, watch, loose, told);
  };
  Draped draped = start(0, context);
  if (count > 1) draped = choose_start(std::move(draped), count, start, context);
  return draped;
}

}  // namespace furrow::jobs
