#include <gtest/gtest.h>

#include "generators/surface/make_surface.hpp"

namespace cupola::traits_test {
namespace {

// 1e-12 covers the rounding of coordinates of 50 m; open surfaces are at least 1 m long.
TEST(SurfaceTraits, ClosedSurfacesEndWhereTheyBegin) {
  for (const Surface& surface : {Surface(DomeSurface{}), Surface(OctagonalVault{}), Surface(ArchSurface{}),
                                 Surface(WallSurface{})}) {
    const SurfaceMap map = make_surface(surface, 4);
    const Vec3 begin = map.point(1.0, 0.0, Skin::intrados), end = map.point(1.0, map.extent, Skin::intrados);
    EXPECT_EQ((end - begin).norm() < 1e-12, traits_of(surface).closed) << "surface " << surface.index();
  }
}

}  // namespace
}  // namespace cupola::traits_test
