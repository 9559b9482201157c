#include "assembly/declared_sizes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <vtkBase64Utilities.h>

namespace cupola {
namespace {

constexpr double kMostPacked = 1032.0;

/// Value of a numeric attribute of a tag; none when it is not there, infinity when it is no count.
std::optional<double> count_in(std::string_view tag, std::string_view attribute) {
  const std::string start = fmt::format(" {}=\"", attribute);
  const size_t at = tag.find(start);
  if (at == std::string_view::npos) return std::nullopt;
  std::uint64_t value = 0;
  const char* first = tag.data() + at + start.size();
  const auto [end, error] = std::from_chars(first, tag.data() + tag.size(), value);
  if (error != std::errc() || end == tag.data() + tag.size() || *end != '"')
    return std::numeric_limits<double>::infinity();
  return static_cast<double>(value);
}

/// Bytes that the packed array at a position takes unpacked; infinity when its header says nonsense.
double unpacked_size(std::string_view text, double position) {
  constexpr size_t kHeader = 24, kCharacters = 32;  // number of blocks, size of each, size of the last
  if (!(position + kCharacters <= static_cast<double>(text.size())))
    return std::numeric_limits<double>::infinity();
  std::array<unsigned char, kHeader> bytes{};
  const auto* coded = reinterpret_cast<const unsigned char*>(text.data()) + static_cast<size_t>(position);
  if (vtkBase64Utilities::DecodeSafely(coded, kCharacters, bytes.data(), kHeader) != kHeader)
    return std::numeric_limits<double>::infinity();
  std::array<std::uint64_t, 3> header{};
  std::memcpy(header.data(), bytes.data(), kHeader);
  const auto blocks = static_cast<double>(header[0]);
  // Every block has a size of its own in the header.
  if (8.0 * blocks > static_cast<double>(text.size())) return std::numeric_limits<double>::infinity();
  return blocks * static_cast<double>(header[1]) + static_cast<double>(header[2]);
}

}  // namespace

std::string oversized(std::string_view text) {
  const size_t appended = text.find("<AppendedData encoding=\"base64\">");
  const size_t data = text.find('_', appended == std::string_view::npos ? text.size() : appended);
  if (data == std::string_view::npos || text.find("compressor=\"vtkZLibDataCompressor\"") > appended ||
      text.find("header_type=\"UInt64\"") > appended)
    return "has no packed data as Cupola writes them";
  const double most = kMostPacked * static_cast<double>(text.size());
  for (size_t open = text.find('<'); open < appended; open = text.find('<', open + 1)) {
    const std::string_view tag = text.substr(open, text.find('>', open) - open);
    double count = 1.0;
    for (const char* attribute : {"NumberOfTuples", "NumberOfComponents"})
      count *= count_in(tag, attribute).value_or(1.0);
    for (const char* attribute : {"NumberOfPoints", "NumberOfCells", "NumberOfVerts", "NumberOfLines",
                                  "NumberOfStrips", "NumberOfPolys"})
      count = std::max(count, count_in(tag, attribute).value_or(0.0));
    if (const auto offset = count_in(tag, "offset"))
      count = std::max(count, unpacked_size(text, static_cast<double>(data + 1) + *offset));
    if (!(count <= most))
      return fmt::format("declares more data than its {} bytes can hold, in <{}", text.size(),
                         tag.substr(1, tag.find_first_of(" \n") - 1));
  }
  return {};
}

}  // namespace cupola
