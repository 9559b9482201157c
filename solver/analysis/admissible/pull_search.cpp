#include "solver/analysis/admissible/pull_search.hpp"

#include <algorithm>

namespace cupola {

PullSearch::PullSearch(PullSolve below, PullSolve above) {
  if (below.pull <= 0.0) std::swap(below, above);
  moving = std::move(below);
  admissible = std::move(above);
}

std::pair<double, double> PullSearch::open_gaps() const {
  const auto& [least, greatest] = *undecided_;
  const bool moves_below = moving.value < admissible.value;
  return {std::abs((moves_below ? least : greatest) - moving.value),
          std::abs((moves_below ? greatest : least) - admissible.value)};
}

bool PullSearch::is_closed(double enough) const {
  if (width() <= enough) return true;
  if (!undecided_) return false;
  // Closing in further would gain less than half of what stays undecided.
  const auto [from_moving, from_admissible] = open_gaps();
  return std::max(from_moving, from_admissible) <=
         std::max(enough, 0.5 * (undecided_->second - undecided_->first));
}

void PullSearch::leave_out(double value) {
  if (!undecided_) undecided_ = {value, value};
  undecided_ = {std::min(undecided_->first, value), std::max(undecided_->second, value)};
}

void PullSearch::include(PullSolve solve) {
  const bool moves = solve.pull > 0.0;
  bisect_ = moves ? solve.pull > 0.5 * moving.pull : overshot_;
  overshot_ = !moves;
  (moves ? moving : admissible) = std::move(solve);
  const auto [low, high] = std::minmax(moving.value, admissible.value);
  if (undecided_ && !(undecided_->first > low && undecided_->second < high)) undecided_.reset();
}

double PullSearch::next(double enough) const {
  if (undecided_) {
    const auto [from_moving, from_admissible] = open_gaps();
    const double outward = admissible.value > moving.value ? 0.5 : -0.5;
    return from_moving >= from_admissible ? moving.value + outward * from_moving
                                          : admissible.value - outward * from_admissible;
  }
  const double towards = admissible.value > moving.value ? 1.0 : -1.0;
  const double slope = (admissible.pull - moving.pull) / (admissible.value - moving.value);
  const double ahead = -moving.pull / slope * towards;
  if (bisect_ || !std::isfinite(slope) || !(ahead > 0.0 && ahead < width())) return middle();
  // At the root itself rounding decides. Half the width before it the structure moves; from there, half the
  // width behind it is the other end.
  const double aim = ahead > enough ? ahead - 0.45 * enough : ahead + 0.45 * enough;
  return moving.value + towards * std::min(aim, width() - 0.45 * enough);
}

}  // namespace cupola
