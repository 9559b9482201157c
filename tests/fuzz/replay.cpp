// Runs a fuzz target without libFuzzer: on files, then on seeded random edits of them. Prints counts, the
// slowest input and the peak memory; fails above the limits that the project promises.
//
//   fuzz_case --edits 10000 cases/*.yaml
//   fuzz_case --edits 10000 --write edited_ cases/*.yaml     only writes the edits: edited_0.yaml ...

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/files/atomic_file.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace {

using namespace cupola;

constexpr double kLongest = 10.0;             // s for one input
constexpr long long kMostMemory = 1LL << 30;  // bytes for the whole run

/// Words that are hard for readers of numbers, texts, lists and maps.
const std::vector<std::string> kWords = {
    "nan",       "-1",     "0",          "1e400", "-0.0",     ".inf",
    "0x10",      "null",   "~",          "[]",    "{}",       "true",
    "\"",        "'",      "&a",         "*a",    "!!",       "...",
    "---",       "%",      "#",          ": ",    "- ",       "\t",
    "\n",        ",",      "[",          "]",     "{",        "}",
    "|",         ">",      "\\",         "\xff",  "\xc3",     "\xef\xbb\xbf",
    "extends: ", "type: ", "2147483648", "9e99",  "<script>", std::string(1, '\0')};

class Editor {
 public:
  explicit Editor(unsigned seed) : random_(seed) {}

  std::string edit(std::string text, const std::vector<std::string>& others) {
    for (size_t n = 1 + below(4); n > 0; --n) edit_once(&text, others[below(others.size())]);
    return text;
  }

 private:
  size_t below(size_t size) { return size == 0 ? 0 : random_() % size; }

  void edit_once(std::string* text, const std::string& other) {
    const size_t at = below(text->size() + 1);
    const size_t length = below(std::min<size_t>(text->size() - at, 40) + 1);
    switch (below(8)) {
      case 0:
        text->erase(at, length);
        break;
      case 1:
        text->insert(at, kWords[below(kWords.size())]);
        break;
      case 2:
        text->replace(at, length, kWords[below(kWords.size())]);
        break;
      case 3:
        text->insert(at, other.substr(below(other.size()), below(80)));
        break;
      case 4:
        text->insert(at, text->substr(at, length));
        break;
      case 5:
        text->resize(at);
        break;
      case 6:
        replace_word(text, at);
        break;
      default:
        if (at < text->size()) (*text)[at] = static_cast<char>(below(256));
    }
  }

  void replace_word(std::string* text, size_t at) {
    const char* const separators = " \n,:[]{}";
    const size_t begin = text->find_last_of(separators, at) + 1;  // npos + 1 is the start
    const size_t end = std::min(text->find_first_of(separators, begin), text->size());
    text->replace(begin, end - begin, kWords[below(kWords.size())]);
  }

  std::mt19937 random_;
};

struct Tally {
  int accepted = 0, refused = 0;
  double slowest = 0.0;

  void run(const std::string& bytes) {
    const double start = wall_seconds();
    (reader_accepts(bytes) ? accepted : refused) += 1;
    slowest = std::max(slowest, wall_seconds() - start);
  }
};

struct Request {
  int edits = 0;
  unsigned seed = 1;
  std::string write;  ///< prefix of files to write the edits to, instead of reading them
  std::vector<std::string> inputs;
};

Request parse(int argc, char** argv) {
  Request request;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--edits" && i + 1 < argc)
      request.edits = std::atoi(argv[++i]);
    else if (argument == "--seed" && i + 1 < argc)
      request.seed = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (argument == "--write" && i + 1 < argc)
      request.write = argv[++i];
    else
      request.inputs.push_back(read_text(argument));
  }
  if (request.inputs.empty()) request.inputs.emplace_back();
  return request;
}

int replay(const Request& request) {
  const std::vector<std::string>& inputs = request.inputs;
  Editor editor(request.seed);
  Tally files, edited;
  if (request.write.empty())
    for (const std::string& input : inputs) files.run(input);
  for (int i = 0; i < request.edits; ++i) {
    const std::string bytes = editor.edit(inputs[static_cast<size_t>(i) % inputs.size()], inputs);
    if (request.write.empty())
      edited.run(bytes);
    else
      write_bytes(fmt::format("{}{}.yaml", request.write, i), bytes);
  }
  if (!request.write.empty()) return 0;

  const double slowest = std::max(files.slowest, edited.slowest);
  fmt::print(
      "{} files ({} accepted), {} random edits ({} accepted, {} refused); slowest {:.3f} s, {:.0f} MB\n",
      files.accepted + files.refused, files.accepted, request.edits, edited.accepted, edited.refused, slowest,
      static_cast<double>(peak_memory_bytes()) / 1e6);
  if (slowest > kLongest || peak_memory_bytes() > kMostMemory) {
    fmt::print(stderr, "beyond the limits of {} s and {} bytes\n", kLongest, kMostMemory);
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return replay(parse(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "a reader let this escape: %s\n", error.what());
    return 1;
  }
}
