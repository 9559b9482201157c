#include <fmt/format.h>

#include "assembly/export/formats.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {

std::string obj_text(const ExportModel& model) {
  std::string text = "# Blocks in metres, z up\n";
  for (size_t b = 0; b < model.assembly.blocks.size(); ++b)
    if (model.assembly.blocks[b].fixed)
      text += fmt::format("# support: {}\n", block_label(model.assembly, static_cast<int>(b)));
  size_t first = 1;  // vertices are counted through the file
  const std::vector<BlockSurface> surfaces = block_surfaces(model);
  for (size_t b = 0; b < surfaces.size(); ++b) {
    text += fmt::format("o {}\n", block_label(model.assembly, static_cast<int>(b)));
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
