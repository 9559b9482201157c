#include "postproc/pictures/view_parts.hpp"

namespace cupola {

Colour bond_colour(const Block& block) {
  if (block.fixed) return kSupport;
  if (block.kind == BlockKind::herringbone) return kUpright;
  if (block.kind == BlockKind::imported) return kImported;
  return block.rib ? kCorner : kFlat;
}

Vec3 view_direction(const Evaluation& e) {
  return is_vault(e) ? Vec3(0.35, 1.0, -0.33) : Vec3(0.45, 1.0, -0.25);
}

void Coloured::add(const BlockSurface& more, const Colour& colour) {
  const int first = static_cast<int>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (std::vector<int> face : more.faces) {
    for (int& v : face) v += first;
    surface.faces.push_back(std::move(face));
    colours.push_back(colour);
  }
}

void Coloured::paint(Painter* painter, double opacity) const {
  painter->add_faces(surface.vertices, surface.faces, colours, opacity);
  if (opacity == 1.0) painter->add_edges(surface.vertices, surface.faces);
}

}  // namespace cupola
