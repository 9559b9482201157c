#include "generators/importer/assembly_import.hpp"

#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/assembly_file.hpp"

namespace cupola {

bool is_assembly_file(const ImportedBlocks& source) {
  return source.path.ends_with(".vtu");
}

Assembly import_assembly(const ImportedBlocks& source) {
  const ImportedBlocks plain;
  const std::pair<const char*, bool> given[] = {
      {"format", source.format != plain.format},
      {"metres_per_unit", source.metres_per_unit.has_value()},
      {"up", source.up != plain.up},
      {"supports", !source.supports.empty()},
      {"flagged_supports", source.flagged_supports != plain.flagged_supports},
      {"fixed_below", source.fixed_below.has_value()},
      {"fixed_by", source.fixed_by != plain.fixed_by},
      {"axis", source.axis.has_value()},
      {"densities", !source.densities.empty()},
      {"springs", !source.springs.empty()},
      {"rods", !source.rods.empty()},
      {"facet_angle", source.facet_angle.has_value()},
      {"snap", source.snap.has_value()}};
  for (const auto& [key, is_given] : given)
    if (is_given)
      throw InputError(fmt::format(
          "geometry.import.{}: has no effect on {}, an assembly of Cupola with its supports, densities and "
          "ties; remove it",
          key, source.path));
  return read_assembly(source.path);
}

}  // namespace cupola
