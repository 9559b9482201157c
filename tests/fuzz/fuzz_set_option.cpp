// `--set` options, one per line, on a valid case. Promise: reading the case again with the same options gives
// the same hash.

#include <sstream>
#include <vector>

#include "assembly/case/case_reader.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  std::vector<std::string> options;
  std::istringstream lines{std::string(bytes)};
  for (std::string line; std::getline(lines, line) && options.size() < 20;) options.push_back(line);
  const std::string path = CUPOLA_SOURCE_DIR "/cases/dome_circular.yaml";
  Case once;
  if (!accepts([&] { once = read_case(path, options); })) return false;
  const std::vector<std::string> repeated = options;
  options.insert(options.end(), repeated.begin(), repeated.end());
  Case twice;
  if (accepts([&] { twice = read_case(path, options); }))
    demand(once.hash == twice.hash, "repeating options changes nothing");
  return true;
}

}  // namespace cupola
