#include "solver/contact/methods/block_descent.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

/// Blocks of a piece: an eighth of all, so that threads share them, and enough that of those of a shell about
/// a fifth touches another piece.
int piece_size(int num_blocks) {
  constexpr int kShare = 8, kSmallest = 1024, kLargest = 8192;
  return std::clamp(num_blocks / kShare, kSmallest, kLargest);
}
constexpr double kOperationsPerBlock = 5000.0;

}  // namespace

BlockDescent::BlockDescent(const WhitenedProblem& problem)
    : white_(problem),
      problem_(problem.given),
      piece_(piece_size(problem_.num_blocks())),
      start_(problem_.num_blocks() + 1, 0),
      border_(problem_.num_blocks(), 0) {
  for (int i = 0; i < problem_.num_contacts(); ++i) {
    const int a = problem_.block_a[i], b = problem_.block_b[i];
    if (a == ContactProblem::kFixed || b == ContactProblem::kFixed || a / piece_ == b / piece_) continue;
    border_[a] = border_[b] = 1;
  }
  const auto for_each_side = [&](const auto& action) {
    for (int i = 0; i < problem_.num_contacts(); ++i) {
      const int a = problem_.block_a[i], b = problem_.block_b[i];
      if (a != ContactProblem::kFixed) action(a, i);
      if (b != ContactProblem::kFixed && b != a) action(b, i);
    }
  };
  for_each_side([&](int block, int) { ++start_[block + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  contacts_.resize(start_.back());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for_each_side([&](int block, int i) { contacts_[next[block]++] = i; });
}

/// Newton step d of one block; false if its gradient is at most `small`. Secant steps shorten it until the
/// slope along d is small or negative. The cost is convex, so it has decreased wherever the slope is not
/// positive.
bool BlockDescent::move_block(int block, double small, VecX* v, Contacts* contacts) const {
  constexpr double kFlat = 0.1;  // of the slope at t = 0
  constexpr int kMaxSecants = 4;
  auto& [D, y] = *contacts;
  const int start = start_[block], count = start_[block + 1] - start;
  auto own = v->segment<6>(6 * block);
  const Mat6& M = problem_.M[block];
  const Vec6 momentum = M * (own - problem_.v_star.segment<6>(6 * block));
  Vec6 gradient = momentum;
  for (int k = 0; k < count; ++k) {
    const int i = contacts_[start + k];
    D[k] = contact_columns(problem_, i, block);
    y[k] = relative_velocity(problem_, i, *v) + problem_.b.segment<3>(3 * i);
    gradient.noalias() -= D[k] * contact_impulse(contact_law(problem_, i), y[k]);
  }
  if (!((white_.L_inverse[block] * gradient).norm() > small)) return false;
  Mat6 H = M;
  for (int k = 0; k < count; ++k) {
    const Mat63 DG = D[k] * contact_stiffness(contact_law(problem_, contacts_[start + k]), y[k]);
    H.noalias() += DG * D[k].transpose();
  }
  const Vec6 d = -H.llt().solve(gradient);
  const double slope_start = d.dot(gradient);
  if (!(slope_start < 0.0)) return false;
  const Vec6 momentum_change = M * d;
  double t = 1.0;
  for (int secants = 0; secants < kMaxSecants; ++secants) {
    Vec6 next = momentum + t * momentum_change;
    for (int k = 0; k < count; ++k) {
      const Vec3 y_next = y[k] + t * (D[k].transpose() * d);
      next.noalias() -= D[k] * contact_impulse(contact_law(problem_, contacts_[start + k]), y_next);
    }
    const double slope = d.dot(next);
    if (slope <= -kFlat * slope_start) break;
    t *= slope_start / (slope_start - slope);
  }
  own += t * d;
  return true;
}

PrimalPoint BlockDescent::descend(const PrimalPoint& point, double small) const {
  CUPOLA_ASSERT(point.w.size() == 6 * problem_.num_blocks());
  int most_contacts = 0;
  for (int block = 0; block < problem_.num_blocks(); ++block)
    most_contacts = std::max(most_contacts, start_[block + 1] - start_[block]);
  VecX v = white_.to_v(point.w);
  std::vector<char> changed(problem_.num_blocks());  // whether the gradient of a block may have changed
  std::vector<char> moved(problem_.num_blocks());
  const auto visit = [&](int block, Contacts* contacts) {
    if (!changed[block] && !(point.gradient.segment<6>(6 * block).norm() > small)) return;
    if (!move_block(block, small, &v, contacts)) return;
    moved[block] = 1;
    for (int k = start_[block]; k < start_[block + 1]; ++k) {
      for (const int other : {problem_.block_a[contacts_[k]], problem_.block_b[contacts_[k]]})
        if (other != ContactProblem::kFixed) changed[other] = 1;
    }
  };
  // A block inside a piece touches, reads and marks blocks of that piece only.
  const int nb = problem_.num_blocks();
  const auto inside = [&](bool forward) {
    share_loop(kOperationsPerBlock * nb, (nb + piece_ - 1) / piece_, [&](int piece) {
      Contacts contacts{std::vector<Mat63>(most_contacts), std::vector<Vec3>(most_contacts)};
      const int first = piece * piece_, last = std::min(nb, first + piece_);
      for (int k = first; k < last; ++k) {
        const int block = forward ? k : first + last - 1 - k;
        if (!border_[block]) visit(block, &contacts);
      }
    });
  };
  Contacts contacts{std::vector<Mat63>(most_contacts), std::vector<Vec3>(most_contacts)};
  const auto between = [&](int block) {
    if (border_[block]) visit(block, &contacts);
  };
  inside(true);
  for (int block = 0; block < nb; ++block) between(block);
  for (int block = nb - 1; block >= 0; --block) between(block);
  inside(false);
  constexpr double kRounding = 1e-15;
  VecX w = point.w;
  for (int block = 0; block < nb; ++block)
    if (moved[block])
      w.segment<6>(6 * block) = white_.times_L_transposed(block, Vec6(v.segment<6>(6 * block)));
  PrimalPoint next = primal_point(white_, std::move(w));
  return next.cost <= point.cost * (1.0 + kRounding) ? next : point;
}

}  // namespace cupola
