#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "postproc/mechanics/shell.hpp"

namespace cupola {
namespace {

/// Sine of the angle between n and the direction from ring to ring, below which the skin is level: rounding
/// of a model 1 km from the origin. The flattest stones beside a crown have 0.04.
constexpr double kLevel = 1e-9;

/// Per free block of a shell with wythes, the mean vector from the inner to the outer edges of its bed
/// facets, m. Zero in other shells and without a bed of its own.
std::vector<Vec3> through_blocks(const Assembly& assembly, const Shell& shell) {
  std::vector<Vec3> through(assembly.blocks.size(), Vec3::Zero());
  std::vector<int> edges(through.size(), 0);
  if (assembly.members.empty()) return through;
  for (const auto& bed : shell.beds)
    for (const BedFacet& f : bed) {
      if (assembly.blocks[f.block].fixed) continue;
      through[f.block] += f.extrados_a + f.extrados_b - f.intrados_a - f.intrados_b;
      edges[f.block] += 2;
    }
  for (size_t b = 0; b < through.size(); ++b)
    if (edges[b] > 0) through[b] /= edges[b];
  return through;
}

/// Unit direction across n which most of the heads of a block face, by area. Zero where they face several
/// ways, as in the stone over a crossing, and without heads, as in a key stone.
Vec3 along_heads(const Assembly& assembly, int block, const Vec3& n) {
  Mat3 facing = Mat3::Zero();
  for (auto part = std::ranges::lower_bound(assembly.parts, block, {}, &Part::block);
       part != assembly.parts.end() && part->block == block; ++part)
    for (int f = part->face_start; f < part->face_start + part->num_faces; ++f) {
      if (assembly.face_kinds[f] != FaceKind::head) continue;
      const std::vector<Vec3> polygon = face_points(assembly, f);
      const Vec3 normal = polygon_plane(polygon).normal, across = normal - normal.dot(n) * n;
      facing += polygon_area(polygon) * across * across.transpose();
    }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(facing);  // the largest last
  constexpr double kMost = 2.0;
  return eigen.eigenvalues()[2] > kMost * eigen.eigenvalues()[1] ? Vec3(eigen.eigenvectors().col(2))
                                                                 : Vec3(Vec3::Zero());
}

}  // namespace

std::vector<ShellAxes> shell_axes(const Assembly& assembly, const Shell& shell) {
  std::vector<ShellAxes> axes(assembly.blocks.size());
  std::vector<double> skin_area(axes.size(), 0.0), hidden_area(axes.size(), 0.0);  // m2, hidden: by wythes
  std::vector<char> has_inner(axes.size(), 0), has_outer(axes.size(), 0);
  if (shell.num_rings() == 0) return axes;
  for (const Part& part : assembly.parts) {
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const FaceKind kind = assembly.face_kinds[f];
      if (kind != FaceKind::intrados && kind != FaceKind::extrados && kind != FaceKind::wythe) continue;
      const std::vector<Vec3> polygon = face_points(assembly, f);
      const double area = polygon_area(polygon);
      if (kind == FaceKind::wythe) {
        hidden_area[part.block] += area;
        continue;
      }
      axes[part.block].n += (kind == FaceKind::extrados ? area : -area) * polygon_plane(polygon).normal;
      skin_area[part.block] += area;
      (kind == FaceKind::extrados ? has_outer : has_inner)[part.block] = 1;
    }
  }
  const std::vector<Vec3> through = through_blocks(assembly, shell);
  for (size_t b = 0; b < axes.size(); ++b) {
    const Block& block = assembly.blocks[b];
    ShellAxes& a = axes[b];
    const bool has_skin = skin_area[b] > 0.0;
    if (!has_skin) a.n = through[b];  // between two wythes
    if (block.ring < 0 || a.n.norm() == 0.0) continue;
    a.n.normalize();
    const Vec3& progress = shell.direction(block.ring);
    a.m = progress - progress.dot(a.n) * a.n;
    if (a.m.norm() <= kLevel) {
      const Vec3 along = along_heads(assembly, static_cast<int>(b), a.n);
      a.pole = along.isZero(0.0);
      a.m = a.pole ? a.n.unitOrthogonal() : Vec3(a.n.cross(along));
    }
    a.m.normalize();
    a.t = a.m.cross(a.n);
    if (has_inner[b] && has_outer[b])  // also beside a pilaster, which hides part of a skin
      a.thickness = 2.0 * block.volume / (skin_area[b] + hidden_area[b]);
    else
      a.thickness = has_skin ? block.volume / skin_area[b] : through[b].norm();
    CUPOLA_ASSERT(std::isfinite(a.thickness) && std::abs(a.t.norm() - 1.0) < 1e-9);
    a.exists = true;
  }
  return axes;
}

std::vector<Vec3> shifts_by_wythe(const Assembly& assembly, const Shell& shell) {
  std::vector<Vec3> shifts = through_blocks(assembly, shell);
  for (size_t b = 0; b < shifts.size(); ++b)
    shifts[b] = shell.wythes_inside(static_cast<int>(b)) * shifts[b].stableNormalized();
  return shifts;
}

}  // namespace cupola
