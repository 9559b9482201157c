#include "postproc/mechanics/skin_facet.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "postproc/mechanics/cut_facet.hpp"

namespace cupola {
namespace {

constexpr double kTouching = 1e-6;  // of the length of an edge: parts of a stone meet within rounding

struct Edge {
  Vec3 from, to;
};

using Line = std::vector<Vec3>;  // corners, m

/// The edges of `face` that it shares with faces of the given kind of the same part.
std::vector<size_t> edges_on(const Assembly& assembly, const Part& part, std::span<const int> face,
                             FaceKind kind) {
  std::vector<size_t> edges;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    if (assembly.face_kinds[f] != kind) continue;
    const auto skin = assembly.face(f);
    for (size_t i = 0; i < face.size(); ++i)
      for (size_t j = 0; j < skin.size(); ++j)  // neighbouring faces run along an edge in opposite directions
        if (face[i] == skin[(j + 1) % skin.size()] && face[(i + 1) % face.size()] == skin[j])
          edges.push_back(i);
  }
  return edges;
}

Edge edge_of(const Assembly& assembly, int f, size_t i) {
  const auto face = assembly.face(f);
  return {assembly.vertices[face[i]], assembly.vertices[face[(i + 1) % face.size()]]};
}

/// The shares of an edge, from .. to, along which another face of the same bed lies.
std::vector<std::pair<double, double>> covered_by(const Assembly& assembly, const Edge& edge, int f) {
  std::vector<std::pair<double, double>> covered;
  const Vec3 along = edge.to - edge.from;
  const double length2 = along.squaredNorm();
  const auto is_beside = [&](const Vec3& p) {
    return along.cross(p - edge.from).norm() > kTouching * length2;
  };
  for (size_t i = 0; i < assembly.face(f).size(); ++i) {
    const Edge other = edge_of(assembly, f, i);
    if (is_beside(other.from) || is_beside(other.to)) continue;
    const double from = std::max(0.0, along.dot(other.to - edge.from) / length2);  // runs the other way
    const double to = std::min(1.0, along.dot(other.from - edge.from) / length2);
    if (to - from > kTouching) covered.emplace_back(from, to);
  }
  return covered;
}

/// The faces of the bed of a stone that its parts form together with face `f`, by their numbers.
std::vector<BedFace> bed_of_stone(const Assembly& assembly, const Part& part, int f) {
  std::vector<BedFace> others, bed{{&part, f}};
  auto p = std::ranges::lower_bound(assembly.parts, part.block, {}, &Part::block);
  for (; p != assembly.parts.end() && p->block == part.block; ++p)
    for (int g = p->face_start; g < p->face_start + p->num_faces; ++g)
      if (&*p != &part && p->ring == part.ring && assembly.face_kinds[g] == assembly.face_kinds[f])
        others.push_back({&*p, g});
  for (size_t i = 0; i < bed.size(); ++i) {
    const auto meets = [&, at = bed[i].face](const BedFace& other) {
      const auto normal = [&](int g) { return polygon_plane(face_points(assembly, g)).normal; };
      if (normal(at).dot(normal(other.face)) <= 0.0) return false;
      for (size_t e = 0; e < assembly.face(at).size(); ++e)
        if (!covered_by(assembly, edge_of(assembly, at, e), other.face).empty()) return true;
      return false;
    };
    const auto found = std::stable_partition(others.begin(), others.end(), std::not_fn(meets));
    bed.insert(bed.end(), found, others.end());
    others.erase(found, others.end());
  }
  std::ranges::sort(bed, {}, &BedFace::face);
  return bed;
}

/// Adds the pieces of an edge that no other part of the stone covers. True if these are the whole edge.
bool add_bare(const Assembly& assembly, const std::vector<BedFace>& bed, const Edge& edge,
              std::vector<Edge>* pieces) {
  std::vector<std::pair<double, double>> covered;
  for (const BedFace& other : bed)
    for (const auto& range : covered_by(assembly, edge, other.face)) covered.push_back(range);
  std::ranges::sort(covered);
  covered.emplace_back(1.0, 1.0);
  double end = 0.0;
  for (const auto& [from, to] : covered) {
    const auto at = [&](double share) -> Vec3 { return edge.from + share * (edge.to - edge.from); };
    if (from - end > kTouching) pieces->push_back({at(end), at(from)});
    end = std::max(end, to);
  }
  return covered.size() == 1;
}

/// The edges as one line without the corners at which it goes straight on; empty if they form several.
Line joined(std::vector<Edge> edges) {
  Line line;
  const auto meet = [](const Edge& before, const Edge& after) {
    return (after.from - before.to).norm() <= kTouching * (after.to - after.from).norm();
  };
  const auto first = std::ranges::find_if(edges, [&](const Edge& edge) {
    return std::ranges::none_of(edges, [&](const Edge& before) { return meet(before, edge); });
  });
  if (first == edges.end()) return line;
  Edge last = *first;
  edges.erase(first);
  line.push_back(last.from);
  while (!edges.empty()) {
    const auto next = std::ranges::find_if(edges, [&](const Edge& edge) { return meet(last, edge); });
    if (next == edges.end()) return {};
    const Vec3 whole = next->to - line.back();
    if (whole.cross(last.to - line.back()).norm() > kTouching * whole.squaredNorm()) line.push_back(last.to);
    last = *next;
    edges.erase(next);
  }
  line.push_back(last.to);
  return line;
}

/// Shares of its length at which a line has its corners.
std::vector<double> places_of_corners(const Line& line) {
  std::vector<double> places{0.0};
  for (size_t i = 1; i < line.size(); ++i) places.push_back(places.back() + (line[i] - line[i - 1]).norm());
  const double length = places.back();
  for (double& place : places) place /= length;
  return places;
}

/// The line with further corners, at the given shares of its length.
Line with_corners(const Line& line, const std::vector<double>& places) {
  const std::vector<double> own = places_of_corners(line);
  Line out;
  for (const double place : places) {
    const auto next = std::min<std::ptrdiff_t>(std::ranges::upper_bound(own, place) - own.begin(),
                                               static_cast<std::ptrdiff_t>(own.size()) - 1);
    const double share = (place - own[next - 1]) / (own[next] - own[next - 1]);
    out.push_back(line[next - 1] + share * (line[next] - line[next - 1]));
  }
  return out;
}

/// The lines along the two skins of a bent stone, with as many corners each: of stones with one bend these
/// are those of the mitre.
std::optional<std::pair<Line, Line>> skins_of(const Assembly& assembly, const std::vector<BedFace>& bed) {
  std::vector<Edge> inner, outer;
  bool bent = false;
  for (const auto& [part, f] : bed) {
    const auto face = assembly.face(f);
    const auto inside = edges_on(assembly, *part, face, FaceKind::intrados);
    const auto outside = edges_on(assembly, *part, face, FaceKind::extrados);
    bent = bent || inside.size() > 1 || outside.size() > 1;
    for (const size_t i : inside) bent = !add_bare(assembly, bed, edge_of(assembly, f, i), &inner) || bent;
    for (const size_t i : outside) bent = !add_bare(assembly, bed, edge_of(assembly, f, i), &outer) || bent;
  }
  if (!bent) return std::nullopt;
  for (Edge& edge : outer) std::swap(edge.from, edge.to);  // along the inner ones
  Line a = joined(std::move(inner)), b = joined(std::move(outer));
  if (a.empty() || b.empty()) return std::nullopt;
  if (a.size() != b.size()) {
    std::vector<double> places = places_of_corners(a);
    for (const double place : places_of_corners(b)) places.push_back(place);
    std::ranges::sort(places);
    const auto same = [](double p, double q) { return q - p <= kTouching; };
    places.erase(std::unique(places.begin(), places.end(), same), places.end());
    a = with_corners(a, places);
    b = with_corners(b, places);
  }
  return std::pair{std::move(a), std::move(b)};
}

}  // namespace

void add_skin_facet(const Assembly& assembly, const Part& part, int f, std::vector<BedFacet>* bed) {
  const bool internal = assembly.face_kinds[f] == FaceKind::internal;
  const std::vector<BedFace> whole = internal ? std::vector<BedFace>{} : bed_of_stone(assembly, part, f);
  if (const auto skins = skins_of(assembly, whole)) {
    if (f != whole.front().face) return;  // added with that
    const auto& [inner, outer] = *skins;
    for (size_t i = 1; i < inner.size(); ++i)
      bed->push_back({part.block, inner[i - 1], inner[i], outer[i - 1], outer[i], internal});
    return;
  }
  const auto face = assembly.face(f);
  const size_t n = face.size();
  for (const size_t i : edges_on(assembly, part, face, FaceKind::intrados))
    for (const size_t o : edges_on(assembly, part, face, FaceKind::extrados)) {
      if ((i + 1) % n == o || (o + 1) % n == i) continue;
      // Going round the face, the two edges run in opposite directions.
      const Edge inner = edge_of(assembly, f, i), outer = edge_of(assembly, f, o);
      bed->push_back({part.block, inner.from, inner.to, outer.to, outer.from, internal});
      return;
    }
}

}  // namespace cupola
