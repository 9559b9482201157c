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
  surface.point = [=](double bed, double x, Skin skin) {
    return Vec3(x, skin == Skin::extrados ? 0.0 : wall.thickness, wall.height * bed / rings);
  };
  return surface;
}

}  // namespace cupola
