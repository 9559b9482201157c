#include "generators/surface/wall.hpp"

namespace cupola {

SurfaceMap wall_surface(const WallSurface& wall, int rings) {
  SurfaceMap surface;
  surface.num_rows = rings;
  surface.extent = wall.length;
  surface.flat_slices = true;
  surface.flat_rings = true;
  surface.footing = Footing::plate;
  surface.shell_volume = wall.length * wall.height * wall.thickness;
  surface.at = [=](double bed, double x, double depth) {
    return Vec3(x, wall.thickness - depth, wall.height * bed / rings);
  };
  return surface;
}

}  // namespace cupola
