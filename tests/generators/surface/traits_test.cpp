#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "generators/surface/make_surface.hpp"

namespace cupola::traits_test {
namespace {

/// One surface of each kind with its default dimensions, and an eye where there must be one.
template <size_t... I>
std::vector<Surface> every_kind(std::index_sequence<I...>) {
  std::vector<Surface> kinds{Surface(std::variant_alternative_t<I, Surface>{})...};
  for (Surface& kind : kinds)
    if (auto* vault = std::get_if<VaultSurface>(&kind)) vault->eye = 1.0;
  return kinds;
}

// 1e-12 m covers the rounding of coordinates of 50 m; open surfaces are at least 1 m long.
TEST(SurfaceTraits, ClosedSurfacesEndWhereTheyBegin) {
  for (const Surface& surface : every_kind(std::make_index_sequence<std::variant_size_v<Surface>>{})) {
    const SurfaceMap map = make_surface(surface, 4);
    const Vec3 begin = map.intrados(1.0, 0.0), end = map.intrados(1.0, map.extent);
    EXPECT_EQ((end - begin).norm() < 1e-12, traits_of(surface).closed) << "kind " << surface.index();
  }
}

}  // namespace
}  // namespace cupola::traits_test
