// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/mesh/mesh_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/lost_lines.h"
#include "jobs/rest/drape_starts.h"
#include "jobs/rest/fit.h"
#include "jobs/rest/made_for.h"
#include "jobs/rest/touch_garment.h"

namespace furrow::jobs {
namespace {

/// The next refinement.
std::string finer(const Draped& d) {
  return d.report.local() ? "a smaller `finest`" : "`subdivide=" + std::to_string(d.refinements + 1) + "`";
}
const char* finer_field(const Draped& d) { return d.report.local() ? "finest" : "garment.subdivide"; }

/// What is said of one garment, or of a pair: sentences that begin with its name.
class Remarks {
 public:
  Remarks(std::vector<DrapeRemark>& all, const std::string& about, const std::string& head)
      : all_(all), about_(about), head_(head + ": ") {}
  Remarks(std::vector<DrapeRemark>& all, const Draped& d) : Remarks(all, d.name, d.name) {}

  /// help: the setting that helps; fails: whether the drape is no success with it.
  template <class... Args>
  void add(bool fails, const char* code, const char* help, fmt::format_string<Args...> text, Args&&... args) {
    all_.push_back({fails, {code, head_ + fmt::format(text, std::forward<Args>(args)...), about_, help}});
  }
  template <class... Args>
  void fault(const char* code, const char* help, fmt::format_string<Args...> text, Args&&... args) {
    add(true, code, help, text, std::forward<Args>(args)...);
  }
  template <class... Args>
  void note(const char* code, const char* help, fmt::format_string<Args...> text, Args&&... args) {
    add(false, code, help, text, std::forward<Args>(args)...);
  }

 private:
  std::vector<DrapeRemark>& all_;
  std::string about_, head_;
};

std::string place_text(const physics::Vec3& at) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f}) m", at.x(), at.y(), at.z());
}

void remark_on_refinement(const Draped& d, Remarks& say) {
  if (d.report.ran_out)
    say.note(
        "vertices_ran_out", "finest",
        "more of it asks to be refined than 20,000 vertices or its coarse faces allow; what folds most was "
        "refined first; a larger `finest` asks for less");
}

/// What the body does to the cloth that has come to rest on it.
void remark_on_contact(const Draped& d, Remarks& say) {
  const bool pierced = d.end.is_pierced(d.limits);
  if (d.end.is_torn() && !pierced) return;  // no refinement helps
  const auto& distance = d.fit.distance;
  const bool comes_through = d.fit.piercing.faces > 0;
  const std::string through = d.end.body ? words_of_piercing(*d.end.body) : "";
  if (pierced)
    say.fault("pierced", finer_field(d), "{}; {}{}, or accept it with `penetration`",
              comes_through
                  ? through
                  : "lies inside the body, by up to " + geometry::length_text(distance.deepest_penetration),
              d.placed
                  ? "it is too small there, or the body leaves cloth no room; refine it with "
                  : "look at where the garment lies before it is draped (and at `unit`), refine it with ",
              finer(d));
  else if (comes_through)
    say.note("body_comes_through", finer_field(d), "{}; with {} the cloth follows the body more closely",
             through, finer(d));
  if (d.too_near)
    say.note("gap_not_kept", "gap",
             "{} {} nearer to the body than the gap of {}, down to {}; the cloth is too tight for it there, "
             "or the body leaves no room: a smaller `gap` may do",
             d.too_near, d.too_near == 1 ? "vertex is" : "vertices are", geometry::length_text(d.gap),
             geometry::length_text(distance.min));
}

/// A garment that lay well inside the body as it was given.
void remark_on_start(const Draped& d, Remarks& say) {
  constexpr double deep = 0.025;  // [m]; what was made for a body lies a few millimetres inside it
  const physics::PushOutReport& pushed = d.report.levels.front().pushed;
  if (d.placed || !d.fit.on_body || !(pushed.farthest > d.gap + deep)) return;
  say.note(
      "starts_inside", "made_for",
      "lies up to {} inside the body as it is given ({} of {} vertices were brought out): if it was made "
      "for another body, name that one with `made_for`, and it is brought here",
      geometry::length_text(pushed.farthest - d.gap), pushed.moved, d.report.levels.front().vertices);
}

/// Touches that the garment at rest has not kept.
void remark_on_touches(const Draped& d, Remarks& say) {
  constexpr double kept = 0.9;
  for (std::size_t i = 0; i < d.touches.size(); ++i) {
    const TouchReport& t = d.touches[i];
    if (t.remains && *t.remains < kept)
      say.note("touch_fades", "touches", "of touch {} ({}) {:.0f} % remain at rest; {}", i + 1,
               geometry::word_of(t.touch.kind), 100 * std::max(*t.remains, 0.0),
               t.balances ? "the cloth around has moved with it" : "the cloth there had found no balance");
  }
}

/// What could not be taken apart, and where most of it is.
std::string words_of_tangle(const physics::ContourReport& untangled) {
  double length = 0;
  for (const physics::CrossingLine& l : untangled.lines) length += l.length;
  const physics::CrossingLine& most = untangled.lines.front();
  return fmt::format(
      "it crosses itself as it is given, along {:.0f} mm that could not be taken apart, most ({:.0f} mm) at "
      "{}",
      1000 * length, 1000 * most.length, place_text(most.middle));
}

/// Whether most of what crosses is of two parts of a garment.
bool crosses_between_parts(const ClothCrossings& c) {
  std::size_t between = 0;
  for (const CrossingPlace& p : c.places)
    if (p.parts[0] != p.parts[1]) between += p.pairs;
  return 2 * between > c.pairs;
}

/// What a user can do about cloth that crosses itself.
std::string remedy_of_crossings(const Draped& d) {
  if (!d.untangled.lines.empty()) return words_of_tangle(d.untangled) + ": part its layers there";
  if (d.other && d.other->self_contact)
    return "with contact of cloth with cloth no better rest was found: part its layers, or give it room";
  if (d.crossings.pairs <= d.crossings.from_start)
    return "it crosses itself as it is given: part its layers before it is draped, or try `self_contact=on`";
  if (d.self_contact)
    return "cloth is not held apart where it crosses itself as it is given: part its layers there";
  return "`self_contact=on` keeps cloth off cloth";
}

void remark_on_crossings(const Draped& d, Remarks& say) {
  if (!d.crossings.pairs) return;
  say.add(
      d.crosses_itself(), "cloth_crosses", "garment.allow_crossings", "{}; {}{}{}", words(d.crossings),
      remedy_of_crossings(d),
      crosses_between_parts(d.crossings) ? "; these are separate pieces: give each as a file of its own, the "
                                           "inner one first (`furrow drape` "
                                           "inner.obj outer.obj)"
                                         : "",
      d.crosses_itself() ? fmt::format("; accept them with `allow_crossings={}`", d.crossings.pairs) : "");
}

/// Whether it was draped with contact of cloth with cloth is the better of two ends; this is the other one.
void remark_on_other_way(const Draped& d, Remarks& say) {
  if (!d.other) return;
  const DrapeOther& other = *d.other;
  if (other.self_contact)
    say.note(
        "contact_left_out", "self_contact",
        "draped without contact of cloth with cloth, as its end with it is no better: {}{} after {} "
        "iterations, residual force {:.2g}, {} pairs of faces crossing; `self_contact=on` writes that, off "
        "does not look for it",
        other.outcome, other.blocked_at ? " at " + place_text(*other.blocked_at) : "", other.iterations,
        other.residual, other.crossings);
  else
    say.note("contact_kept", "self_contact",
             "draped with contact of cloth with cloth, as its end without it is worse: {}, {} pairs of faces "
             "crossing; `self_contact=off` writes that",
             other.outcome, other.crossings);
}

/// Lines that lost their height, unless a touch took hold of them, or have no vertex left to measure it by.
void remark_on_lines(const Draped& d, std::vector<DrapeRemark>& remarks) {
  std::vector<LineReport> untouched = d.lines;
  for (const TouchReport& t : d.touches)
    std::erase_if(untouched, [&t](const LineReport& line) { return t.lines.contains(line.id); });
  for (const Warning& lost : lost_lines({}, untouched)) remarks.push_back({false, lost});
  const auto record = io::find_wrinkle_record(d.file);
  std::string gone;
  for (std::size_t id = 0; record && id < record->lines.size(); ++id)
    if (std::none_of(d.lines.begin(), d.lines.end(), [&](const LineReport& line) { return line.id == id; }))
      gone += (gone.empty() ? "'" : ", '") + record->lines[id].name + "'";
  if (!gone.empty())
    Remarks(remarks, d)
        .note("lines_merged", "",
              "whether these lines stand cannot be measured, as later lines run along them and took their "
              "vertices: {}",
              gone);
}

/// Cloth that no cloth survives: the fabric's law says nothing true of it any more.
void remark_on_strain(const Draped& d, Remarks& say) {
  if (!d.end.is_torn()) return;
  const bridge::FitStrain& strain = *d.fit.strain;
  std::string where;
  if (!d.fit.tight.empty()) {
    const bridge::FitZone& zone = d.fit.tight.front();
    where = fmt::format(", most at {:.0f} % of the body's height, {}", 100 * zone.height_share, zone.side);
  }
  say.fault(
      "torn", "unit",
      "torn: {:.0f} % of the cloth is strained by more than {:.0f} %, up to {:.0f} %{}; the garment is too "
      "small for this body{}",
      100 * strain.share_over, 100 * d.fit_options.tight_strain, 100 * strain.max, where,
      d.placed ? "" : ", or lies inside it: look at `unit`, and at where it lies");
}

const char* word_of(LooseUse use) {
  return use == LooseUse::hold ? "held" : use == LooseUse::drop ? "dropped" : "simulated";
}

std::string words_of_loose(const LooseParts& loose) {
  if (loose.use == LooseUse::drop) return fmt::format("dropped, {} vertices", loose.vertices);
  return fmt::format("they ({} vertices, {:.2g} % of its area) were carried with the nearest cloth",
                     loose.vertices, 100 * loose.area_share);
}

void remark_on_loose_parts(const Draped& d, Remarks& say) {
  if (d.loose.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(d.loose.size(), 5); ++i)
    names += (i ? ", " : "") + d.loose[i];
  if (d.loose.size() > 5) names += fmt::format(" and {} more", d.loose.size() - 5);
  const std::size_t doubled = d.file.repairs.duplicated_vertices;
  say.add(d.falls_apart(), "loose_parts", "pins", "nothing holds {} of its {} parts: {}; {}{}{}",
          d.loose.size(), d.end.parts.size(), names, words_of_loose(d.loose_parts),
          doubled ? fmt::format(
                        "; its file has edges or vertices that more than two faces share, where it was cut "
                        "open ({} vertices doubled)",
                        doubled)
                  : "",
          d.loose_parts.use == LooseUse::drop
              ? ""
              : "; join them to the garment in its file, pin them (`pin_group`, `pin_box`), or take them out "
                "(`loose=drop`)");
}

/// Why a garment that nothing carries does not rest.
void remark_on_nothing_carried(const Draped& d, const physics::SettleReport& last, Remarks& say) {
  if (!d.end.finite)
    return say.fault(
        "numerical_failure", "material",
        "numerical failure: the forces cannot be computed (residual force {:.2g} of a vertex's "
        "weight); look at `stretch`, `rigidity`, `density` and `gravity`, one of which is far beyond "
        "any cloth's",
        last.residual);
  say.note(
      "touches_nothing", "unit",
      "never came to lie on the body, which is {} tall; look at where the two are, and at `unit`, which is "
      "that of both files",
      geometry::length_text(d.fit.body_high - d.fit.body_low));
}

/// Cloth that cloth leaves no step.
void remark_on_block(const physics::SettleReport& last, Remarks& say) {
  say.fault(
      "blocked", "self_contact",
      "blocked at {} after {} iterations, residual force {:.2g} of a vertex's weight: cloth lies so close "
      "to cloth there that no step is left; give it room where it begins, hold more of it, or make the "
      "cloth thinner with `cloth_thickness`",
      place_text(last.self.blocked_at), last.iterations, last.residual);
}

/// Whether a part came to lie on something, far below where it was worn.
bool came_lower(const Draped& d) {
  const bool carried = d.report.levels.back().settle.touching > 0 || !d.end.falls();
  return d.end.finite && d.end.lost() > 0 && d.end.fallen() > 0 && carried;
}

void remark_on_lost_parts(const Draped& d, Remarks& say) {
  if (!came_lower(d)) return;
  std::string names;
  for (const PartEnd& part : d.end.parts)
    if (part.lost) names += (names.empty() ? "" : ", ") + part.name;
  const bool whole = d.end.falls();
  say.fault(
      "fallen", "pins",
      "{}fell {} from where it lay before anything stopped it: the body does not carry it where it is "
      "worn{}; look for skin that the body lacks there (holes in it are filled), put the garment where it "
      "is worn, or hold it with a pin or a band",
      whole ? "" : names + " ", geometry::length_text(d.end.fallen()),
      whole ? "" : ", nor does the rest of the garment");
}

void remark_on_unrest(const Draped& d, Remarks& say) {
  const physics::SettleReport& last = d.report.levels.back().settle;
  if (!d.end.finite || (last.touching == 0 && d.fit.on_body)) remark_on_nothing_carried(d, last, say);
  if (!d.end.finite || (d.end.falls() && came_lower(d))) return;  // told of as fallen
  if (d.end.falls())
    return say.fault("falls", "pins",
                     "falls, as neither the body nor a pin carries it; put it where it is to be worn");
  if (last.self.blocked) return remark_on_block(last, say);
  const long long cut = last.self.cut_moves.value_or(0);
  say.fault(
      "not_at_rest", "iterations",
      "not at rest after {} iterations, residual force {:g} of a vertex's weight, cloth {} deep in the "
      "gap{}{}",
      last.iterations, last.residual, geometry::length_text(last.deepest),
      last.stuck ? ", and no step leads on: draw or lay it otherwise, or try `starts=4`"
      : cut > 0  ? fmt::format(", {} moves of vertices cut, as cloth was in their way", cut)
                 : "",
      last.stuck || d.end.is_torn() ? "" : "; give more with `max_iterations`, or accept it with `residual`");
}

Json level_json(const bridge::DrapeLevel& level) {
  return {{"vertices", level.vertices},
          {"pushed_out", level.pushed.moved},
          {"farthest_push", level.pushed.farthest},
          {"still_nearer", level.pushed.still_inside},
          {"iterations", level.soft.iterations + level.settle.iterations},
          {"factorisations", level.soft.factorisations + level.settle.factorisations},
          {"residual", level.settle.residual}};
}

Json self_contact_json(const Draped& d) {
  const physics::SelfContactReport& last = d.report.levels.back().settle.self;
  int cut = 0, builds = 0, stopped = 0;
  long long moves = 0;
  for (const bridge::DrapeLevel& level : d.report.levels) {
    moves += level.settle.self.cut_moves.value_or(0);
    cut += level.soft.self.cut_searches + level.settle.self.cut_searches;
    builds += level.soft.self.list_builds + level.settle.self.list_builds;
    stopped += level.stopped;
  }
  Json json{{"thickness", d.thickness},
            {"pairs", last.pairs},
            {"nearest", last.nearest},
            {"sliding", last.sliding},
            {"cut_searches", cut},
            {"list_builds", builds},
            {"crossed_at_start", last.crossed_at_start},
            {"exempt", last.exempt},
            {"stopped", stopped},
            {"friction", d.cloth_friction}};
  if (last.cut_moves) json["cut_moves"] = moves;
  if (d.other) json["crossings_without"] = d.other->crossings;
  if (last.blocked) json["blocked_at"] = {last.blocked_at.x(), last.blocked_at.y(), last.blocked_at.z()};
  return json;
}

Json to_json(const DrapeOther& other) {
  Json json{{"self_contact", other.self_contact}, {"outcome", other.outcome},
            {"crossings", other.crossings},       {"iterations", other.iterations},
            {"residual_force", other.residual},   {"seconds", other.seconds}};
  if (other.blocked_at) {
    const physics::Vec3& at = *other.blocked_at;
    json["blocked_at"] = {at.x(), at.y(), at.z()};
  }
  return json;
}

Json untangled_json(const physics::ContourReport& u) {
  Json json{{"at_start", u.at_start}, {"left", u.left}, {"rounds", u.rounds}, {"moved_most", u.farthest}};
  json["lines"] = Json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(10, u.lines.size()); ++i) {
    const physics::CrossingLine& l = u.lines[i];
    json["lines"].push_back({{"x", l.middle.x()},
                             {"y", l.middle.y()},
                             {"z", l.middle.z()},
                             {"length", l.length},
                             {"edges", l.crossings}});
  }
  return json;
}

void remark_on_crossed_layers(const LayerPair& p, std::size_t allowed, Remarks& say) {
  if (!p.crossings) return;
  const char* plural = p.crossings == 1 ? "" : "s";
  if (!p.touch)
    return say.note("layers_apart", "garment.touch",
                    "{} pair{} of faces cross, as one of them touches no other garment (touch = false)",
                    p.crossings, plural);
  const bool fails = p.crossings > allowed;
  std::string where;
  if (!p.places.empty()) {
    const geometry::Point& at = p.places.front().centre;
    where = fmt::format(", most ({}) within {:.1f} cm of {}", p.places.front().pairs,
                        50 * p.places.front().extent, place_text({at.x(), at.y(), at.z()}));
  }
  say.add(fails, "layers_cross", "garment.allow_crossings", "{} pair{} of faces cross{}; {}{}", p.crossings,
          plural, where,
          p.began_inside()
              ? "the outer one lies inside as it is given: name it before the other"
              : "they were not taken apart there: part them where they are given, or give the outer "
                "one room",
          fails ? fmt::format("; accept them with `allow_crossings={}`", p.crossings) : "");
}

Json layer_pair_json(const LayerPair& p) {
  Json json{{"inner", p.inner},
            {"outer", p.outer},
            {"touch", p.touch},
            {"crossings_at_start", p.crossings_at_start},
            {"crossings", p.crossings},
            {"compared_at_start", p.compared_at_start},
            {"outside_at_start", p.outside_at_start},
            {"compared", p.compared},
            {"outside", p.outside}};
  if (p.places.empty()) return json;
  json["places"] = Json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(10, p.places.size()); ++i) {
    const CrossingPlace& at = p.places[i];
    json["places"].push_back({{"pairs", at.pairs},
                              {"x", at.centre.x()},
                              {"y", at.centre.y()},
                              {"z", at.centre.z()},
                              {"extent", at.extent}});
  }
  return json;
}

Json to_json(const DrapedLayers& layers) {
  Json json{{"pairs", Json::array()},
            {"edges_crossed", layers.edges_crossed},
            {"edges_left", layers.edges_left},
            {"untangle_rounds", layers.untangle_rounds},
            {"moved_most", layers.moved_most},
            {"turned", layers.turned},
            {"contact_energy", layers.contact_energy}};
  for (const LayerPair& p : layers.pairs) json["pairs"].push_back(layer_pair_json(p));
  return json;
}

}  // namespace

std::vector<DrapeRemark> remarks_on(const DrapedLayers& layers, std::size_t allowed) {
  std::vector<DrapeRemark> remarks;
  for (const LayerPair& p : layers.pairs) {
    Remarks say(remarks, p.outer, p.outer + " over " + p.inner);
    remark_on_crossed_layers(p, allowed, say);
    if (!p.touch) continue;
    if (p.crossings == 0 && p.began_inside())
      say.note(
          "layer_order", "",
          "{} of {} vertices near it lay inside as they were given; if it is worn under the other, name it "
          "first",
          p.compared_at_start - p.outside_at_start, p.compared_at_start);
    if (2 * p.outside < p.compared)
      say.fault("layer_under", "",
                "{} of {} vertices near it lie inside; name the garments from the inside to the outside",
                p.compared - p.outside, p.compared);
  }
  for (const std::string& name : layers.turned)
    Remarks(remarks, name, name)
        .note("turned", "",
              "its faces look into the body, as if it were turned inside out; the side away from the body "
              "counts "
              "as its outer one");
  return remarks;
}

std::vector<DrapeRemark> remarks_on(std::span<const Draped> garments) {
  std::vector<DrapeRemark> remarks;
  for (const Draped& d : garments) {
    if (d.report.stopped) break;
    Remarks say(remarks, d);
    for (const auto remark_on :
         {remark_on_start, remark_on_touches, remark_on_strain, remark_on_contact, remark_on_refinement,
          remark_on_loose_parts, remark_on_lost_parts, remark_on_crossings, remark_on_other_way})
      remark_on(d, say);
    if (!d.rests()) remark_on_unrest(d, say);
    for (const Warning& doubt : doubts_of(d)) remarks.push_back({false, doubt});
    if (d.end.finite) remark_on_lines(d, remarks);
  }
  return remarks;
}

std::string Draped::outcome() const {
  if (report.stopped && !budget_spent) return "interrupted";
  return (report.stopped ? "out of budget" : outcome_of(end, limits)) +
         (end.is_pierced(limits) ? ", pierced by the body" : "") +
         (crosses_itself() ? ", cloth crosses itself" : "") +
         (crosses_others() ? ", crosses other garments" : "") +
         (end.lost() > 0 && !end.falls()
              ? fmt::format(", {} of {} parts fallen", end.lost(), end.parts.size())
              : "") +
         (loose.empty() ? "" : fmt::format(", {} of {} parts loose", loose.size(), end.parts.size())) +
         (floats() && end.finite && !end.falls() ? ", " + geometry::length_text(gap) + " off the body" : "");
}

namespace {

Json to_json(const physics::Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Where it is refined locally: how often at most.
int times_refined(const Draped& d) {
  return d.report.local() ? int(d.report.levels.size()) - 1 : d.refinements;
}

Json local_json(const Draped& d) {
  return {{"uniform_vertices", d.report.uniform_vertices}, {"ran_out", d.report.ran_out}};
}

Json to_json(const DrapeForces& f) {
  Json json{{"weight", to_json(f.weight)}, {"contact", to_json(f.contact)}};
  json["pins"] = json["bands"] = Json::array();
  for (const auto& [name, force] : f.pins)
    json["pins"].push_back({{"name", name}, {"force", to_json(force)}});
  for (const auto& [loop, tension] : f.bands) json["bands"].push_back({{"loop", loop}, {"tension", tension}});
  return json;
}

}  // namespace

Json to_json(const Draped& d) {
  const bridge::DrapeLevel& last = d.report.levels.back();
  Json levels = Json::array();
  for (const bridge::DrapeLevel& level : d.report.levels) levels.push_back(level_json(level));
  if (!d.measured) {
    Json part{{"garment", d.name},
              {"outcome", d.outcome()},
              {"subdivide", times_refined(d)},
              {"seconds", d.seconds},
              {"levels", levels}};
    if (d.report.local()) part["local"] = local_json(d);
    if (!d.written.empty()) part["written"] = d.written.string();
    return part;
  }
  Json json{{"garment", d.name},
            {"outcome", d.outcome()},
            {"converged", d.rests()},
            {"residual_force", last.settle.residual},
            {"touching", last.settle.touching},
            {"contact_depth", last.settle.deepest},
            {"face_contacts", last.settle.face_contacts},
            {"angle_defect", d.angle_defect},
            {"lines", jobs::to_json(d.lines)},
            {"gap", d.fit.on_body ? Json(d.gap) : Json(nullptr)},
            {"gap_asked", d.fit.on_body ? Json(d.wanted_gap) : Json(nullptr)},
            {"subdivide", times_refined(d)},
            {"parts", d.end.parts.size()},
            {"end", jobs::to_json(d.end)},
            {"loose_parts", d.loose},
            {"seconds", d.seconds},
            {"levels", levels},
            {"friction_rounds", d.report.friction_rounds},
            {"slip", d.report.slip},
            {"crossings", jobs::to_json(d.crossings)}};
  if (!d.loose.empty())
    json["loose"] = {{"pieces", d.loose.size()},
                     {"vertices", d.loose_parts.vertices},
                     {"area_share", d.loose_parts.area_share},
                     {"done", word_of(d.loose_parts.use)}};
  if (d.report.local()) json["local"] = local_json(d);
  if (d.placed) json["placed"] = to_json(*d.placed);
  if (!d.touches.empty()) json["touches"] = jobs::to_json(d.touches);
  if (d.self_contact) json["self_contact"] = self_contact_json(d);
  if (d.other) json["other_search"] = to_json(*d.other);
  if (d.untangled.at_start) json["untangled"] = untangled_json(d.untangled);
  if (!d.written.empty()) json["written"] = d.written.string();
  json["hem_height"] = d.hem_height ? Json(*d.hem_height) : Json();
  json["energy"] = to_json(d.report.energy);
  if (!d.report.stopped) json["forces"] = to_json(d.forces);
  if (d.starts) json["starts"] = to_json(*d.starts);
  json["fit"] = jobs::to_json(d.fit, d.fit_options);
  return json;
}

Json to_json(const DrapeJobReport& report) {
  Json json;
  if (report.garments.size() == 1) {
    json = to_json(report.garments[0]);
  } else {
    json["garments"] = Json::array();
    for (const Draped& d : report.garments) json["garments"].push_back(to_json(d));
  }
  if (report.budget_spent) json["budget_spent"] = true;
  if (report.layers) json["layers"] = to_json(*report.layers);
  return json;
}

}  // namespace furrow::jobs
