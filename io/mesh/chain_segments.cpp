// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/chain_segments.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace furrow::io {
namespace {

/// Segments at each vertex, and which have been used.
class Segments {
 public:
  explicit Segments(const std::vector<std::array<std::size_t, 2>>& segments) {
    std::set<std::pair<std::size_t, std::size_t>> known;
    for (const auto& [a, b] : segments) {
      if (a == b || !known.insert(std::minmax(a, b)).second) continue;
      at_[a].push_back(ends_.size());
      at_[b].push_back(ends_.size());
      ends_.push_back({a, b});
    }
    used_.resize(ends_.size(), false);
  }

  std::size_t size() const { return ends_.size(); }
  bool used(std::size_t s) const { return used_[s]; }
  const std::array<std::size_t, 2>& ends(std::size_t s) const { return ends_[s]; }
  bool is_inner(std::size_t vertex) const { return at_.at(vertex).size() == 2; }

  /// From a vertex along a segment to the next end or junction, or round to the vertex again.
  Chain follow(std::size_t vertex, std::size_t segment) {
    Chain chain{{vertex}, false};
    for (;;) {
      used_[segment] = true;
      const auto& [a, b] = ends_[segment];
      const std::size_t next = a == chain.vertices.back() ? b : a;
      if (next == vertex) {
        chain.closed = true;
        return chain;
      }
      chain.vertices.push_back(next);
      if (!is_inner(next)) return chain;
      const auto& two = at_.at(next);
      segment = two[0] == segment ? two[1] : two[0];
    }
  }

 private:
  std::map<std::size_t, std::vector<std::size_t>> at_;
  std::vector<std::array<std::size_t, 2>> ends_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<Chain> chain_segments(const std::vector<std::array<std::size_t, 2>>& input) {
  Segments segments(input);
  std::vector<Chain> chains;
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (const std::size_t end : segments.ends(s))
      if (!segments.used(s) && !segments.is_inner(end)) chains.push_back(segments.follow(end, s));
  for (std::size_t s = 0; s < segments.size(); ++s)
    if (!segments.used(s)) chains.push_back(segments.follow(segments.ends(s)[0], s));
  return chains;
}

}  // namespace furrow::io
