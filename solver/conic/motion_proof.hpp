#pragma once

#include <optional>

#include "solver/conic/conic_problem.hpp"

namespace cupola {

/// True if the velocities v prove in exact arithmetic that no forces within the limits of the joints balance
/// the load: no admissible force resists the motion (Farkas' lemma; the kinematic theorem of limit analysis),
///
///     s = D^T v in Y*  where the compression has no limit,     load . v > what the joints dissipate
///
/// Rounding is bounded: s counts as what double precision guarantees of it, load . v is summed in extended
/// precision. `load`: in the unit of the strength of `contacts`, force or impulse (6 nb).
bool proves_motion(const ContactProblem& contacts, const VecX& load, const VecX& v);

/// Proofs that a scene moves, from candidates or by a conic programme.
class MotionProof {
 public:
  /// `load` as in proves_motion().
  MotionProof(const ContactProblem& contacts, const VecX& load);

  /// v, or v and so much of a motion that opens every contact that all s lie in Y*, if that is a proof
  /// (opening_motion.hpp). Where none opens all, blocks at rest in v stay so exactly, and the others open.
  std::optional<VecX> next_to(const VecX& v);

  enum class Answer {
    moves,       ///< mechanism() is a proof
    admissible,  ///< forces() balance the loads up to the tolerance of the conic solver
    unknown      ///< neither, or a mechanism that rounding or self-stress keeps from being a proof
  };
  /// Asks the conic solver, once.
  Answer search();
  const VecX& mechanism() const { return mechanism_; }  ///< (6 nb)
  const VecX& forces() const { return forces_; }        ///< in the unit of the load (3 nc)

 private:
  const VecX& opening();

  ConicProblem problem_;
  std::optional<VecX> opening_;  ///< empty vector: there is none
  std::optional<Answer> answer_;
  VecX mechanism_, forces_;
};

}  // namespace cupola
