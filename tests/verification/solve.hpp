#pragma once

#include <functional>
#include <map>
#include <utility>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola::verification {

struct Equilibrium {
  Summary summary;
  Frame frame;
};

/// Static equilibrium of the assembly as built; throws std::runtime_error if the run does not end `stable`.
Equilibrium solve_equilibrium(const Case& scene, const Assembly& assembly);

/// Whether the static analysis ends `stable`; throws std::runtime_error if it ends `unconverged`.
bool stands(const Case& scene, const Assembly& assembly);

/// Middle of the bracket of a limit analysis; throws std::runtime_error if there is none of at most twice the
/// requested width.
double critical_value(const Case& scene, const Assembly& assembly);

/// The factor, within a relative width of 1e-4, at which `stands_at` changes from true at `low` to false at
/// `high`.
double critical_factor(double low, double high, const std::function<bool(double)>& stands_at);

/// A limit analysis of rigid blocks with little compliance (1e-8 m/N per point), to a bracket of 1e-4.
Case limit_case(LimitSearch::Parameter parameter, double low, double high, double friction);

/// Force of block a on block b, a < b, summed over their contacts, N.
using JointForces = std::map<std::pair<int, int>, Vec3>;
JointForces joint_forces(const Frame& frame);

/// A case of cases/NAME.yaml with settings `key.path=value`.
Case repository_case(const std::string& name, const std::vector<std::string>& settings = {});

}  // namespace cupola::verification
