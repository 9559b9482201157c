#include <fmt/format.h>

#include "assembly/export/formats.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

/// The label of a block, with %XX instead of what would end the line or vanish when it is read. A # begins a
/// comment only at the start of a word.
std::string obj_name(const ExportModel& model, size_t block) {
  const std::string label = block_label(model.assembly, static_cast<int>(block));
  const size_t first = label.find_first_not_of(' '), last = label.find_last_not_of(' ');
  std::string name;
  for (size_t i = 0; i < label.size(); ++i) {
    const auto c = static_cast<unsigned char>(label[i]);
    const bool outer_blank = c == ' ' && (i < first || i > last);
    const bool comment = c == '#' && (i == 0 || label[i - 1] == ' ');
    const bool plain = c > 0x1f && c != 0x7f && c != '\\' && !comment && !outer_blank;
    name += plain ? std::string(1, label[i]) : fmt::format("%{:02X}", c);
  }
  return name;
}

}  // namespace

std::string obj_text(const ExportModel& model) {
  std::string text = "# Blocks in metres, z up\n";
  for (size_t b = 0; b < model.assembly.blocks.size(); ++b)
    if (model.assembly.blocks[b].fixed) text += fmt::format("# support: {}\n", obj_name(model, b));
  size_t first = 1;  // vertices are counted through the file
  const std::vector<BlockSurface> surfaces = block_surfaces(model);
  for (size_t b = 0; b < surfaces.size(); ++b) {
    text += fmt::format("o {}\n", obj_name(model, b));
    for (const Vec3& p : surfaces[b].vertices)
      text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x(), p.y(), p.z());
    for (const std::vector<int>& face : surfaces[b].faces) {
      text += "f";
      for (const int v : face) text += fmt::format(" {}", first + static_cast<size_t>(v));
      text += "\n";
    }
    first += surfaces[b].vertices.size();
  }
  return text;
}

}  // namespace cupola
