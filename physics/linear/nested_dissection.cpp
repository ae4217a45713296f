// SPDX-License-Identifier: MIT
#include "physics/linear/nested_dissection.h"

#include <metis.h>

#include <mutex>
#include <new>
#include <numeric>

#include "physics/base/cancel_scope.h"

namespace furrow::physics {
namespace {

constexpr std::size_t in_one_piece = 20000;  // nodes that METIS orders without a question: 0.2 s

/// The neighbours of node i are next[first[i]] to next[first[i + 1]].
struct Graph {
  std::vector<idx_t> first, next;
  std::size_t size() const { return first.size() - 1; }
};

Graph graph_of(const ColumnRows& below) {
  Graph g;
  const int n = below.columns();
  g.first.assign(std::size_t(n) + 1, 0);
  for (int c = 0; c < n; ++c) {
    g.first[std::size_t(c) + 1] += idx_t(below.of(c).size());
    for (const int r : below.of(c)) ++g.first[std::size_t(r) + 1];
  }
  std::partial_sum(g.first.begin(), g.first.end(), g.first.begin());
  std::vector<idx_t> end(g.first.begin(), g.first.end() - 1);
  g.next.resize(std::size_t(g.first.back()));
  for (int c = 0; c < n; ++c) {
    for (const int r : below.of(c)) {
      g.next[std::size_t(end[std::size_t(c)]++)] = r;
      g.next[std::size_t(end[std::size_t(r)]++)] = c;
    }
  }
  return g;
}

/// The part of the graph whose nodes are in that part, and which nodes they are.
struct Part {
  Graph graph;
  std::vector<int> nodes;
};

Part part_of(const Graph& g, const std::vector<idx_t>& part, idx_t which) {
  Part result;
  std::vector<idx_t> index(g.size(), -1);
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (part[i] != which) continue;
    index[i] = idx_t(result.nodes.size());
    result.nodes.push_back(int(i));
  }
  result.graph.first.push_back(0);
  for (const int i : result.nodes) {
    for (idx_t k = g.first[std::size_t(i)]; k < g.first[std::size_t(i) + 1]; ++k) {
      const idx_t neighbour = index[std::size_t(g.next[std::size_t(k)])];
      if (neighbour >= 0) result.graph.next.push_back(neighbour);
    }
    result.graph.first.push_back(idx_t(result.graph.next.size()));
  }
  return result;
}

struct Options {
  idx_t values[METIS_NOPTIONS];
  Options() {
    METIS_SetDefaultOptions(values);
    values[METIS_OPTION_SEED] = 1;
    values[METIS_OPTION_COMPRESS] = 0;  // vertices of a mesh have no twins
  }
};

/// METIS draws from rand(): one call at a time.
std::mutex& random_numbers() {
  static std::mutex mutex;
  return mutex;
}

std::vector<int> ordered_by_metis(Graph& g) {
  Options options;
  idx_t n = idx_t(g.size());
  std::vector<idx_t> order(g.size()), found(g.size());
  const std::lock_guard lock(random_numbers());
  if (METIS_NodeND(&n, g.first.data(), g.next.data(), nullptr, options.values, order.data(), found.data()) !=
      METIS_OK)
    throw std::bad_alloc();
  return {found.begin(), found.end()};
}

/// Of each node 0 or 1, its side, or 2: it separates them.
std::vector<idx_t> separated(Graph& g) {
  Options options;
  idx_t n = idx_t(g.size()), size = 0;
  std::vector<idx_t> part(g.size());
  const std::lock_guard lock(random_numbers());
  if (METIS_ComputeVertexSeparator(&n, g.first.data(), g.next.data(), nullptr, options.values, &size,
                                   part.data()) != METIS_OK)
    throw std::bad_alloc();
  return part;
}

/// The place of each node. Large graphs are cut in two by hand, so that there are questions in between.
std::vector<int> order(Graph& g) {
  throw_if_cancelled("nested_dissection");
  std::vector<int> place(g.size());
  std::iota(place.begin(), place.end(), 0);
  if (g.next.empty()) return place;  // nothing is joined
  if (g.size() <= in_one_piece) return ordered_by_metis(g);
  const std::vector<idx_t> part = separated(g);
  int begin = 0;
  for (const idx_t side : {0, 1}) {
    Part half = part_of(g, part, side);
    if (half.nodes.size() == g.size()) return ordered_by_metis(g);  // no cut was found
    const std::vector<int> own = order(half.graph);
    for (std::size_t i = 0; i < own.size(); ++i) place[std::size_t(half.nodes[i])] = begin + own[i];
    begin += int(own.size());
  }
  for (std::size_t i = 0; i < g.size(); ++i)
    if (part[i] == 2) place[i] = begin++;
  return place;
}

}  // namespace

std::vector<int> nested_dissection(const ColumnRows& below) {
  Graph g = graph_of(below);
  return order(g);
}

}  // namespace furrow::physics
