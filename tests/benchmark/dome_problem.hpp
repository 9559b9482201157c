#pragma once

#include <random>

#include "assembly/base/process.hpp"
#include "generators/generate.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/dynamics/model.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// Contact problem of the circular dome at rest, as cupola-solve builds it; 40 x 32 blocks by default.
struct DomeProblem {
  int rings = 40, blocks_per_ring = 32, slices_per_block = 4;
  double h = 1e3;            ///< s; a large step makes the problem static
  double compliance = 1e-8;  ///< m/N per point; kappa = compliance / h^2
  double friction = 0.4;
  double gap = 0.0;  ///< m, upper limit of the seeded random gaps
};

inline ContactProblem make_problem(const DomeProblem& dome) {
  Case scene;
  RunningBond bond;
  bond.rings = dome.rings;
  bond.blocks_per_ring = dome.blocks_per_ring;
  bond.slices_per_block = dome.slices_per_block;
  scene.geometry.bond = bond;
  scene.joints.friction = dome.friction;
  scene.joints.compliance = {dome.compliance, dome.compliance, Compliance::Per::point};
  const Assembly assembly = cut_assembly(scene);
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  ContactDetector detector(assembly, {});
  const ContactSet& contacts = detector.update(rest.poses);
  StepOptions step;
  step.h = dome.h;
  ContactProblem problem =
      build_step_problem(model, rest, contacts, match_memories({}, contacts.points), step).problem;
  std::mt19937 random(1);
  for (int i = 0; dome.gap > 0.0 && i < problem.num_contacts(); ++i) {
    problem.b[3 * i] += dome.gap / dome.h * (random() / 4294967296.0);
  }
  return problem;
}

}  // namespace cupola
