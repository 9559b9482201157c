#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "postproc/studies/study_run.hpp"

namespace cupola {

/// The fixed blocks, grouped to supports that settle by themselves: blocks that touch are one support. If all
/// touch, as those under a dome, each is one. More than 16 are joined to 16 by their azimuth about the middle
/// of the supports.
std::vector<std::vector<int>> support_groups(const Assembly& assembly);

/// The runs of a group with `settle`: one per support, which sinks by this share of the larger horizontal
/// extent of the free blocks. `name` + "_" + the name of its first block, or its number, names the run. A dome
/// on one fixed block gets eight (geometry.base_blocks). Without such runs `reason` says why.
std::vector<StudyRun> settlement_runs(const RunGroup& group, const std::string& study, const Case& scene,
                                      const Assembly& assembly, std::string* reason);

}  // namespace cupola
