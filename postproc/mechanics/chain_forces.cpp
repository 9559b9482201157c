#include "postproc/mechanics/chain_forces.hpp"

#include <algorithm>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kYields = 1.0 - 1e-6;  // of the yield force: the solvers' rounding

}  // namespace

Vec3 tie_force_on_b(const TieTable& ties, int i) {
  const Vec3 towards_a = (ties.point_a[i] - ties.point_b[i]).normalized();
  return (ties.strut[i] != 0 ? -ties.force[i] : ties.force[i]) * towards_a;
}

int num_ties_of(const TieTable& ties, const std::vector<Restraint>& restraints) {
  int num = ties.size();
  for (size_t i = restraints.size(); i-- > 0;)
    if (num >= 2 && ties.block_b[num - 1] == restraints[i].block && ties.strut[num - 1] != 0) num -= 2;
  return num;
}

std::vector<ChainForces> chain_forces(const std::vector<BuiltChain>& chains, const TieTable& ties) {
  std::vector<ChainForces> all;
  std::vector<double> length(chains.size(), 0.0);
  for (const BuiltChain& chain : chains) {
    ChainForces& row = all.emplace_back();
    row.name = chain.name;
    row.height = chain.height;
    row.least = row.yield_force = std::numeric_limits<double>::infinity();
  }
  for (int i = 0; i < ties.size(); ++i) {
    if (ties.chain[i] < 0) continue;
    const auto c = static_cast<size_t>(ties.chain[i]);
    CUPOLA_ASSERT(c < chains.size());
    ChainForces& row = all[c];
    const double force = ties.force[i], bar = (ties.point_b[i] - ties.point_a[i]).norm();
    ++row.bars;
    row.mean += bar * force;
    length[c] += bar;
    row.least = std::min(row.least, force);
    row.greatest = std::max(row.greatest, force);
    row.yield_force = std::min(row.yield_force, ties.yield_force[i]);
    row.slack += force == 0.0 ? 1 : 0;
    row.yielding += force >= kYields * ties.yield_force[i] ? 1 : 0;
    row.yielded += ties.yielded[i];
  }
  for (size_t c = 0; c < all.size(); ++c)
    if (length[c] > 0.0) all[c].mean /= length[c];
  return all;
}

}  // namespace cupola
