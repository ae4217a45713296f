// SPDX-License-Identifier: MIT
#include "physics/linear/block_cholesky.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "physics/base/cancel_scope.h"
#include "physics/base/lanes.h"
#include "physics/base/progress.h"
#include "physics/linear/dense_front.h"
#include "physics/linear/front_tree.h"

namespace furrow::physics {
namespace {

constexpr double least_shared_numbers = 5e4;  // numbers to move that are worth waking threads
constexpr double most_work = 1.5;             // with an order for another matrix, over that one's
constexpr double asked_after = 1e6;           // multiplications: a fraction of a millisecond

/// Rows of a front's update.
int rest_of(const FrontTree::Front& f) { return 3 * int(f.rows.size()); }
/// Lines of the cache that a column of n numbers takes.
template <class Real>
int lines_of(int n) {
  return padded<Real>(n) / line_of<Real>;
}
/// Lines of a lower triangle with n rows; room for the tiles that end behind it.
template <class Real>
std::size_t lines(int n) {
  return std::size_t(n) * std::size_t(lines_of<Real>(n));
}

/// Calls work(begin, end) on pieces of n columns, by three.
template <class Work>
void share_columns(int n, double numbers, ThreadPool* pool, Work work) {
  if (!pool || numbers < least_shared_numbers) return work(0, n);
  const int pieces = 4 * pool->threads();
  pool->share(pieces, [&](int i, int) { work(n / 3 * i / pieces * 3, n / 3 * (i + 1) / pieces * 3); });
}

/// Adds a child's update (lower triangle, by columns of `stride`) to some columns of its parent: those whose
/// place is in [begin, end) go to target + place * target_stride, rows by their place.
template <class Real>
struct ExtendAdd {
  std::span<const FrontTree::Run> runs;
  const Real* update;
  int stride;
  Real* target;
  int target_stride, begin, end;
};

template <class Real>
FURROW_INLINE void add(const Real* source, Real* target, int length) {
  typedef Real Some __attribute__((vector_size(32), may_alias));
  constexpr int some = int(sizeof(Some) / sizeof(Real));
  int i = 0;
  for (; i + some <= length; i += some) {
    Some sum, more;
    std::memcpy(&sum, target + i, sizeof sum);
    std::memcpy(&more, source + i, sizeof more);
    sum += more;
    std::memcpy(target + i, &sum, sizeof sum);
  }
  for (; i < length; ++i) target[i] += source[i];
}

template <class Real>
FURROW_INLINE void add_extended(const ExtendAdd<Real>& e) {
  for (std::size_t k = 0; k < e.runs.size(); ++k) {
    const FrontTree::Run& columns = e.runs[k];
    const int end = std::min(columns.length, e.end - columns.to);
    for (int c = std::max(0, e.begin - columns.to); c < end; ++c) {
      const Real* source = e.update + std::ptrdiff_t(columns.from + c) * e.stride;
      Real* target = e.target + std::ptrdiff_t(columns.to + c) * e.target_stride;
      add(source + columns.from + c, target + columns.to + c, columns.length - c);
      for (std::size_t r = k + 1; r < e.runs.size(); ++r)
        add(source + e.runs[r].from, target + e.runs[r].to, e.runs[r].length);
    }
  }
}

FURROW_VECTOR_CLONES void extend_add(const ExtendAdd<double>& e) { add_extended(e); }
FURROW_VECTOR_CLONES void extend_add(const ExtendAdd<float>& e) { add_extended(e); }

/// Whether a factorisation is cancelled. The thread that called asks, the others learn of it.
class Breaker {
 public:
  /// After each front, in any thread; 0 is the one that called. Throws Cancelled in that one.
  void done(const FrontTree::Front& f, int thread) {
    if (thread != 0) return;
    const double width = 3.0 * f.width, height = width + rest_of(f);
    work_ += width * height * height;
    if (work_ < asked_after) return;
    work_ = 0;
    stopped_ = is_cancelled();
    if (stopped_) throw Cancelled("factorisation: cancelled");
  }
  bool stopped() const { return stopped_; }

 private:
  double work_ = 0;  // since it was asked
  std::atomic<bool> stopped_ = false;
};

/// The factors of a tree's matrix in numbers of one kind.
template <class Real>
class FrontFactors {
 public:
  using Sparse = BlockMatrix::Sparse;
  /// The tree must outlive this object, or the next call.
  void analyse(const FrontTree& tree);
  bool factorise(const Sparse& lower, double shift, ThreadPool* pool);
  void solve(Eigen::VectorXd& b, ThreadPool* pool) const;

 private:
  /// Numbers in whole lines of the cache.
  struct alignas(64) Line {
    Real number[line_of<Real>];
  };
  using Store = std::vector<Line>;
  /// Where a front's numbers begin [lines]: its columns of L; what it leaves to its parent, lower triangle,
  /// in held_ or in the stack of the thread that does its branch.
  struct Place {
    std::size_t panel = 0, update = 0;
    bool held = false;
  };
  struct Values {  // of the matrix
    const double* value;
    double shift;
  };
  FrontOf<Real> dense(int front) const;
  void place_updates();
  Real* update(int front, Store& stack);
  void assemble(int front, const Values& values, Store& stack, int begin, int end);
  void add_children(int front, Store& stack, Real* target, int stride, int begin, int end);
  bool eliminate(int front, const Values& values, Store& stack, ThreadPool* pool);
  void forward(int front, std::vector<Real>& x, std::vector<Real>& left) const;
  void backward(int front, std::vector<Real>& x) const;
  const std::vector<FrontTree::Front>& fronts() const { return tree_->fronts; }

  const FrontTree* tree_ = nullptr;
  FrontDivision division_;
  int threads_ = 0;  // of division_
  std::vector<Place> places_;
  std::vector<std::size_t> left_;  // of each front what its rows keep during a solution: where it begins
  Store factor_, held_;
  std::vector<Store> stacks_;  // one a thread
};

template <class Real>
FrontOf<Real> FrontFactors<Real>::dense(int front) const {
  const FrontTree::Front& f = fronts()[std::size_t(front)];
  const int height = 3 * f.width + rest_of(f);
  return {const_cast<Real*>(factor_[places_[std::size_t(front)].panel].number), height, 3 * f.width,
          padded<Real>(height)};
}

template <class Real>
void FrontFactors<Real>::analyse(const FrontTree& tree) {
  tree_ = &tree;
  places_.assign(fronts().size(), {});
  left_.assign(1, 0);
  threads_ = 0;
  std::size_t lines = 0;
  for (std::size_t i = 0; i < fronts().size(); ++i) {
    const FrontTree::Front& f = fronts()[i];
    places_[i].panel = lines;
    lines += std::size_t(lines_of<Real>(3 * f.width + rest_of(f))) * std::size_t(3 * f.width) + 1;
    left_.push_back(left_.back() + std::size_t(rest_of(f)));
  }
  factor_.assign(lines, {});
}

/// What a branch's fronts leave lies on two stacks that take turns from one level of the tree to the next: a
/// front's children are the topmost ones of the other stack.
template <class Real>
void FrontFactors<Real>::place_updates() {
  std::vector<char> level(fronts().size());
  for (std::size_t i = fronts().size(); i-- > 0;) {
    const int parent = fronts()[i].parent;
    level[i] = parent < 0 ? 0 : char(1 - level[std::size_t(parent)]);
    places_[i].held = false;
  }
  for (const int i : division_.trunk) places_[std::size_t(i)].held = true;
  for (const auto& branch : division_.branches) places_[std::size_t(branch[1] - 1)].held = true;
  std::size_t top[2] = {}, most[2] = {}, held = 0;
  for (std::size_t i = 0; i < fronts().size(); ++i) {
    const FrontTree::Front& f = fronts()[i];
    std::size_t& end = places_[i].held ? held : top[int(level[i])];
    places_[i].update = end;
    end += lines<Real>(rest_of(f));
    most[int(level[i])] = std::max(most[int(level[i])], top[int(level[i])]);
    for (const int child : f.children)
      if (!places_[std::size_t(child)].held)
        top[1 - level[i]] -= lines<Real>(rest_of(fronts()[std::size_t(child)]));
  }
  for (std::size_t i = 0; i < fronts().size(); ++i)
    if (!places_[i].held && level[i] == 1) places_[i].update += most[0];
  held_.resize(held + 1);
  stacks_.assign(std::size_t(threads_), Store(most[0] + most[1] + 1));
}

template <class Real>
Real* FrontFactors<Real>::update(int front, Store& stack) {
  const Place& place = places_[std::size_t(front)];
  return (place.held ? held_ : stack)[place.update].number;
}

/// Adds what the children left to the columns whose place is in [begin, end).
template <class Real>
void FrontFactors<Real>::add_children(int front, Store& stack, Real* target, int stride, int begin, int end) {
  for (const int child : fronts()[std::size_t(front)].children) {
    const FrontTree::Front& c = fronts()[std::size_t(child)];
    extend_add(
        ExtendAdd<Real>{c.runs, update(child, stack), padded<Real>(rest_of(c)), target, stride, begin, end});
  }
}

/// Columns [begin, end) of a front, whole blocks.
template <class Real>
void FrontFactors<Real>::assemble(int front, const Values& values, Store& stack, int begin, int end) {
  const FrontOf<Real> a = dense(front);
  std::fill(a.panel + std::ptrdiff_t(begin) * a.stride, a.panel + std::ptrdiff_t(end) * a.stride, Real(0));
  for (const FrontTree::Block& b : fronts()[std::size_t(front)].blocks) {
    if (3 * b.column < begin || 3 * b.column >= end) continue;
    Real* target = a.panel + 3 * b.row + 3 * std::ptrdiff_t(b.column) * a.stride;
    const std::ptrdiff_t down = b.transposed ? a.stride : 1, across = b.transposed ? 1 : a.stride;
    for (int e = 0; e < 3; ++e) {
      const int first = b.row == b.column ? e : 0;
      for (int g = first; g < 3; ++g)
        target[g * down + e * across] = Real(values.value[b.value[e] + g - first]);
    }
  }
  for (std::ptrdiff_t c = begin; c < end; ++c) a.panel[c + c * a.stride] += Real(values.shift);
  add_children(front, stack, a.panel, a.stride, begin, end);
}

template <class Real>
bool FrontFactors<Real>::eliminate(int front, const Values& values, Store& stack, ThreadPool* pool) {
  const FrontOf<Real> a = dense(front);
  const int rest = a.height - a.width;
  share_columns(a.width, double(a.width) * a.height, pool,
                [&](int begin, int end) { assemble(front, values, stack, begin, end); });
  if (!physics::eliminate(a, pool)) return false;
  if (rest == 0) return true;
  Real* left = update(front, stack);
  negative_square(a, left, padded<Real>(rest), pool);
  Real* target = left - a.width - std::ptrdiff_t(a.width) * padded<Real>(rest);
  share_columns(rest, 0.5 * rest * rest, pool, [&](int begin, int end) {
    add_children(front, stack, target, padded<Real>(rest), a.width + begin, a.width + end);
  });
  return true;
}

template <class Real>
bool FrontFactors<Real>::factorise(const Sparse& lower, double shift, ThreadPool* pool) {
  const int threads = pool ? pool->threads() : 1;
  if (threads_ != threads) {
    division_ = divide_fronts(fronts(), threads_ = threads);
    place_updates();
  }
  const Values values{lower.valuePtr(), shift};
  std::vector<char> good(division_.branches.size(), true);
  Breaker breaker;
  const auto eliminated = [&](int front, int thread, ThreadPool* sharing) {
    const bool definite = eliminate(front, values, stacks_[std::size_t(thread)], sharing);
    breaker.done(fronts()[std::size_t(front)], thread);
    return definite;
  };
  const auto work = [&](int branch, int thread) {
    const auto [begin, end] = division_.branches[std::size_t(branch)];
    bool all = true;
    for (int i = begin; i < end && all && !breaker.stopped(); ++i) all = eliminated(i, thread, nullptr);
    good[std::size_t(branch)] = all;
  };
  if (pool)
    pool->share(int(good.size()), work);
  else
    for (std::size_t i = 0; i < good.size(); ++i) work(int(i), 0);
  return std::all_of(good.begin(), good.end(), [](char g) { return g != 0; }) &&
         std::all_of(division_.trunk.begin(), division_.trunk.end(),
                     [&](int i) { return eliminated(i, 0, pool); });
}

/// What a front's rows lose goes up the tree from front to front: a branch writes nothing beyond itself.
template <class Real>
void FrontFactors<Real>::forward(int front, std::vector<Real>& x, std::vector<Real>& left) const {
  const FrontOf<Real> a = dense(front);
  const FrontTree::Front& f = fronts()[std::size_t(front)];
  thread_local std::vector<Real> own;
  own.assign(std::size_t(a.stride), Real(0));
  std::copy_n(x.data() + 3 * f.first, a.width, own.begin());
  for (const int child : f.children) {
    const Real* lost = left.data() + left_[std::size_t(child)];
    for (const FrontTree::Run& run : fronts()[std::size_t(child)].runs)
      for (int i = 0; i < run.length; ++i) own[std::size_t(run.to + i)] += lost[run.from + i];
  }
  substitute_forward(a, own.data());
  std::copy_n(own.begin(), a.width, x.data() + 3 * f.first);
  std::copy_n(own.begin() + a.width, a.height - a.width,
              left.begin() + std::ptrdiff_t(left_[std::size_t(front)]));
}

template <class Real>
void FrontFactors<Real>::backward(int front, std::vector<Real>& x) const {
  const FrontOf<Real> a = dense(front);
  const FrontTree::Front& f = fronts()[std::size_t(front)];
  thread_local std::vector<Real> own;
  own.assign(std::size_t(a.stride), Real(0));
  std::copy_n(x.data() + 3 * f.first, a.width, own.begin());
  for (std::size_t r = 0; r < f.rows.size(); ++r)
    std::copy_n(x.data() + 3 * f.rows[r], 3, own.begin() + a.width + 3 * std::ptrdiff_t(r));
  substitute_backward(a, own.data());
  std::copy_n(own.begin(), a.width, x.data() + 3 * f.first);
}

template <class Real>
void FrontFactors<Real>::solve(Eigen::VectorXd& b, ThreadPool* pool) const {
  std::vector<Real> x(std::size_t(b.size())), left(left_.back());
  for (std::size_t i = 0; i < tree_->position.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      x[3 * std::size_t(tree_->position[i]) + k] = Real(b[Eigen::Index(3 * i + k)]);
  const auto each_branch = [&](const auto& work) {
    const int n = int(division_.branches.size());
    const auto branch = [&](int i, int) { work(division_.branches[std::size_t(i)]); };
    if (pool) return pool->share(n, branch);
    for (int i = 0; i < n; ++i) branch(i, 0);
  };
  each_branch([&](const std::array<int, 2>& range) {
    for (int i = range[0]; i < range[1]; ++i) forward(i, x, left);
  });
  for (const int i : division_.trunk) forward(i, x, left);
  for (auto i = division_.trunk.rbegin(); i != division_.trunk.rend(); ++i) backward(*i, x);
  each_branch([&](const std::array<int, 2>& range) {
    for (int i = range[1]; i-- > range[0];) backward(i, x);
  });
  for (std::size_t i = 0; i < tree_->position.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      b[Eigen::Index(3 * i + k)] = double(x[3 * std::size_t(tree_->position[i]) + k]);
}

}  // namespace

struct BlockCholesky::Factors {
  template <class Real>
  struct Kind {
    FrontFactors<Real> factors;
    bool fits = false;  // the tree; it is fitted when it is first needed
  };
  FrontTree tree;
  std::vector<int> order;   // that was found last, and
  double ordered_work = 0;  // the work of the tree for which it was
  Kind<double> exact;
  Kind<float> single;
  bool is_single = false;  // those made last
  template <class Real>
  FrontFactors<Real>& of(Kind<Real>& kind) {
    if (!std::exchange(kind.fits, true)) kind.factors.analyse(tree);
    return kind.factors;
  }
  void take(FrontTree other) {
    tree = std::move(other);
    exact.fits = single.fits = false;
  }
};

BlockCholesky::BlockCholesky() : factors_(std::make_unique<Factors>()) {}
BlockCholesky::~BlockCholesky() = default;
BlockCholesky::BlockCholesky(BlockCholesky&&) noexcept = default;
BlockCholesky& BlockCholesky::operator=(BlockCholesky&&) noexcept = default;

void BlockCholesky::analyse(const Sparse& lower) {
  factors_->take(front_tree(lower));
  factors_->order = factors_->tree.position;
  factors_->ordered_work = factors_->tree.work;
}

bool BlockCholesky::analyse_like(const Sparse& lower) {
  FrontTree tree = front_tree(lower, factors_->order);
  if (tree.work > most_work * factors_->ordered_work) return false;
  factors_->take(std::move(tree));
  return true;
}

bool BlockCholesky::factorise(const Sparse& lower, double shift, ThreadPool* pool) {
  factors_->is_single = false;
  return factors_->of(factors_->exact).factorise(lower, shift, pool);
}

bool BlockCholesky::factorise_single(const Sparse& lower, ThreadPool* pool) {
  factors_->is_single = true;
  return factors_->of(factors_->single).factorise(lower, 0, pool);
}

void BlockCholesky::solve(Eigen::VectorXd& b, ThreadPool* pool) const {
  if (factors_->is_single)
    factors_->single.factors.solve(b, pool);
  else
    factors_->exact.factors.solve(b, pool);
}

}  // namespace furrow::physics
