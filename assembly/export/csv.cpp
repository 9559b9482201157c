#include <fmt/format.h>

#include "assembly/export/formats.hpp"
#include "assembly/files/csv_text.hpp"

namespace cupola {
std::string blocks_csv(const ExportModel& model) {
  std::string text =
      "block,name,kind,fixed,ring,num_rings,slot,rib,density_kg_per_m3,volume_m3,mass_kg,x_m,y_m,z_m\n";
  for (size_t b = 0; b < model.assembly.blocks.size(); ++b) {
    const Block& block = model.assembly.blocks[b];
    const Vec3 p = model.placed(static_cast<int>(b), block.centroid);
    text += fmt::format("{},{},{},{},{},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", b,
                        csv_text(block.name), to_string(block.kind), block.fixed ? 1 : 0, block.ring,
                        block.num_rings, block.slot, block.rib ? 1 : 0, block.density, block.volume,
                        block.mass, p.x(), p.y(), p.z());
  }
  return text;
}

}  // namespace cupola
