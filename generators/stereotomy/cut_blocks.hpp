#pragma once

#include <optional>
#include <span>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/shell.hpp"

namespace cupola {

struct CutOptions {
  double density = 0.0;        ///< kg/m3
  double support_width = 1.0;  ///< m, by which the fixed base extends beyond the shell
  int base_blocks = 1;         ///< equal parts of the fixed ring below a closed surface
  std::optional<Imperfections> imperfections;
};

/// Cuts the surfaces of one or several storeys, from below, along their bonds into blocks with mass
/// properties. Parts are cells, merged where the union is exactly convex; all parts share one vertex table,
/// and faces of neighbouring cells of a storey are the same four vertices. Faces of different storeys lie in
/// one plane.
///
/// Block 0 is the fixed support, or the first of them where the base is divided; an arch has a second one,
/// the last block. A window with held ends has three: the end at abscissa 0, the base and the other end. The
/// others follow ring by ring in slot order, so that the lower block of every bed joint has the lower number.
Assembly cut_blocks(std::span<const Storey> storeys, const CutOptions& options);

}  // namespace cupola
