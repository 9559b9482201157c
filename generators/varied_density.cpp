#include "generators/varied_density.hpp"

#include <vector>

#include "assembly/model/random_field.hpp"

namespace cupola {

void vary_density(const Imperfections& imperfections, Assembly* assembly) {
  if (imperfections.density == 0.0) return;
  const RandomField field(imperfections.seed, "density", *imperfections.correlation_length,
                          imperfections.density);
  std::vector<double> volume(assembly->blocks.size(), 0.0), sum(assembly->blocks.size(), 0.0);
  for (const Part& part : assembly->parts) {
    const Vec3& apex = assembly->vertices[assembly->face(part.face_start)[0]];
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const auto ids = assembly->face(f);
      const Vec3& a = assembly->vertices[ids[0]];
      for (size_t i = 2; i < ids.size(); ++i) {
        const Vec3 &b = assembly->vertices[ids[i - 1]], &c = assembly->vertices[ids[i]];
        const double six = (a - apex).dot((b - apex).cross(c - apex));
        if (!(six > 0.0)) continue;  // faces through the apex
        volume[part.block] += six;
        sum[part.block] += six * field.at(0.25 * (apex + a + b + c));
      }
    }
  }
  for (size_t i = 0; i < assembly->blocks.size(); ++i) {
    Block& block = assembly->blocks[i];
    if (block.fixed) continue;
    const double factor = sum[i] / volume[i];
    block.density *= factor;
    block.mass *= factor;
    block.inertia *= factor;
  }
}

}  // namespace cupola
