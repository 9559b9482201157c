#include "solver/analysis/statics/length_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

struct Value {
  double x = 0.0, f = 0.0;
};

using Function = std::function<std::optional<double>(double)>;

/// Where between a and b to look next, as a share of the way from a: inverse quadratic interpolation through
/// a, b and the argument c tried before where Chandrupatla's criterion trusts it, else the middle.
double next_share(const Value& a, const Value& b, const Value& c) {
  const double xi = (a.x - b.x) / (c.x - b.x), phi = (a.f - b.f) / (c.f - b.f);
  if (!(1.0 - std::sqrt(1.0 - xi) < phi && phi < std::sqrt(xi))) return 0.5;
  const double alpha = (c.x - a.x) / (b.x - a.x);
  return a.f / (a.f - b.f) * c.f / (c.f - b.f) - alpha * a.f / (c.f - a.f) * b.f / (b.f - c.f);
}

/// A root between two values of opposite sign. Returns the last argument tried.
std::optional<double> narrow(Value a, Value b, const RootSearch& search, const Function& f) {
  const double rounding =
      2.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a.x), std::abs(b.x));
  double share = 0.5;
  double last = b.x;
  while (std::abs(b.x - a.x) > 2.0 * rounding) {
    const double margin = rounding / std::abs(b.x - a.x);
    const Value next{a.x + std::clamp(share, margin, 1.0 - margin) * (b.x - a.x), 0.0};
    const std::optional<double> value = f(next.x);
    if (!value) return std::nullopt;
    last = next.x;
    if (std::abs(*value) <= search.tolerance) break;
    Value c = a;
    if ((*value < 0.0) != (a.f < 0.0)) c = std::exchange(b, a);
    a = {next.x, *value};
    share = next_share(a, b, c);
  }
  return last;
}

}  // namespace

double control_displacement(const Model& model, const State& start, const LengthControl& control, double time,
                            const VecX& d) {
  std::vector<Pose> moved;
  const auto along = [&](int block) {
    const int free = model.free_index[block];
    if (free != ContactProblem::kFixed) return d.segment<3>(6 * free).dot(control.direction);
    if (moved.empty()) {
      moved = start.poses;
      place_supports(*model.assembly, model.support_motions, time, &moved);
    }
    return (moved[block].p_WB - start.poses[block].p_WB).dot(control.direction);
  };
  return along(control.block) - (control.relative_to >= 0 ? along(control.relative_to) : 0.0);
}

std::optional<double> find_root(const RootSearch& search, const Function& f) {
  constexpr double kGrowth = 4.0;
  constexpr double kBeyond = 1.5;  // over the way to the root if the slope were right
  CUPOLA_ASSERT(search.low < search.high && search.step > 0.0);
  Value a{std::clamp(search.guess, search.low, search.high), 0.0};
  std::optional<double> value = f(a.x);
  if (!value) return std::nullopt;
  if (std::abs(*value) <= search.tolerance) return a.x;
  a.f = *value;
  const double sign = a.f < 0.0 ? 1.0 : -1.0;
  const double bound = sign > 0.0 ? search.high : search.low;
  const double first = search.slope > 0.0 ? kBeyond * std::abs(a.f) / search.slope : search.step;
  for (double step = first; a.x != bound; step *= kGrowth) {
    const double x = std::clamp(a.x + sign * step, search.low, search.high);
    value = f(x);
    if (!value) return std::nullopt;
    if (std::abs(*value) <= search.tolerance) return x;
    const Value b{x, *value};
    if ((a.f < 0.0) != (b.f < 0.0)) return narrow(a, b, search, f);
    a = b;
  }
  return a.x;
}

}  // namespace cupola
