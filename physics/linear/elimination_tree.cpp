// SPDX-License-Identifier: MIT
#include "physics/linear/elimination_tree.h"

#include <algorithm>

namespace furrow::physics {
namespace {

using Lists = std::vector<std::vector<int>>;

}  // namespace

std::vector<int> elimination_tree(std::span<const std::vector<int>> below) {
  const int n = int(below.size());
  Lists before(below.size());
  for (int c = 0; c < n; ++c)
    for (const int r : below[c]) before[r].push_back(c);
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (int r = 0; r < n; ++r) {
    for (int c : before[r]) {
      while (ancestor[c] >= 0 && ancestor[c] != r) {
        const int next = ancestor[c];
        ancestor[c] = r;
        c = next;
      }
      if (ancestor[c] < 0 && c != r) ancestor[c] = parent[c] = r;
    }
  }
  return parent;
}

std::vector<int> postorder(std::span<const int> parent) {
  const int n = int(parent.size());
  Lists children(parent.size());
  std::vector<int> stack, place(n, -1);
  for (int i = n - 1; i >= 0; --i) {
    if (parent[i] < 0) stack.push_back(i);
    if (parent[i] >= 0) children[parent[i]].push_back(i);  // the last one first
  }
  int next = n;  // from the roots downwards: a node, then its children from the last to the first
  std::reverse(stack.begin(), stack.end());
  while (!stack.empty()) {
    const int i = stack.back();
    stack.pop_back();
    place[i] = --next;
    for (auto c = children[i].rbegin(); c != children[i].rend(); ++c) stack.push_back(*c);
  }
  return place;
}

}  // namespace furrow::physics
