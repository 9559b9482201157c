#pragma once

#include "assembly/files/summary_file.hpp"

namespace cupola::test {

/// With values that lose digits if they are written carelessly.
inline Summary example_summary() {
  Summary s;
  s.status = Status::moving;
  s.message = "largest speed 0.2 m/s > threshold 0.001 m/s, \"quoted\"";
  s.analysis = AnalysisType::dynamic;
  s.assembly_hash = "hash of the assembly";
  s.blocks = 3;
  s.weight_N = 1.0 / 3.0;
  s.applied_load_N = {1e-17, -2.0, 1.0 / 7.0};
  s.accuracy = {"force balance of the blocks", "largest, over the weight", 1e-8, 1.0 / 3e9, 1e-9};
  s.certified_force_error = {1.2e-9, "distance from the exact forces"};
  s.forces_unique = {false, "some compliance is zero"};
  s.contact_law_residual = 4.9e-324;
  s.largest_law_violation = {0.88, 3, 12, 17, 0.25};
  s.worst_steps = {RunStep{7, 0.07}, {}, RunStep{9, 0.09}};
  s.peak_memory_bytes = 5'000'000'000;
  s.threads = 2;
  return s;
}

}  // namespace cupola::test
