// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

#include "geometry/mesh/measures.h"

namespace furrow::jobs {
namespace {

constexpr double torn = 1;              // strain
constexpr double same_strain = 0.05;    // what is nearer tells no end from another
constexpr double least_told = 5e-5;     // m
constexpr std::size_t most_parts = 10;  // listed in a report
constexpr double infinite = std::numeric_limits<double>::infinity();

double number(double value) { return std::isnan(value) ? infinite : value; }

Json part_json(const PartEnd& p) {
  return {{"name", p.name}, {"fallen", p.fallen}, {"lost", p.lost}, {"held", p.held}};
}

}  // namespace

bool EndFacts::rests(const EndLimits& limits) const {
  return residual && settled && *residual <= limits.residual;
}

bool EndFacts::falls() const { return !parts.empty() && lost() == parts.size(); }

bool EndFacts::is_torn() const { return strain && !(*strain <= torn); }

bool EndFacts::is_pierced(const EndLimits& limits) const {
  return body && !(body->depth <= limits.penetration);
}

std::size_t EndFacts::lost() const {
  return std::size_t(std::count_if(parts.begin(), parts.end(), [](const PartEnd& p) { return p.lost; }));
}

double EndFacts::fallen() const {
  double most = 0;
  for (const PartEnd& p : parts) most = std::max(most, number(p.fallen));
  return most;
}

Badness badness_of(const EndFacts& e, const EndLimits& limits) {
  const bool moves = !e.residual;
  const double residual = moves ? 0 : std::max(number(*e.residual), limits.residual),
               strain = number(e.strain.value_or(0));
  const std::size_t pierced = e.body ? e.body->pierced_faces : 0;
  return {double(!e.finite),
          double(e.is_torn()),
          double(std::max(e.crossings, limits.crossings) - limits.crossings),
          e.is_pierced(limits) ? double(std::max<std::size_t>(1, pierced)) : 0,
          double(e.lost()),
          moves || e.rests(limits) ? 0 : residual,
          double(e.crossings),
          double(pierced),
          std::floor(std::max(0.0, strain) / same_strain)};
}

bool succeeds(const EndFacts& end, const EndLimits& limits) {
  const Badness badness = badness_of(end, limits);
  return std::all_of(badness.begin(), badness.begin() + 6, [](double b) { return b == 0; });
}

std::string outcome_of(const EndFacts& e, const EndLimits& limits) {
  if (!e.finite) return "numerical failure";
  if (e.is_torn()) return "torn";
  if (e.falls()) return "falls";
  if (!e.residual) return "";
  return e.rests(limits) ? "at rest" : e.blocked ? "blocked" : "not at rest";
}

std::string words_of_piercing(const BodyEnd& body) {
  if (body.pierced_faces == 0) return "";
  return fmt::format(
      "the body comes through {} face{}, by {}", body.pierced_faces, body.pierced_faces == 1 ? "" : "s",
      body.depth < least_told ? "less than 0.1 mm" : "up to " + geometry::length_text(body.depth));
}

Json to_json(const EndFacts& e) {
  Json json{{"finite", e.finite}, {"crossings", e.crossings}, {"blocked", e.blocked}};
  json["strain_p99"] = e.strain ? Json(*e.strain) : Json();
  json["residual_force"] = e.residual ? Json(*e.residual) : Json();
  json["body"] = e.body ? Json{{"pierced_faces", e.body->pierced_faces},
                               {"vertices_inside", e.body->vertices_inside},
                               {"depth", e.body->depth},
                               {"gap", e.body->gap}}
                        : Json();
  if (e.parts.empty()) return json;
  json["fallen"] = e.fallen();
  json["parts_lost"] = e.lost();
  std::vector<PartEnd> told = e.parts;
  const auto worse = [](const PartEnd& a, const PartEnd& b) {
    return std::tuple(a.lost, a.held, a.fallen) > std::tuple(b.lost, b.held, b.fallen);
  };
  std::stable_sort(told.begin(), told.end(), worse);
  if (told.size() > most_parts) told.resize(most_parts);
  json["parts"] = Json::array();
  for (const PartEnd& p : told) json["parts"].push_back(part_json(p));
  return json;
}

}  // namespace furrow::jobs
