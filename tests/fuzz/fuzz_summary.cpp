// results/summary.json. Promise: an accepted summary, written and read back, gives the same text.

#include "assembly/files/summary_file.hpp"
#include "assembly/model/results.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  Summary summary;
  if (!accepts([&] { summary = summary_from_json(std::string(bytes), "summary.json"); })) return false;
  const std::string text = to_json(summary);
  demand(to_json(summary_from_json(text, "summary.json")) == text, "a summary survives writing and reading");
  return true;
}

}  // namespace cupola
