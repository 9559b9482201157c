#include "assembly/files/vtk_layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <vtkBase64Utilities.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kMostPacked = 1032.0;
constexpr double kNonsense = std::numeric_limits<double>::infinity();
constexpr std::string_view kStart = "<?xml version=\"1.0\"?>\n";
constexpr std::string_view kSpace = " \n";

/// <name key="value" ...>, </name> or <name key="value" .../>.
struct Tag {
  std::string_view name;
  std::map<std::string_view, std::string_view> attributes;
  bool closes = false;    ///< </name>
  bool is_whole = false;  ///< .../>
};

/// Parses the tag that starts at '<'; none if it does not have that form.
std::optional<Tag> parse_tag(std::string_view text) {
  Tag tag;
  const auto skip = [&](size_t n) { text.remove_prefix(std::min(n, text.size())); };
  const auto word = [&] {
    const std::string_view found = text.substr(0, text.find_first_of(" \n=\"/<>"));
    skip(found.size());
    return found;
  };
  skip(1);
  tag.closes = text.starts_with('/');
  if (tag.closes) skip(1);
  tag.name = word();
  while (true) {
    skip(std::min(text.find_first_not_of(kSpace), text.size()));
    if (text.starts_with('>')) return tag;
    if (text.starts_with("/>")) {
      tag.is_whole = true;
      return tag;
    }
    const std::string_view key = word();
    if (key.empty() || !text.starts_with("=\"")) return std::nullopt;
    skip(2);
    const size_t end = text.find_first_of("\"<");
    if (end == std::string_view::npos || text[end] != '"') return std::nullopt;
    if (!tag.attributes.emplace(key, text.substr(0, end)).second) return std::nullopt;
    skip(end + 1);
  }
}

/// Infinity if the text is not a count.
double count_of(std::string_view value) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), count);
  return error == std::errc() && end == value.data() + value.size() ? static_cast<double>(count) : kNonsense;
}

/// Uncompressed size in bytes of the array at a position; infinity if its header is invalid.
double unpacked_size(std::string_view text, double position) {
  constexpr size_t kHeader = 24, kCharacters = 32;  // number of blocks, size of each, size of the last
  if (!(position + kCharacters <= static_cast<double>(text.size()))) return kNonsense;
  std::array<unsigned char, kHeader> bytes{};
  const auto* coded = reinterpret_cast<const unsigned char*>(text.data()) + static_cast<size_t>(position);
  if (vtkBase64Utilities::DecodeSafely(coded, kCharacters, bytes.data(), kHeader) != kHeader)
    return kNonsense;
  std::array<std::uint64_t, 3> header{};
  std::memcpy(header.data(), bytes.data(), kHeader);
  const auto blocks = static_cast<double>(header[0]);
  // The header holds the size of every block.
  if (8.0 * blocks > static_cast<double>(text.size())) return kNonsense;
  return blocks * static_cast<double>(header[1]) + static_cast<double>(header[2]);
}

/// Which element may contain which; the elements of a piece occur once each.
bool may_stand_in(std::string_view name, std::string_view parent, std::string_view type) {
  static const std::set<std::string_view> kSections{"PointData", "CellData", "Points", "Cells",
                                                    "Verts",     "Lines",    "Strips", "Polys"};
  if (name == "VTKFile") return parent.empty();
  if (name == type) return parent == "VTKFile";
  if (name == "FieldData" || name == "Piece") return parent == type;
  if (kSections.contains(name)) return parent == "Piece";
  if (name == "DataArray" || name == "Array") return parent == "FieldData" || kSections.contains(parent);
  return false;
}

/// Visits the elements that precede the data.
class Layout {
 public:
  explicit Layout(std::string_view text)
      : text_(text),
        data_(std::min(text.find(kAppended), text.find(kAppendedByVtk))),
        most_(kMostPacked * static_cast<double>(text.size())) {}

  std::string defect() {
    if (data_ == std::string_view::npos)
      return "has no element of appended data: not a file written by Cupola";
    if (!text_.starts_with(kStart)) return "does not begin like a file written by Cupola";
    for (size_t open = kStart.size(); open < data_; open = text_.find('<', open + 1)) {
      const std::optional<Tag> tag = parse_tag(text_.substr(open, data_ - open));
      if (!tag) return fmt::format("has a malformed element at byte {}", open);
      if (std::string why = visit(*tag); !why.empty()) return why;
    }
    if (parents_ != std::vector<std::string_view>{"VTKFile"} || !seen_.contains("Piece") ||
        !seen_.contains("Points"))
      return "lacks elements of a file written by Cupola";
    return {};
  }

 private:
  std::string visit(const Tag& tag) {
    const std::string_view parent = parents_.empty() ? "" : parents_.back();
    const bool is_array = tag.name == "DataArray" || tag.name == "Array";
    if (tag.closes) {
      if (parent != tag.name || tag.name == "VTKFile" || !tag.attributes.empty()) return misplaced(tag);
      parents_.pop_back();
      return {};
    }
    if (tag.name == "VTKFile") type_ = value(tag, "type");
    if (!may_stand_in(tag.name, parent, type_) || tag.is_whole != is_array) return misplaced(tag);
    if (!is_array && !seen_.insert(tag.name).second) return misplaced(tag);
    if (!has_its_attributes(tag))
      return fmt::format("has an element <{}> with attributes that Cupola does not write", tag.name);
    if (declared(tag) > most_)
      return fmt::format("declares more data than its {} bytes can hold, in <{}>", text_.size(), tag.name);
    if (!tag.is_whole) parents_.push_back(tag.name);
    return {};
  }

  static std::string misplaced(const Tag& tag) {
    return fmt::format("has an element <{}{}> in an unexpected place", tag.closes ? "/" : "", tag.name);
  }
  static std::string_view value(const Tag& tag, std::string_view key) {
    const auto found = tag.attributes.find(key);
    return found == tag.attributes.end() ? std::string_view() : found->second;
  }

  static bool has_its_attributes(const Tag& tag) {
    const auto one_of = [&](std::string_view key, std::initializer_list<std::string_view> values) {
      return std::ranges::find(values, value(tag, key)) != values.end();
    };
    const auto has_all = [&](std::initializer_list<std::string_view> keys) {
      return std::ranges::all_of(keys, [&](std::string_view key) { return tag.attributes.contains(key); });
    };
    if (tag.name == "VTKFile")
      return one_of("type", {"UnstructuredGrid", "PolyData"}) && one_of("byte_order", {"LittleEndian"}) &&
             one_of("header_type", {"UInt64"}) && one_of("compressor", {"vtkZLibDataCompressor"});
    if (tag.name == "Piece")
      return has_all({"NumberOfPoints"}) &&
             (has_all({"NumberOfCells"}) ||
              has_all({"NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys"}));
    const bool appended = one_of("format", {"appended"}) && has_all({"Name", "offset"});
    if (tag.name == "Array") return appended && one_of("type", {"String"});
    if (tag.name == "DataArray") return appended && one_of("type", {"Float64", "Int32", "Int64", "UInt8"});
    return tag.attributes.empty();
  }

  /// Number of values or bytes; infinity if a number is invalid.
  double declared(const Tag& tag) const {
    double most = 0.0, values = 1.0;
    for (const auto& [key, value] : tag.attributes) {
      if (!key.starts_with("NumberOf")) continue;
      most = std::max(most, count_of(value));
      if (key == "NumberOfTuples" || key == "NumberOfComponents") values *= count_of(value);
    }
    most = std::max(most, values);
    if (!tag.attributes.contains("offset")) return most;
    const auto start = static_cast<double>(data_ + kAppended.size());
    return std::max(most, unpacked_size(text_, start + count_of(value(tag, "offset"))));
  }

  std::string_view text_;
  size_t data_;
  double most_;
  std::string_view type_;
  std::vector<std::string_view> parents_;
  std::set<std::string_view> seen_;
};

}  // namespace

std::string layout_defect(std::string_view text) {
  return Layout(text).defect();
}

void shorten_appended_tag(const std::string& path) {
  constexpr size_t kChunk = 1 << 16;
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  std::string head;
  size_t at = std::string::npos;
  while (file && at == std::string::npos) {
    const size_t old_size = head.size();
    head.resize(old_size + kChunk);
    file.read(head.data() + old_size, kChunk);
    head.resize(old_size + static_cast<size_t>(file.gcount()));
    at = head.find(kAppendedByVtk);
  }
  file.clear();
  if (at != std::string::npos)
    file.seekp(static_cast<std::streamoff>(at)).write(kAppended.data(), kAppended.size());
  file.close();
  if (at == std::string::npos || !file) throw SystemError(path + ": cannot be written");
}

}  // namespace cupola
