#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "generators/importer/block_mesh.hpp"
#include "generators/importer/import_report.hpp"

namespace cupola {

/// Fixes the blocks that the case or the file names, and those below a height.
void fix_supports(const ImportedBlocks& source, const std::vector<RawBlock>& raw, const ImportReport& report,
                  Assembly* assembly);

/// If the supports lie at the lower end of the file's y axis and not at that of z, y is probably upward.
std::string doubt_of_axes(const ImportedBlocks& source, const ImportReport& report, const Assembly& assembly);

/// Fixes the blocks with a single neighbour, if the case asks for it. Returns how many.
int fix_ends(const ImportedBlocks& source, std::span<const FacePair> joints, Assembly* assembly);

/// Throws InputError for a case that fixes all blocks, with a key that does.
void refuse_all_fixed(const ImportedBlocks& source, const Assembly& assembly);

}  // namespace cupola
