#pragma once

#include <string>
#include <vector>

#include "assembly/model/loads.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// N, of tie i on its block b: towards a in tension, away from it in a strut.
Vec3 tie_force_on_b(const TieTable& ties, int i);

/// Number of the ties before those of restraints, which come last, both signs of each, but not those of blocks
/// that a frame leaves out.
int num_ties_of(const TieTable& ties, const std::vector<Restraint>& restraints);

/// Tension of the bars of one chain at one instant.
struct ChainForces {
  std::string name;
  double height = 0.0;  ///< m
  int bars = 0;
  double mean = 0.0;         ///< N, over the bars weighted by their length
  double least = 0.0;        ///< N
  double greatest = 0.0;     ///< N
  double yield_force = 0.0;  ///< N; infinity: elastic without limit
  int slack = 0;             ///< bars without tension
  int yielding = 0;          ///< bars at their yield force
  double yielded = 0.0;      ///< m, plastic elongation of all bars together
};

/// One row per chain. Ties without a chain are left out.
std::vector<ChainForces> chain_forces(const std::vector<BuiltChain>& chains, const TieTable& ties);

}  // namespace cupola
