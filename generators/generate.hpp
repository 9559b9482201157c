#pragma once

#include <optional>
#include <string>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/importer/import.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

/// Measurements of a generated model.
struct GenerateReport {
  ModelReport model;
  std::optional<ImportReport> import;  ///< only for imported blocks
  /// Groin vaults on springers, whose span and rise count from the springing below these.
  struct Springing {
    std::string member;
    double z = 0.0, first_beds = 0.0;  ///< m
  };
  std::vector<Springing> springings;
};

/// Cuts the surface of a case along its bond, without checking the blocks.
Assembly cut_assembly(const Case& input);

/// Cuts or imports the blocks of a case and checks them. Throws InputError with the block that fails a check.
/// `report` may be null.
Assembly generate(const Case& input, GenerateReport* report = nullptr);

/// The assembly that generate() makes of `input` if `assembly` and `report` are those of a case with the same
/// blocks.
Assembly generate_again(const Case& input, Assembly assembly, const GenerateReport& report);
/// Known without cutting them: the blocks of both cases are the same.
bool have_same_blocks(const Case& a, const Case& b);

std::string to_text(const GenerateReport& report);

/// What the user must know about the blocks, one sentence each; Assembly::block_warnings holds the same.
std::vector<std::string> warnings_of(const GenerateReport& report);

}  // namespace cupola
