// SPDX-License-Identifier: MIT
#include "physics/linear/negative_pivots.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "physics/base/cancel_scope.h"
#include "physics/base/lanes.h"
#include "physics/linear/front_tree.h"

namespace furrow::physics {
namespace {

using Front = FrontTree::Front;

constexpr double asked_again_after = 1e6;  // multiplications: about a millisecond

/// A symmetric matrix by columns, of which what lies on and below the diagonal counts.
struct Square {
  int size = 0;
  std::vector<double> numbers;
  double* column(int c) { return numbers.data() + std::ptrdiff_t(c) * size; }
};

/// The columns behind k lose what the three pivots from k on explain: l D l^T, by three at a time.
FURROW_VECTOR_CLONES void subtract_pivots(Square& a, int k, const double* d) {
  const double *p = a.column(k), *q = a.column(k + 1), *r = a.column(k + 2);
  for (int c = k + 3; c < a.size; ++c) {
    const double fp = p[c] / d[0], fq = q[c] / d[1], fr = r[c] / d[2];
    double* target = a.column(c);
    for (int i = c; i < a.size; ++i) target[i] -= fp * p[i] + fq * q[i] + fr * r[i];
  }
}

/// Adds up the work and asks after each piece of it.
class Question {
 public:
  void after(double multiplications) {
    work_ += multiplications;
    if (work_ < asked_again_after) return;
    work_ = 0;
    throw_if_cancelled("factorisation");
  }

 private:
  double work_ = 0;
};

/// Eliminates the first `width` columns, by three; L D is left in them. -1: a pivot is 0 or not finite.
int eliminate(Square& a, int width, Question& question) {
  int negative = 0;
  for (int k = 0; k < width; k += 3) {
    double d[3];
    for (int j = 0; j < 3; ++j) {
      const double* own = a.column(k + j);
      d[j] = own[k + j];
      if (d[j] == 0 || !std::isfinite(d[j])) return -1;
      negative += d[j] < 0;
      for (int c = k + j + 1; c < k + 3; ++c) {
        const double factor = own[c] / d[j];
        for (int i = c; i < a.size; ++i) a.column(c)[i] -= factor * own[i];
      }
    }
    subtract_pivots(a, k, d);
    question.after(1.5 * double(a.size - k) * double(a.size - k));
  }
  return negative;
}

/// The matrix's own numbers in a front.
Square own_numbers(const Front& f, const double* value) {
  Square a{3 * (f.width + int(f.rows.size())), {}};
  a.numbers.assign(std::size_t(a.size) * std::size_t(a.size), 0.0);
  for (const FrontTree::Block& b : f.blocks) {
    for (int e = 0; e < 3; ++e) {
      for (int g = b.row == b.column ? e : 0; g < 3; ++g) {
        const int row = 3 * b.row + (b.transposed ? e : g), column = 3 * b.column + (b.transposed ? g : e);
        a.column(column)[row] = value[b.value[std::size_t(e)] + g - (b.row == b.column ? e : 0)];
      }
    }
  }
  return a;
}

/// Adds what a child left, rows behind its eliminated ones, where its runs say.
void add_child(Square& a, const Front& child, Square& left) {
  const int shift = 3 * child.width;
  for (std::size_t k = 0; k < child.runs.size(); ++k) {
    const FrontTree::Run& columns = child.runs[k];
    for (int c = 0; c < columns.length; ++c) {
      const double* source = left.column(shift + columns.from + c) + shift;
      double* target = a.column(columns.to + c);
      for (std::size_t r = k; r < child.runs.size(); ++r) {
        const FrontTree::Run& rows = child.runs[r];
        for (int i = r == k ? c : 0; i < rows.length; ++i) target[rows.to + i] += source[rows.from + i];
      }
    }
  }
}

}  // namespace

int negative_pivots(const BlockMatrix::Sparse& lower) {
  const FrontTree tree = front_tree(lower);
  std::vector<Square> left(tree.fronts.size());
  Question question;
  int negative = 0;
  for (std::size_t i = 0; i < tree.fronts.size(); ++i) {
    const Front& f = tree.fronts[i];
    Square a = own_numbers(f, lower.valuePtr());
    for (const int child : f.children) {
      add_child(a, tree.fronts[std::size_t(child)], left[std::size_t(child)]);
      left[std::size_t(child)] = {};
    }
    const int found = eliminate(a, 3 * f.width, question);
    if (found < 0) return -1;
    negative += found;
    if (!f.rows.empty()) left[i] = std::move(a);
  }
  return negative;
}

}  // namespace furrow::physics
