#include "solver/analysis/construction/mortar_age.hpp"

#include <algorithm>
#include <limits>

namespace cupola {
namespace {

std::optional<double> between(const std::optional<double>& a, const std::optional<double>& b, double share) {
  if (!a || !b) return std::nullopt;
  return *a + share * (*b - *a);
}

/// The law of mortar of an age; none if it has hardened.
std::optional<JointLawChange> law_at_age(const StagedConstruction& staged, int courses) {
  if (staged.curing.empty())
    return courses < staged.fresh.courses ? std::optional(staged.fresh.law()) : std::nullopt;
  const double age = courses * staged.days_per_course.value_or(1.0);
  const auto after =
      std::ranges::find_if(staged.curing, [&](const CuringMortar& row) { return row.age >= age; });
  if (after == staged.curing.end()) return std::nullopt;
  if (after == staged.curing.begin()) return after->law;
  const CuringMortar &a = *(after - 1), &b = *after;
  const double share = (age - a.age) / (b.age - a.age);
  return JointLawChange{between(a.law.friction, b.law.friction, share),
                        between(a.law.normal, b.law.normal, share),
                        between(a.law.tangential, b.law.tangential, share),
                        between(a.law.tension, b.law.tension, share),
                        between(a.law.cohesion, b.law.cohesion, share),
                        {},
                        {}};
}

}  // namespace

std::vector<RingJoints> mortar_by_course(const StagedConstruction& staged, int ring) {
  std::vector<RingJoints> laws;
  for (int age = ring; age >= 0; --age) {  // the youngest last
    const std::optional<JointLawChange> law = law_at_age(staged, age);
    if (!law) continue;
    const int from = ring - age, to = age == 0 ? std::numeric_limits<int>::max() : from;
    laws.push_back({from, to, RingJoints::Sort::laid_bed, *law});
    if (staged.fresh.heads) laws.push_back({from, to, RingJoints::Sort::laid_head, *law});
  }
  return laws;
}

bool is_fresh(const StagedConstruction& staged, int courses) {
  return law_at_age(staged, courses).has_value();
}

void set_fresh(double value, StagedConstruction* staged) {
  const bool friction = staged->least == StagedConstruction::Least::friction;
  if (staged->curing.empty()) {
    (friction ? staged->fresh.friction : staged->fresh.cohesion) = value;
  } else {
    JointLawChange& law = staged->curing.front().law;
    (friction ? law.friction : law.cohesion) = value;
  }
}

}  // namespace cupola
