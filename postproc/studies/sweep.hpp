#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/case/sweep.hpp"
#include "postproc/studies/study_page.hpp"
#include "postproc/studies/study_run.hpp"

namespace cupola {

/// Column of a table of limits some of which have no critical value.
inline constexpr const char* kStandsAtBothEnds = "stands_at_both_ends";

/// One row per member: the values that the member gives the `keys`, status, verdict on the case, residual,
/// displacement, critical value and time, and minimum, chosen value and maximum of each range of a range
/// analysis. A member without results has the status `missing` and a remark that says how far it got.
Table sweep_table(const std::vector<std::string>& keys, const std::vector<StudyRun>& members,
                  const std::string& runs_folder);
/// The verdicts of such a table: "it falls in 2, it stands in 6".
std::string endings(const Table& sweep_table);
/// "2 of 8 runs" that have no results or did not reach their accuracy; "" for none. A limit that lies outside
/// its bracket is a result.
std::string failures(const Table& sweep_table, const std::string& noun = "run");
/// Of each member 1 if its case falls, 0 if it stands, -1 without a verdict on it.
std::vector<int> falls_of(const Table& sweep_table);
/// Of each limit without a critical value whether its structure stands, or moves, throughout its bracket.
std::vector<std::optional<bool>> stands_throughout(const Table& sweep_table);
/// Columns of numbers that differ by more than rounding between the members; errors and times are no results.
std::vector<size_t> varying_columns(const Table& sweep_table);

/// Whether limits with a greater critical value are safer, as those of loads are and those of friction are
/// not: by the bracket of the first member that has one.
bool more_is_safer(const std::vector<StudyRun>& members, const std::string& runs_folder);

/// The member of a table of limits that governs, with its critical value and the values of its keys, and the
/// one at the other end. Members that fall throughout their bracket come first, then the least margin, or
/// the least safe critical value where the case has no value to compare; last those that stand throughout. ""
/// without critical values, and where they are values of several parameters.
std::string governing_member(const std::vector<std::string>& keys, const Table& sweep_table,
                             bool more_is_safer);

/// Adds a sweep to a page: how the members ended, a figure, the table (sweep.csv), and links to the reports
/// of the members. Returns the same as text.
std::string add_sweep(const std::vector<SweptKey>& sweep, const std::vector<StudyRun>& members,
                      const std::string& runs_folder, StudyPage* page);

}  // namespace cupola
