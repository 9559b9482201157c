#pragma once

#include <stdexcept>
#include <string>

namespace cupola {

/// Position in a text file. Lines and columns count from 1; 0 means unknown.
struct FileLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Invalid input from the user: what is wrong, where, and which rule it breaks. Programs print it and exit
/// with code 2.
///
///     cases/arch.yaml:14:7: error: joints.friction = -0.4: must be >= 0
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message);
  InputError(const FileLocation& where, const std::string& message);
};

/// Failure of the system: disk full, file not writable, out of memory. Programs print it and exit with code
/// 1.
class SystemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The valid name closest to `name` by edit distance, or "" if none is close enough to be what was meant.
template <class Names>
std::string nearest_name(const std::string& name, const Names& valid_names);

/// Number of single-character edits between two words: insertions, deletions, replacements and swaps of
/// neighbours (optimal string alignment distance).
int edit_distance(const std::string& a, const std::string& b);

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

template <class Names>
std::string nearest_name(const std::string& name, const Names& valid_names) {
  std::string best;
  int best_distance = static_cast<int>(name.size()) / 3 + 2;  // beyond this it is a different word
  for (const std::string& candidate : valid_names) {
    const int distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace cupola

/// Checks an assumption of our own code, not user input. Active in builds with assertions (presets dev, asan,
/// audit).
#ifdef CUPOLA_ASSERTIONS
#define CUPOLA_ASSERT(condition) \
  ((condition) ? void(0) : ::cupola::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define CUPOLA_ASSERT(condition) void(0)
#endif
