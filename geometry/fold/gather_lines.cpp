// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/gather_lines.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/property_names.h"
#include "geometry/rest/tie_length.h"

namespace furrow::geometry {
namespace {

constexpr double thread_force = 50;  ///< at twice its length [N], as an elastic band's (physics/cloth)

double distance(const Mesh& mesh, Vertex a, Vertex b) {
  return std::sqrt(CGAL::squared_distance(mesh.point(a), mesh.point(b)));
}

/// Of the cloth at rest between neighbours of a chain [m].
double rest_between(const Mesh& mesh, Vertex a, Vertex b) {
  const auto rest = find_map(mesh, attribute::rest_length);
  const Halfedge h = mesh.halfedge(a, b);
  if (!rest || h == Mesh::null_halfedge() || std::isnan((*rest)[mesh.edge(h)])) return distance(mesh, a, b);
  return (*rest)[mesh.edge(h)];
}

/// The vertices of a chain nearest to places at even distances along it, about `stitch` [m] apart.
std::vector<std::size_t> stitches(const std::vector<double>& arc, double stitch, bool closed) {
  const double length = arc.back();
  const auto count = std::max<long>(closed ? 3 : 1, std::lround(length / stitch));
  std::vector<std::size_t> places;
  for (long k = 0; k <= count; ++k) {
    const double at = length * double(k) / double(count);
    auto i = std::size_t(std::lower_bound(arc.begin(), arc.end(), at) - arc.begin());
    i = std::min(i, arc.size() - 1);
    if (i > 0 && at - arc[i - 1] < arc[i] - at) --i;
    if (places.empty() || i > places.back()) places.push_back(i);
  }
  return places;
}

/// A chain that is closed has its first vertex again at its end.
void sew_along(const Mesh& mesh, const std::vector<Index<Vertex>>& chain, double stitch, double share,
               std::vector<Strut>& threads) {
  if (chain.size() < 2) return;
  std::vector<double> arc{0};
  for (std::size_t i = 1; i < chain.size(); ++i)
    arc.push_back(arc.back() + rest_between(mesh, chain[i - 1], chain[i]));
  if (!(arc.back() > 0)) return;
  const std::vector<std::size_t> places = stitches(arc, stitch, chain.front() == chain.back());
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vertex a = chain[places[i - 1]], b = chain[places[i]];
    const double length = share * (arc[places[i]] - arc[places[i - 1]]);
    if (a != b && length > tie_length)
      threads.push_back({std::min(a, b), std::max(a, b), length, thread_force / length});
  }
}

/// The line, of these, whose thread a strut is a stitch of; -1: none. Both ends are on lines, for a later
/// line may own one of them.
int line_of_stitch(const Strut& s, const auto& line_of, std::span<const int> lines) {
  const int a = line_of[s.a], b = line_of[s.b];
  if (s.rest_length <= tie_length || a < 0 || b < 0) return -1;
  for (const int line : {a, b})
    if (std::binary_search(lines.begin(), lines.end(), line)) return line;
  return -1;
}

}  // namespace

void gather_lines(Mesh& mesh, std::span<const WrinkledLine> lines) {
  std::vector<Strut> threads;
  for (const WrinkledLine& line : lines)
    if (line.gather && line.width)
      for (const auto& chain : line.chains) sew_along(mesh, chain, *line.width / 2, *line.gather, threads);
  sew(mesh, threads);
}

std::vector<GatherThread> gather_threads(const Mesh& mesh, std::span<const int> lines) {
  std::vector<GatherThread> threads;
  const auto line_of = find_map(mesh, attribute::line);
  if (!line_of || lines.empty()) return threads;
  for (int id : lines) threads.push_back({id, {}});
  for (const Strut& s : struts(mesh)) {
    const auto at = std::ranges::find(threads, line_of_stitch(s, *line_of, lines), &GatherThread::line);
    if (at == threads.end()) continue;
    at->struts.push_back(s);
    at->rest_length += s.rest_length;
    at->length += distance(mesh, s.a, s.b);
  }
  std::erase_if(threads, [](const GatherThread& t) { return t.struts.empty(); });
  return threads;
}

std::vector<Strut> cut_undrawn_threads(Mesh& mesh, std::span<const int> lines) {
  std::vector<int> undrawn;
  for (const GatherThread& thread : gather_threads(mesh, lines))
    if (thread.draws()) undrawn.push_back(thread.line);
  if (undrawn.empty()) return {};
  const auto line_of = find_map(mesh, attribute::line).value();
  std::vector<Strut> cut, left;
  for (const Strut& s : struts(mesh)) {
    const int line = line_of_stitch(s, line_of, lines);
    (std::ranges::binary_search(undrawn, line) ? cut : left).push_back(s);
  }
  set_struts(mesh, left);
  return cut;
}

void sew(Mesh& mesh, std::span<const Strut> threads) {
  if (threads.empty()) return;
  std::vector<Strut> all = struts(mesh);
  all.insert(all.end(), threads.begin(), threads.end());
  set_struts(mesh, all);
}

}  // namespace furrow::geometry
