#include "solver/collision/open_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/model/polygon_parts.hpp"

namespace cupola {
namespace {

PlanePolygon polygon_of(const CollisionModel& model, const CollisionFace& face) {
  const auto corners = model.face_corners(face);
  return PlanePolygon({corners.begin(), corners.end()});
}

void add_piece(const std::vector<Vec3>& corners, CollisionFace* face, CollisionModel* model) {
  CollisionFace piece = *face;  // in the same plane
  piece.id = static_cast<int>(model->faces.size() + model->pieces.size());
  piece.corner_start = static_cast<int>(model->corners.size());
  piece.num_corners = static_cast<int>(corners.size());
  piece.num_pieces = 0;
  piece.centroid = polygon_centroid(corners);
  piece.radius = 0.0;
  for (const Vec3& x : corners) piece.radius = std::max(piece.radius, (x - piece.centroid).norm());
  if (face->num_pieces++ == 0) face->piece_start = static_cast<int>(model->pieces.size());
  model->corners.insert(model->corners.end(), corners.begin(), corners.end());
  model->pieces.push_back(piece);
}

/// Faces [start, end) are those of one block.
void find_of_block(int start, int end, double tolerance, CollisionModel* model) {
  std::vector<PlanePolygon> polygons;  // once any two faces meet: those of most blocks do not
  for (int f = start; f < end; ++f) {
    CollisionFace& face = model->faces[f];
    if (face.kind == FaceKind::internal) continue;
    const auto meets = [&](const CollisionFace& other) {
      return face.normal.dot(other.normal) < 1e-9 - 1.0 &&
             std::abs(face.normal.dot(other.centroid - face.centroid)) <= tolerance;
    };
    if (std::none_of(model->faces.begin() + start, model->faces.begin() + end, meets)) continue;
    for (int g = start + static_cast<int>(polygons.size()); g < end; ++g)
      polygons.push_back(polygon_of(*model, model->faces[g]));
    const PlanePolygon& whole = polygons[f - start];
    const std::vector<std::vector<Vec3>> open = uncovered(whole, polygons, tolerance);
    if (open.size() == 1 && open.front() == whole.corners) continue;
    if (open.empty()) face.kind = FaceKind::internal;
    for (const std::vector<Vec3>& corners : open) add_piece(corners, &face, model);
  }
}

}  // namespace

void find_open_pieces(CollisionModel* model) {
  constexpr double kSamePlace = 1e-9;  // of the size of a block: above the rounding of coordinates
  for (int block = 0; block < model->num_blocks(); ++block) {
    const int first = model->part_start[block], last = model->part_start[block + 1] - 1;
    if (last <= first) continue;
    find_of_block(model->parts[first].face_start,
                  model->parts[last].face_start + model->parts[last].num_faces,
                  kSamePlace * model->block_radius[block], model);
  }
}

}  // namespace cupola
