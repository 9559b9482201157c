#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_block_density(Section& s, BlockDensity& change) {
  s.texts("blocks", change.blocks, "names of the blocks; required");
  s.rule(!change.blocks.empty(), "blocks",
         "must name a block: material.density is that of all without one of their own");
  s.required_number("density", change.density, {.unit = "kg/m3", .above = 0}, "density of these blocks");
}

}  // namespace

void declare_import(Section& s, ImportedBlocks& import) {
  s.file("file", import.path, "file, or folder of files, with the blocks to import", true);
  s.choice("format", import.format,
           "format of the file; automatic: chosen by the file name extension (.json: compas, .csv and .txt: "
           "bricks)");
  s.optional_number("metres_per_unit", import.metres_per_unit, {.unit = "m", .above = 0}, "1",
                    "length of the file's unit in metres; required if the model would be larger than 1 km or "
                    "smaller than 50 mm");
  s.choice("up", import.up, "axis of the file that points upward");
  s.texts("supports", import.supports, "names of the blocks to fix");
  s.flag("flagged_supports", import.flagged_supports, "fix the blocks that the file marks as fixed");
  s.optional_number("fixed_below", import.fixed_below, {.unit = "m"}, "none",
                    "fix the blocks whose centroid lies below this height");
  s.choice("fixed_by", import.fixed_by,
           "fix the blocks with a corner in the lowest plane of the model, or those with a single neighbour");
  s.optional_vector3("axis", import.axis, {.unit = "m"}, "through the centroid of the supports",
                     "a point of the vertical axis from which `outward` points");
  s.list("densities", import.densities, "densities of particular blocks", declare_block_density);
  s.file("springs", import.springs, "file of springs that carry tension only (brick CSV)");
  s.file("rods", import.rods, "file of rigid rods (brick CSV)");
  s.optional_number(
      "facet_angle", import.facet_angle, {.unit = "rad", .above = 0, .max = 0.1}, "from the data",
      "merge neighbouring triangles whose normals differ by less than this into one plane facet");
  s.optional_number("snap", import.snap, {.unit = "m", .min = 0}, "from the data",
                    "move facing facets closer than this into a common plane; 0: leave them");
  s.retired("weld",
            "remove it: vertices closer than 1e-6 of the block size are merged; let the program that made "
            "the file merge others");
  s.retired("most_overlap", "contact.margin is the largest overlap, in all programs");
  s.retired("joint_gap", "contact.margin is the largest gap of a joint, in all programs");
}

}  // namespace cupola
