#include "assembly/model/smooth_motion.hpp"

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Whether the value stays from point i to the next, and not as of a smooth motion that turns between both.
bool rests_after(const TableInTime& table, size_t i) {
  constexpr double kLonger = 2.0;  // than the intervals beside it
  const std::vector<double>&t = table.times, &x = table.values;
  if (x[i] != x[i + 1]) return false;
  const bool at_end = i == 0 || i + 2 == t.size();
  if (at_end || x[i - 1] == x[i] || x[i + 2] == x[i]) return true;
  const double d = t[i + 1] - t[i];
  return d > kLonger * (t[i] - t[i - 1]) && d > kLonger * (t[i + 2] - t[i + 1]);
}

/// Accelerations at the points first .. last of the cubic spline that is at rest at both.
std::vector<double> accelerations(const TableInTime& table, size_t first, size_t last) {
  // a_(i-1) d_i / 6 + a_i (d_i + d_(i+1)) / 3 + a_(i+1) d_(i+1) / 6 = s_(i+1) - s_i, with the intervals d and
  // the mean velocities s in them, which are 0 before and after: elimination, then substitution from the end.
  std::vector<double> a, next;  // a_i + next_i a_(i+1) after the elimination
  double d = 0.0, s = 0.0;
  for (size_t i = first; i <= last; ++i) {
    const double d_next = i < last ? table.times[i + 1] - table.times[i] : 0.0;
    const double s_next = i < last ? (table.values[i + 1] - table.values[i]) / d_next : 0.0;
    const double pivot = (d + d_next) / 3.0 - (i > first ? d / 6.0 * next.back() : 0.0);
    a.push_back((s_next - s - (i > first ? d / 6.0 * a.back() : 0.0)) / pivot);
    next.push_back(d_next / 6.0 / pivot);
    d = d_next;
    s = s_next;
  }
  for (size_t i = a.size() - 1; i-- > 0;) a[i] -= next[i] * a[i + 1];
  return a;
}

void add_point(double time, double acceleration, double velocity, double displacement,
               DisplacementInTime* motion) {
  motion->acceleration.times.push_back(time);
  motion->acceleration.values.push_back(acceleration);
  motion->velocity.push_back(velocity);
  motion->displacement.push_back(displacement);
}

}  // namespace

DisplacementInTime interpolate_smoothly(const TableInTime& displacement) {
  constexpr double kSudden = 1e-10;  // s, in which the acceleration of a rest begins: no step sees it
  const std::vector<double>&t = displacement.times, &x = displacement.values;
  CUPOLA_ASSERT(!t.empty() && x.size() == t.size());
  DisplacementInTime motion;
  for (size_t first = 0, last = 0; first + 1 < t.size(); first = last) {
    last = first + 1;
    if (rests_after(displacement, first)) continue;
    while (last + 1 < t.size() && !rests_after(displacement, last)) ++last;
    if (!motion.velocity.empty()) {
      add_point(motion.acceleration.times.back() + kSudden, 0.0, 0.0, x[first], &motion);
      add_point(t[first] - kSudden, 0.0, 0.0, x[first], &motion);
    }
    const std::vector<double> a = accelerations(displacement, first, last);
    double v = 0.0;
    for (size_t i = first; i <= last; ++i) {
      if (i > first) v += 0.5 * (a[i - first - 1] + a[i - first]) * (t[i] - t[i - 1]);
      add_point(t[i], a[i - first], i < last ? v : 0.0, x[i], &motion);
    }
  }
  if (motion.velocity.empty()) add_point(t[0], 0.0, 0.0, x[0], &motion);
  return motion;
}

}  // namespace cupola
