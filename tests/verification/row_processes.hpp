#pragma once

#include <functional>
#include <vector>

#include "tests/verification/verification_row.hpp"

namespace cupola::verification {

/// compute(task) for task in [0, count), in as many child processes as there are processors. If a process
/// ends before its task, the result of that task says so and another process continues with the next.
std::vector<RowResult> run_in_processes(int count, const std::function<RowResult(int)>& compute);

}  // namespace cupola::verification
