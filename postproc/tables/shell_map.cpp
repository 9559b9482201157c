#include "postproc/tables/shell_map.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "postproc/evaluation/meridians.hpp"

namespace cupola {
namespace {

/// Share of the thickness that a wythe takes on a bed; on the nearest bed where its layers are known, if they
/// are not.
double share_of(const Shell& shell, int bed, int wythe) {
  const int beds = static_cast<int>(shell.layers.size());
  for (int away = 0; away < beds; ++away)
    for (const int near : {bed - away, bed + away}) {
      if (near < 0 || near >= beds) continue;
      const double share = shell.layers[near][wythe + 1] - shell.layers[near][wythe];
      if (share > 0.0) return share;  // false for NaN
    }
  return 1.0;
}

/// The sheet in which a wythe has its first facet; none if it has no facet.
const Sheet* sheet_of_wythe(const Evaluation& e, int wythe) {
  for (int ring = 0; ring < e.shell.num_rings(); ++ring)
    for (const BedFacet& f : e.shell.beds[ring])
      if (e.shell.wythes[f.block].contains(wythe)) return e.assembly.sheet_of(ring);
  return nullptr;
}

/// Azimuth of the courses of a wall, in which the edges of its beds run, from its own x axis: towards that, or
/// towards its y axis where it runs along it.
double along_wall(const Shell& shell, const Sheet& wall) {
  constexpr double kRounding = 1e-6;  // rad
  double xx = 0.0, xy = 0.0, yy = 0.0;
  const int end = std::min(wall.first_ring + wall.num_rings, shell.num_rings());
  for (int ring = wall.first_ring; ring < end; ++ring)
    for (const BedFacet& f : shell.beds[ring]) {
      const Vec3 edge = f.intrados_b - f.intrados_a;
      xx += edge.x() * edge.x();
      xy += edge.x() * edge.y();
      yy += edge.y() * edge.y();
    }
  const double angle = std::remainder(0.5 * std::atan2(2.0 * xy, xx - yy) - wall.turn, std::numbers::pi);
  return angle < kRounding - 0.5 * std::numbers::pi ? angle + std::numbers::pi : angle;
}

/// True of a rectangle around a bed, and of the bed of a crown course, which is upright and spans other webs.
bool hides_others(const BedFacet& f, const Vec3& along) {
  constexpr double kUpright = 0.1;  // sine
  const Vec3 normal = (f.intrados_b - f.intrados_a).cross(f.extrados_a - f.intrados_a).normalized();
  return f.around || std::abs(normal.dot(along)) < kUpright;
}

/// Adds the blocks on the beds of the map's wythe. Of the forces of a bonder it has the part in the wythe:
/// mean stress times the thickness of the wythe.
void add_boxes(const Evaluation& e, const Sheet& axis, ShellMap* out) {
  struct Extent {
    double from, to;
    double part;        // of the block's thickness
    double turn = 0.0;  // rad, along the facets
  };
  const Abscissa across = abscissa_of(e.shell, axis), along = out->arch ? across.turned() : across;
  const auto place = [&](const Vec3& point) {
    return out->vault ? azimuth(axis.own(point)) : along.of(point);
  };
  std::map<std::pair<int, int>, Extent> extents;  // (block, ring)
  for (int ring = out->first_ring; ring < out->num_rings; ++ring) {
    for (const BedFacet& f : e.shell.beds[ring]) {
      if (hides_others(f, e.shell.direction(ring)) || !e.shell.wythes[f.block].contains(out->number))
        continue;
      const double a = place(f.intrados_a);
      const double part =
          e.shell.wythes[f.block].count() == 1 ? 1.0 : share_of(e.shell, ring, out->number) / (f.to - f.from);
      Extent& extent = extents.try_emplace({f.block, ring}, Extent{a, a, part}).first->second;
      for (const Vec3& p : {f.intrados_a, f.intrados_b}) {
        const double c = out->vault ? extent.from + wrapped(place(p) - extent.from) : place(p);
        extent = {std::min(extent.from, c), std::max(extent.to, c), part, extent.turn};
      }
      if (out->vault) extent.turn += wrapped(place(f.intrados_b) - a);
    }
  }
  constexpr double kAround = 2.0 * std::numbers::pi * (1.0 - 1e-9);  // but for rounding
  const double unit = out->vault ? kDegrees : 1.0;
  for (auto& [key, extent] : extents) {
    if (std::abs(extent.turn) >= kAround) {  // a key stone, whose last facet ends where the first begins
      extent.from = -std::numbers::pi;
      extent.to = std::numbers::pi;
    }
    const BlockFields& fields = e.last.fields[key.first];
    out->boxes.push_back({key.first, key.second, unit * extent.from, unit * extent.to,
                          extent.part * fields.meridional_force, extent.part * fields.hoop_force,
                          fields.friction_use, fields.kern});
  }
}

void read_boxes(const std::string& path, ShellMap* map) {
  const CsvFile csv = read_csv(path);
  for (size_t i = 0; i < csv.rows.size(); ++i) {
    const auto number = [&](const char* key) { return csv.number(i, csv.column(key)); };
    map->boxes.push_back({static_cast<int>(number("block")), static_cast<int>(number("ring")), number("from"),
                          number("to"), number("meridional_force_N_per_m"), number("hoop_force_N_per_m"),
                          number("friction_use"), number("kern_use")});
  }
  if (map->boxes.empty()) return;
  if (const auto name = std::ranges::find(csv.columns, "wythe"); name != csv.columns.end())
    map->wythe = csv.rows.front()[static_cast<size_t>(name - csv.columns.begin())];
  const auto [first, last] = std::ranges::minmax(map->boxes, {}, &ShellBox::ring);
  map->first_ring = first.ring;
  map->num_rings = last.ring + 1;
}

}  // namespace

Abscissa abscissa_of(const Shell& shell, const Sheet& sheet) {
  const bool wall = sheet.thrust_lines == Sheet::ThrustLines::none;
  return {sheet.towards(wall ? along_wall(shell, sheet) : 0.0),
          sheet.turn == 0.0 ? Vec3::Zero() : sheet.origin};
}

// clang-format off: one line per column.

const Columns<ShellBox>& shell_columns() {
  using B = ShellBox;
  static const Columns<B> columns{
      {"block", "", "index in the assembly; of a wythe, its name is in a last column, `wythe`", &B::block},
      {"ring", "", "ring of the unrolled shell", &B::ring},
      {"from", "",
       "where the block begins: azimuth in deg, in wall.csv m along the wall, in arch.csv y in m; of a "
       "turned member in its own frame",
       &B::from},
      {"to", "", "where the block ends", &B::to},
      {"meridional_force_N_per_m", "N/m",
       "meridional force per metre of ring, compression positive; 0: negligible", &B::meridional_force},
      {"hoop_force_N_per_m", "N/m", "hoop force per metre of meridian, compression positive; 0: negligible",
       &B::hoop_force},
      {"friction_use", "", "largest friction utilisation of its joints; empty: none carries a force",
       &B::friction_use},
      {"kern_use", "", "largest kern utilisation of its bed joints; empty: none carries a force", &B::kern},
  };
  return columns;
}

// clang-format on

std::string ShellMap::table_name() const {
  return vault ? "shell" : arch ? "arch" : "wall";
}

std::string ShellMap::suffix() const {
  return wythe.empty() ? "" : fmt::format("_{}", in_file_names(wythe));
}

std::vector<ShellMap> shell_maps(const Evaluation& e) {
  std::vector<ShellMap> maps;
  if (e.shell.num_rings() == 0) return maps;
  const bool named = !e.assembly.members.empty();
  Sheet all;
  all.num_rings = e.shell.num_rings();
  const Sheet& last = e.assembly.sheets.empty() ? all : e.assembly.sheets.back();
  for (int wythe = 0; wythe < e.shell.num_wythes; ++wythe) {
    const Sheet* of_wythe = sheet_of_wythe(e, wythe);
    const Sheet& sheet = of_wythe ? *of_wythe : last;
    const bool about_axis = sheet.thrust_lines == Sheet::ThrustLines::by_azimuth ||
                            sheet.thrust_lines == Sheet::ThrustLines::radial;
    maps.push_back({about_axis,
                    std::min(sheet.first_ring + sheet.num_rings, e.shell.num_rings()),
                    {},
                    named ? e.assembly.members[wythe] : "",
                    wythe,
                    sheet.thrust_lines == Sheet::ThrustLines::one,
                    sheet.first_ring});
    add_boxes(e, sheet, &maps.back());
    if (named && maps.back().boxes.empty()) maps.pop_back();
  }
  return maps;
}

std::vector<TallBox> tall_boxes(const ShellMap& map) {
  std::vector<TallBox> tall;
  for (const ShellBox& box : map.boxes) {
    if (!tall.empty()) {
      const auto& [below, rings] = tall.back();
      const double rounding = 1e-9 * std::abs(box.to - box.from);
      const bool above = box.block == below.block && box.ring == below.ring + rings;
      const bool as_wide =
          std::abs(box.from - below.from) <= rounding && std::abs(box.to - below.to) <= rounding;
      const bool as_loaded =
          box.meridional_force == below.meridional_force && box.hoop_force == below.hoop_force;
      if (above && as_wide && as_loaded) {
        ++tall.back().rings;
        continue;
      }
    }
    tall.push_back({box});
  }
  return tall;
}

Table shell_table(const ShellMap& map, std::span<const ShellBox> boxes) {
  Table table = make_table(fmt::format("{}{}", map.table_name(), map.suffix()),
                           fmt::format("Blocks of the unrolled {}, as the maps show them",
                                       map.wythe.empty() ? "shell" : fmt::format("wythe {}", map.wythe)),
                           shell_columns(), boxes);
  if (map.wythe.empty()) return table;
  table.columns.push_back({"wythe", "", "its name in the case"});  // the file's has only letters and digits
  for (auto& row : table.rows) row.emplace_back(map.wythe);
  return table;
}

std::vector<ShellMap> read_shell_maps(const std::string& post_folder) {
  namespace fs = std::filesystem;
  std::vector<ShellMap> maps;
  if (!fs::is_directory(post_folder)) return maps;
  std::set<std::string> names;
  for (const auto& file : fs::directory_iterator(post_folder))
    if (file.path().extension() == ".csv") names.insert(file.path().stem().string());
  ShellMap vault, wall, arch;
  vault.vault = arch.arch = true;
  for (const std::string& name : names)
    for (const ShellMap& kind : {wall, arch, vault}) {
      const std::string table = kind.table_name();
      if (name != table && !name.starts_with(table + "_")) continue;
      maps.push_back(kind);
      if (name != table) maps.back().wythe = name.substr(table.size() + 1);
      read_boxes((fs::path(post_folder) / (name + ".csv")).string(), &maps.back());
      break;
    }
  std::ranges::stable_sort(maps, {}, &ShellMap::first_ring);
  return maps;
}

}  // namespace cupola
