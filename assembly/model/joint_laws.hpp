#pragma once

#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/model/time_function.hpp"

namespace cupola {

/// Elastic displacement of a contact point per unit force, or of a joint per unit traction.
struct Compliance {
  enum class Per { point, area };
  double normal = 1e-8;                 ///< m/N per contact point, or m3/N per area, >= 0
  double tangential = 1e-8;             ///< same unit, >= 0
  Per per = Per::point;                 ///< the case must say which
  std::optional<double> relative = {};  ///< see resolve_compliance(), which finds the others from it

  /// The defaults. Per point: 1e-8 m/N in all directions, as in the paper (section 3). Per area: joints of
  /// 1e10 N/m3, which is a layer of 1 cm with a modulus of 0.1 GPa, and of 1 / (2 (1 + nu)) times that in
  /// shear with nu = 0.2; the soft end of lime mortar. Micro-models of brickwork use 8.2e10 and 3.6e10 N/m3
  /// (P. B. Lourenco, 1996, wall J4D).
  static Compliance default_per(Per per) {
    return per == Per::point ? Compliance{} : Compliance{1e-10, kTangential * 1e-10, per, {}};
  }
  static constexpr double kRelative =
      1e-4;  ///< of a case that gives none: small against any block, far above rounding
  static constexpr double kTangential = 2.4;  ///< over the normal compliance per area: 2 (1 + nu)
};
constexpr auto enum_names(Compliance::Per) {
  return std::array{"point", "area"};
}

/// Strength per area of joint, Pa. The default is a dry joint.
struct JointStrength {
  double tension = 0.0;   ///< >= 0
  double cohesion = 0.0;  ///< >= 0, shear strength without normal force
  double compression = std::numeric_limits<double>::infinity();  ///< > 0
  bool operator==(const JointStrength&) const = default;
};

/// What a joint does where it has reached its tensile or shear strength. `plastic`: it keeps its strength.
/// `brittle`: it loses tension and cohesion at once. `softening`: it loses them linearly with its opening and
/// slip.
enum class JointFailure { plastic, brittle, softening };
constexpr auto enum_names(JointFailure) {
  return std::array{"plastic", "brittle", "softening"};
}

/// Work per area that breaks a softening joint, N/m = J/m2, > 0.
struct FractureEnergy {
  double tension = 0.0;  ///< mode I: opening
  double shear = 0.0;    ///< mode II: slip; without the work of friction
};

/// Values that differ for a group of joints; the others are the general ones.
struct JointLawChange {
  std::optional<double> friction;
  std::optional<double> normal, tangential;  ///< compliance, in the unit of Joints::compliance
  std::optional<double> tension, cohesion, compressive_strength;  ///< Pa
  std::optional<FractureEnergy> fracture_energy;
};

/// Joints of some rings with a law of their own. `base` joints touch a fixed support, `herringbone` joints a
/// herringbone block; of the others, `bed` joints lie between rings and `head` joints within a ring.
struct RingJoints {
  enum class Sort {
    all,
    bed,
    head,
    herringbone,
    base,
    laid_bed,   ///< every bed, including those on supports and of herringbone blocks
    laid_head,  ///< every head, including those of herringbone blocks
    wythe,
    pieces,
    other  ///< of none of these kinds, as that of a springer with the side of its pier
  };
  int from = 0, to = 0;  ///< rings, inclusive, of the upper block of the joint; the lowest is 0
  Sort sort = Sort::all;
  JointLawChange law;
};
constexpr auto enum_names(RingJoints::Sort) {
  return std::array{"all",      "bed",       "head",  "herringbone", "base",
                    "laid_bed", "laid_head", "wythe", "pieces",      "other"};
}

/// Random factors on the values of joints, as functions of place: at each point lognormal with mean 1,
/// independent of each other. Two bonds of one seed read the same functions.
struct JointField {
  int seed = 1;
  double correlation_length =
      0.0;  ///< m, > 0: over the distance r the correlation of the logarithms is exp(-(r / length)^2)
  double friction = 0.0, strength = 0.0, compliance = 0.0;  ///< coefficients of variation, >= 0
  bool operator==(const JointField&) const = default;
};

/// Joint laws. Values for rings override values for a kind of joint, which override the general values.
struct Joints {
  double friction = 0.4;  ///< mu, >= 0
  Compliance compliance;
  JointStrength strength;
  JointFailure failure = JointFailure::plastic;
  std::optional<FractureEnergy> fracture_energy;  ///< softening only
  std::optional<JointLawChange> bed, head, herringbone, base;
  std::optional<JointLawChange> wythe;   ///< between layers of the thickness
  std::optional<JointLawChange> pieces;  ///< between imported blocks whose names differ only after a '#'
  std::vector<RingJoints> rings;
  std::optional<JointField> field;
  TimeFunction friction_time;  ///< factor on every friction coefficient

  /// The kinds of joints with a law of their own, each with its key.
  std::vector<std::pair<const char*, const JointLawChange*>> kinds() const;

  /// True if some joints have a tension, a cohesion or a compressive strength.
  bool have_strength() const;
  /// The least and the greatest friction that the case gives to any joints.
  std::pair<double, double> friction_range() const;
};

}  // namespace cupola
