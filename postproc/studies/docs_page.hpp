#pragma once

#include <string>
#include <vector>

#include "postproc/tables/run_files.hpp"

namespace cupola {

/// The revision of the programs that computed the runs, from the runs' own summaries. Throws InputError, with
/// the names, if the runs carry different revisions, or one whose sources were changed or are unknown: nobody
/// could compute their table again.
std::string common_revision(const std::vector<std::string>& runs, RunCache& cache);

/// "Measured 2026-11-24 by the programs of revision 81eb1cc on 2 cores of AMD EPYC,
/// load average 1.1 at the end."
std::string measured_line(const std::string& revision);

/// Throws InputError if files that git tracks in `root` are changed, apart from pages and their pictures.
void require_clean_tree(const std::string& root);

/// Replaces the text between `<!-- table NAME -->` and `<!-- end -->` of a page. Throws InputError unless the
/// page has one such pair.
void write_to_page(const std::string& page, const std::string& name, const std::string& text);

}  // namespace cupola
