#include "generators/bond/make_bond.hpp"

#include "assembly/base/variant.hpp"
#include "generators/bond/courses.hpp"
#include "generators/bond/fill.hpp"
#include "generators/bond/herringbone.hpp"

namespace cupola {

BondPattern make_bond(const Bond& bond, const BondGrid& grid) {
  return std::visit(Overloaded{[&](const RunningBond& b) { return running_bond(b, grid); },
                               [&](const StackBond& b) { return stack_bond(b, grid); },
                               [&](const HerringboneBond& b) { return herringbone_bond(b, grid); },
                               [&](const FillBond& b) { return fill_bond(b, grid); }},
                    bond);
}

int rings_of(const Bond& bond) {
  return std::visit([](const auto& b) { return b.rings * b.refine; }, bond);
}

int refinement_of(const Bond& bond) {
  return std::visit([](const auto& b) { return b.refine; }, bond);
}

}  // namespace cupola
