#pragma once

#include "assembly/assembly.hpp"
#include "assembly/case/case.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

/// Makes the blocks that a case describes, without checking them: surface, bond, stage, density.
Assembly cut_assembly(const Case& input);

/// Makes and checks them (GEOMETRY in generators/README.md tells the formulas). Throws InputError naming the
/// block when a check fails. `report` may be null.
Assembly generate(const Case& input, ModelReport* report = nullptr);

}  // namespace cupola
