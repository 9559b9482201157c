#include "postproc/viewer/packed_arrays.hpp"

#include <bit>
#include <cmath>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are copied as they lie in memory");

std::uint32_t zigzag(std::int64_t difference) {
  const auto d = static_cast<std::int32_t>(difference);
  return static_cast<std::uint32_t>(d) << 1 ^ static_cast<std::uint32_t>(d >> 31);
}

}  // namespace

nlohmann::json& PackedArrays::append(const std::string& name, const char* type, const void* data,
                                     size_t count, size_t size) {
  CUPOLA_ASSERT(!arrays_.contains(name));
  arrays_[name] = {{"type", type}, {"start", payload_.size()}, {"count", count}};
  const char* bytes = static_cast<const char*>(data);
  size_t end = payload_.size();
  payload_.resize(end + count * size);
  for (size_t k = 0; k < size; ++k)
    for (size_t i = 0; i < count; ++i) payload_[end++] = bytes[i * size + k];
  return arrays_[name];
}

void PackedArrays::add(const std::string& name, const std::vector<std::uint8_t>& bytes) {
  append(name, "u8", bytes.data(), bytes.size(), 1);
}

void PackedArrays::add(const std::string& name, const std::vector<int>& integers, int delta) {
  std::vector<std::uint32_t> coded;
  coded.reserve(integers.size());
  const auto back = static_cast<size_t>(delta);
  for (size_t i = 0; i < integers.size(); ++i)
    coded.push_back(zigzag(std::int64_t{integers[i]} - (delta > 0 && i >= back ? integers[i - back] : 0)));
  append(name, "i32", coded.data(), coded.size(), sizeof(std::uint32_t))["delta"] = delta;
}

void PackedArrays::add(const std::string& name, const std::vector<double>& numbers) {
  append(name, "f64", numbers.data(), numbers.size(), sizeof(double));
}

void PackedArrays::add_rounded(const std::string& name, const std::vector<double>& numbers) {
  const std::vector<float> rounded(numbers.begin(), numbers.end());
  append(name, "f32", rounded.data(), rounded.size(), sizeof(float));
}

void PackedArrays::add_points(const std::string& name, const std::vector<Vec3>& points,
                              const Lattice& lattice) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) coordinates.push_back(p[k] - lattice.origin[k]);
  add_multiples(name, coordinates, lattice.step, 3);
  arrays_[name]["origin"] = {lattice.origin.x(), lattice.origin.y(), lattice.origin.z()};
}

void PackedArrays::add_multiples(const std::string& name, const std::vector<double>& numbers, double step,
                                 int delta) {
  CUPOLA_ASSERT(step > 0.0);
  // What lies outside the range of 32 bits (a block that fell for hours) is shown at its end.
  constexpr double kMost = 1 << 29;
  std::vector<int> integers;
  integers.reserve(numbers.size());
  for (const double x : numbers) {
    const double rounded = std::round(x / step);
    integers.push_back(std::isfinite(rounded) ? static_cast<int>(std::clamp(rounded, -kMost, kMost)) : 0);
  }
  add(name, integers, delta);
  arrays_[name]["step"] = step;
}

std::string PackedArrays::bytes(nlohmann::json header) const {
  header["arrays"] = arrays_;
  const std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string out(reinterpret_cast<const char*>(&length), sizeof length);
  return out + text + payload_;
}

}  // namespace cupola
