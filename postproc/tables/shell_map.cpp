#include "postproc/tables/shell_map.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

namespace cupola {
namespace {

constexpr const char* kByAzimuth = "shell";
constexpr const char* kAlongX = "shell_x";

}  // namespace

// clang-format off: one line per column.

const Columns<ShellBox>& shell_columns() {
  using B = ShellBox;
  static const Columns<B> columns{
      {"block", "", "index in the assembly", &B::block},
      {"ring", "", "ring of the unrolled shell", &B::ring},
      {"from", "", "where the block begins: azimuth in deg, in shell_x.csv x in m", &B::from},
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

ShellMap shell_map(const Evaluation& e) {
  ShellMap out{is_vault(e), e.shell.num_rings(), {}};
  struct Extent {
    double from, to;
  };
  std::map<std::pair<int, int>, Extent> extents;  // (block, ring)
  for (int ring = 0; ring < out.num_rings; ++ring) {
    for (const BedFacet& f : e.shell.beds[ring]) {
      const auto place = [&](const Vec3& p) { return out.vault ? azimuth(p) : p.x(); };
      const double a = place(f.intrados_a);
      Extent& extent = extents.try_emplace({f.block, ring}, Extent{a, a}).first->second;
      for (const Vec3& p : {f.intrados_a, f.intrados_b}) {
        const double c = out.vault ? extent.from + wrapped(place(p) - extent.from) : place(p);
        extent = {std::min(extent.from, c), std::max(extent.to, c)};
      }
    }
  }
  const double unit = out.vault ? kDegrees : 1.0;
  for (const auto& [key, extent] : extents) {
    const BlockFields& fields = e.last.fields[key.first];
    out.boxes.push_back({key.first, key.second, unit * extent.from, unit * extent.to, fields.meridional_force,
                         fields.hoop_force, fields.friction_use, fields.kern});
  }
  return out;
}

Table shell_table(const ShellMap& map) {
  return make_table(map.vault ? kByAzimuth : kAlongX, "Blocks of the unrolled shell, as the maps show them",
                    shell_columns(), map.boxes);
}

std::optional<ShellMap> read_shell_map(const std::string& post_folder) {
  for (const bool vault : {true, false}) {
    const std::string path =
        (std::filesystem::path(post_folder) / (vault ? kByAzimuth : kAlongX)).string() + ".csv";
    if (!std::filesystem::exists(path)) continue;
    const CsvFile csv = read_csv(path);
    ShellMap map{vault, 0, {}};
    for (size_t i = 0; i < csv.rows.size(); ++i) {
      const auto number = [&](const char* key) { return csv.number(i, csv.column(key)); };
      map.boxes.push_back({static_cast<int>(number("block")), static_cast<int>(number("ring")),
                           number("from"), number("to"), number("meridional_force_N_per_m"),
                           number("hoop_force_N_per_m"), number("friction_use"), number("kern_use")});
      map.num_rings = std::max(map.num_rings, map.boxes.back().ring + 1);
    }
    return map;
  }
  return std::nullopt;
}

}  // namespace cupola
