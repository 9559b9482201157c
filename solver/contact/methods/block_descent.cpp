#include "solver/contact/methods/block_descent.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

using Vec6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr int kPiece = 8192;  // blocks; of those of a shell about a tenth touches another piece
constexpr double kOperationsPerBlock = 5000.0;

}  // namespace

BlockDescent::BlockDescent(const ContactProblem& whitened)
    : problem_(whitened), start_(whitened.num_blocks() + 1, 0), border_(whitened.num_blocks(), 0) {
  for (int i = 0; i < problem_.num_contacts(); ++i) {
    const int a = problem_.block_a[i], b = problem_.block_b[i];
    if (a == ContactProblem::kFixed || b == ContactProblem::kFixed || a / kPiece == b / kPiece) continue;
    border_[a] = border_[b] = 1;
  }
  const auto for_each_side = [&](const auto& action) {
    for (int i = 0; i < problem_.num_contacts(); ++i) {
      for (const int block : {problem_.block_a[i], problem_.block_b[i]})
        if (block != ContactProblem::kFixed) action(block, i);
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
bool BlockDescent::move_block(int block, double small, VecX* w, std::vector<Vec3>* y) const {
  constexpr double kFlat = 0.1;  // of the slope at t = 0
  constexpr int kMaxSecants = 4;
  const auto column = [&](int i) -> const Mat63& {
    return problem_.block_a[i] == block ? problem_.D_a[i] : problem_.D_b[i];
  };
  const int start = start_[block], count = start_[block + 1] - start;
  auto own = w->segment<6>(6 * block);
  const Vec6 momentum = own - problem_.v_star.segment<6>(6 * block);
  Vec6 gradient = momentum;
  for (int k = 0; k < count; ++k) {
    const int i = contacts_[start + k];
    (*y)[k] = relative_velocity(problem_, i, *w) + problem_.b.segment<3>(3 * i);
    gradient.noalias() -= column(i) * contact_impulse(contact_law(problem_, i), (*y)[k]);
  }
  if (!(gradient.norm() > small)) return false;
  Mat6 H = Mat6::Identity();
  for (int k = 0; k < count; ++k) {
    const int i = contacts_[start + k];
    const Mat63 DG = column(i) * contact_stiffness(contact_law(problem_, i), (*y)[k]);
    H.noalias() += DG * column(i).transpose();
  }
  const Vec6 d = -H.llt().solve(gradient);
  const double slope_start = d.dot(gradient);
  if (!(slope_start < 0.0)) return false;
  double t = 1.0;
  for (int secants = 0; secants < kMaxSecants; ++secants) {
    Vec6 next = momentum + t * d;
    for (int k = 0; k < count; ++k) {
      const int i = contacts_[start + k];
      const Vec3 y_next = (*y)[k] + t * (column(i).transpose() * d);
      next.noalias() -= column(i) * contact_impulse(contact_law(problem_, i), y_next);
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
  VecX w = point.w;
  std::vector<char> changed(problem_.num_blocks());  // whether the gradient of a block may have changed
  const auto visit = [&](int block, std::vector<Vec3>* y) {
    if (!changed[block] && !(point.gradient.segment<6>(6 * block).norm() > small)) return;
    if (!move_block(block, small, &w, y)) return;
    for (int k = start_[block]; k < start_[block + 1]; ++k) {
      for (const int other : {problem_.block_a[contacts_[k]], problem_.block_b[contacts_[k]]})
        if (other != ContactProblem::kFixed) changed[other] = 1;
    }
  };
  // A block inside a piece touches, reads and marks blocks of that piece only.
  const int nb = problem_.num_blocks();
  const auto inside = [&](bool forward) {
    share_loop(kOperationsPerBlock * nb, (nb + kPiece - 1) / kPiece, [&](int piece) {
      std::vector<Vec3> y(most_contacts);
      const int first = piece * kPiece, last = std::min(nb, first + kPiece);
      for (int k = first; k < last; ++k) {
        const int block = forward ? k : first + last - 1 - k;
        if (!border_[block]) visit(block, &y);
      }
    });
  };
  std::vector<Vec3> y(most_contacts);
  const auto between = [&](int block) {
    if (border_[block]) visit(block, &y);
  };
  inside(true);
  for (int block = 0; block < nb; ++block) between(block);
  for (int block = nb - 1; block >= 0; --block) between(block);
  inside(false);
  constexpr double kRounding = 1e-15;
  PrimalPoint next = primal_point(problem_, std::move(w));
  return next.cost <= point.cost * (1.0 + kRounding) ? next : point;
}

}  // namespace cupola
