#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Rounding of lengths to integers: `step` m apart from `origin`.
struct Lattice {
  double step = 0.0;
  Vec3 origin = Vec3::Zero();
};

/// Typed arrays as a browser reads them from one block of bytes (scene.js):
///
///     length of the header (4 bytes), header in JSON, arrays
///
/// The header's key `arrays` gives type, start and count of each. All numbers are little-endian. To compress
/// well, byte k of all elements of an array comes before byte k + 1, and integers are stored as the zigzag
/// code of their differences from the element `delta` places before.
class PackedArrays {
 public:
  void add(const std::string& name, const std::vector<std::uint8_t>& bytes);
  void add(const std::string& name, const std::vector<int>& integers, int delta = 0);
  void add(const std::string& name, const std::vector<double>& numbers);
  /// The same with 24 bits of mantissa (single precision).
  void add_rounded(const std::string& name, const std::vector<double>& numbers);
  /// Points rounded to a lattice; each coordinate is at most half a step off.
  void add_points(const std::string& name, const std::vector<Vec3>& points, const Lattice& lattice);
  /// Numbers rounded to multiples of `step`, at most half a step off.
  void add_multiples(const std::string& name, const std::vector<double>& numbers, double step, int delta);

  /// The header, with the list of arrays added, and the arrays.
  std::string bytes(nlohmann::json header) const;

 private:
  nlohmann::json& append(const std::string& name, const char* type, const void* data, size_t count,
                         size_t size);

  nlohmann::json arrays_ = nlohmann::json::object();
  std::string payload_;
};

}  // namespace cupola
