#pragma once

#include <optional>
#include <string>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/importer/import.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

/// What generate made and measured.
struct GenerateReport {
  ModelReport model;
  std::optional<ImportReport> import;  ///< of blocks that others cut
};

/// Cuts the blocks that a case's surface and bond describe, without checking them.
Assembly cut_assembly(const Case& input);

/// Makes the blocks of a case, cut or imported, and checks them. Throws InputError naming the block when a
/// check fails. `report` may be null.
Assembly generate(const Case& input, GenerateReport* report = nullptr);

std::string to_text(const GenerateReport& report);

}  // namespace cupola
