#pragma once

#include <array>
#include <limits>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/random_field.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Inelastic displacements of the faces of a joint after which nothing is left of its tension and cohesion,
/// m: infinite in plastic joints, 0 in brittle ones, 2 G / f for the fracture energy G and the strength f of
/// softening ones.
struct CrackLengths {
  double opening = std::numeric_limits<double>::infinity();
  double slip = std::numeric_limits<double>::infinity();
};

/// Friction, compliance and strength of one contact point.
struct JointLaw {
  double mu = 0.0;
  double compliance_normal = 0.0;      ///< m/N per point; in a JointTable per area: m3/N
  double compliance_tangential = 0.0;  ///< same unit
  /// Largest forces, N per point (see ContactStrength); in a JointTable stresses, Pa.
  JointStrength strength = {};
  CrackLengths crack = {};
};

/// Classes of joints that can have different laws. A base joint lies on a support. A herringbone joint
/// touches a herringbone block. A wythe joint lies between layers of the thickness. Pieces belong to one
/// imported block: their names differ only after a '#'.
enum class JointClass { bed, head, herringbone_bed, herringbone_other, base, pieces, wythe, other };
constexpr int kNumJointClasses = 8;
/// `of_pieces`: the case gives joints of pieces a law; otherwise those that are bed or head remain so.
JointClass joint_class(const Assembly& assembly, const Patch& patch, bool of_pieces);
/// True if the group gives the joints of the class in the ring a law.
bool selects(const RingJoints& group, JointClass kind, int ring);
/// True if the case gives joints of pieces a law.
bool have_law_of_pieces(const Joints& joints);

/// The law of every class of joint in every ring. Laws of rings override laws of classes, and these override
/// the general law of the case.
class JointTable {
 public:
  struct ClassLaw {
    JointLaw law;           ///< but for its crack lengths
    FractureEnergy energy;  ///< N/m
  };

  JointTable() = default;
  explicit JointTable(const Joints& joints, int num_rings);

  /// Laws of mortar by the courses with which joints are laid, which override all others.
  void set_mortar(std::vector<RingJoints> by_course);

  bool has_strength() const { return has_strength_; }
  /// Law of a contact point of the patch with tributary area `area` (m2) and the given multiplicity (see
  /// Contact), at full friction; its strength is that of the closed share. Blocks that touch at an edge or a
  /// corner have none.
  JointLaw law(const Assembly& assembly, const Patch& patch, double area, int multiplicity = 1,
               double closed_share = 1.0) const;

 private:
  std::array<std::vector<ClassLaw>, kNumJointClasses> laws_;  // by class, then ring
  std::vector<RingJoints> mortar_;                            // by course
  RandomField friction_, strength_, compliance_;
  bool has_pieces_ = false;
  JointFailure failure_ = JointFailure::plastic;
  bool per_area_ = false, has_strength_ = false;
};

}  // namespace cupola
