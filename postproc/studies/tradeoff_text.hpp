#pragma once

#include <string>
#include <vector>

#include "postproc/studies/tradeoff.hpp"

namespace cupola {

/// The exchange of time for accuracy in words: runs that are missing, one paragraph per reference, one per
/// knob.
std::vector<std::string> tradeoff_text(const std::vector<TradeoffRow>& rows);

}  // namespace cupola
