#include "assembly/files/assembly_file.hpp"

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/part_cells.hpp"
#include "assembly/files/record_arrays.hpp"
#include "assembly/records/assembly_record.hpp"

namespace cupola {
namespace {

constexpr std::int32_t kAssemblyFormatVersion = 1;
constexpr const char* kUnits = "m, kg, s, N";
constexpr std::uint8_t kRibFlag = 1;
constexpr std::uint8_t kTruncatedFlag = 2;

std::uint8_t flags_of(const Block& block) {
  return static_cast<std::uint8_t>((block.rib ? kRibFlag : 0) | (block.truncated ? kTruncatedFlag : 0));
}

/// One array with a value per item.
template <class T, class Items, class Get>
MeshArray column(const char* name, const Items& items, Get get) {
  std::vector<T> values;
  values.reserve(items.size());
  for (const auto& item : items) values.push_back(static_cast<T>(get(item)));
  return {name, 1, std::move(values)};
}

std::vector<MeshArray> part_arrays(const Assembly& assembly) {
  using I = std::int32_t;
  using B = std::uint8_t;
  const auto& parts = assembly.parts;
  const auto block = [&assembly](const Part& p) -> const Block& { return assembly.blocks[p.block]; };
  std::vector<I> index_in_block(parts.size(), 0);
  for (size_t i = 1; i < parts.size(); ++i)
    if (parts[i].block == parts[i - 1].block) index_in_block[i] = index_in_block[i - 1] + 1;
  std::vector<MeshArray> arrays{{"part", 1, std::move(index_in_block)},
                                column<I>("slot", parts, [&](const Part& p) { return block(p).slot; }),
                                column<I>("sail", parts, [&](const Part& p) { return block(p).sail; }),
                                column<I>("spiral", parts, [&](const Part& p) { return block(p).spiral; }),
                                column<B>("kind", parts, [&](const Part& p) { return block(p).kind; }),
                                column<B>("flags", parts, [&](const Part& p) { return flags_of(block(p)); }),
                                column<B>("fixed", parts, [&](const Part& p) { return block(p).fixed; })};
  add_rows(parts, &arrays);
  return arrays;
}

std::vector<MeshArray> field_arrays(const Assembly& assembly) {
  using I = std::int32_t;
  using B = std::uint8_t;
  using S = std::vector<std::string>;
  std::vector<MeshArray> arrays{
      {"format_version", 1, std::vector<I>{kAssemblyFormatVersion}},
      {"units", 1, S{kUnits}},
      {"program_version", 1, S{program_version()}},
      {"title", 1, S{assembly.title}},
      {"geometry_hash", 1, S{assembly.geometry_hash}},
      {"check_report", 1, S{assembly.check_report}},
      {"content_hash", 1, S{content_hash(assembly)}},
      {"num_rings", 1, std::vector<I>{assembly.num_rings}},
      {"face_vertex_start", 1, assembly.face_vertex_start},
      {"face_vertices", 1, assembly.face_vertices},
      column<B>("face_kind", assembly.face_kinds, [](FaceKind kind) { return kind; }),
      column<B>("block_flags", assembly.blocks, flags_of)};
  add_rows(assembly.blocks, &arrays);
  if (!assembly.ties.empty()) add_rows(assembly.ties, &arrays);
  if (!assembly.chains.empty()) add_rows(assembly.chains, &arrays);
  if (!assembly.sheets.empty()) add_rows(assembly.sheets, &arrays);
  return arrays;
}

/// As many as its first array has values.
template <class Row>
std::vector<Row> read_all_rows(const Mesh& mesh, const char* first) {
  const auto& arrays = mesh.field_data;
  return read_rows<Row>(mesh, arrays,
                        std::visit([](const auto& values) { return values.size(); },
                                   std::ranges::find(arrays, first, &MeshArray::name)->values));
}

void read_blocks(const Mesh& mesh, Assembly* assembly) {
  const size_t n = mesh.array<std::uint8_t>(mesh.field_data, "block_kind", 1).size();
  assembly->blocks = read_rows<Block>(mesh, mesh.field_data, n);
  const auto& flags = array_of<std::uint8_t>(mesh, mesh.field_data, "block_flags", n);
  for (size_t b = 0; b < n; ++b) {
    assembly->blocks[b].rib = (flags[b] & kRibFlag) != 0;
    assembly->blocks[b].truncated = (flags[b] & kTruncatedFlag) != 0;
  }
  if (!mesh.has(mesh.field_data, "block_name")) return;
  const auto& names = array_of<std::string>(mesh, mesh.field_data, "block_name", n);
  for (size_t b = 0; b < n; ++b) assembly->blocks[b].name = names[b];
}

/// Arrays that only a shell with wythes has.
void add_member_arrays(const Assembly& assembly, Mesh* mesh) {
  if (assembly.members.empty()) return;
  using I = std::int32_t;
  mesh->cell_data.push_back(column<I>("wythe", assembly.parts, [](const Part& p) { return p.wythe; }));
  mesh->cell_data.push_back(
      column<I>("member", assembly.parts, [&](const Part& p) { return assembly.blocks[p.block].member; }));
  mesh->field_data.push_back(
      column<I>("block_member", assembly.blocks, [](const Block& b) { return b.member; }));
  mesh->field_data.push_back({"member_name", 1, assembly.members});
  if (!assembly.member_originals.empty() && assembly.member_originals != assembly.members)
    mesh->field_data.push_back({"member_original", 1, assembly.member_originals});
  mesh->point_data.push_back({"layer", 1, assembly.vertex_layers});
  mesh->point_data.push_back({"depth", 1, assembly.vertex_depths});
}

void read_members(const Mesh& mesh, Assembly* assembly) {
  if (!mesh.has(mesh.field_data, "member_name")) return;
  assembly->members = mesh.array<std::string>(mesh.field_data, "member_name", 1);
  assembly->member_originals =
      mesh.has(mesh.field_data, "member_original")
          ? array_of<std::string>(mesh, mesh.field_data, "member_original", assembly->members.size())
          : assembly->members;
  const size_t blocks = assembly->blocks.size(), parts = assembly->parts.size(),
               corners = assembly->vertices.size();
  const auto& member = array_of<std::int32_t>(mesh, mesh.field_data, "block_member", blocks);
  for (size_t b = 0; b < blocks; ++b) assembly->blocks[b].member = member[b];
  const auto& wythe = array_of<std::int32_t>(mesh, mesh.cell_data, "wythe", parts);
  for (size_t i = 0; i < parts; ++i) assembly->parts[i].wythe = wythe[i];
  assembly->vertex_layers = array_of<std::int32_t>(mesh, mesh.point_data, "layer", corners);
  assembly->vertex_depths = array_of<double>(mesh, mesh.point_data, "depth", corners);
}

void read_sheets(const Mesh& mesh, Assembly* assembly) {
  std::vector<Sheet>& sheets = assembly->sheets;
  sheets = read_all_rows<Sheet>(mesh, "sheet_name");
  if (!mesh.has(mesh.field_data, "sheet_vault")) return;
  const auto& vault = array_of<std::int32_t>(mesh, mesh.field_data, "sheet_vault", sheets.size());
  for (size_t i = 0; i < sheets.size(); ++i) sheets[i].vault = vault[i];
}

/// The sheet of a file of version 0.2, which does not state it: those programs put one box below a wall and
/// two behind the ends of an arch.
Sheet assumed_sheet(const Assembly& assembly) {
  Sheet sheet{.name = "shell", .num_rings = assembly.num_rings};
  std::vector<int> parts(assembly.blocks.size(), 0);
  for (const Part& part : assembly.parts) ++parts[part.block];
  int boxes = 0, others = 0;
  for (size_t b = 0; b < parts.size(); ++b) {
    const Block& block = assembly.blocks[b];
    if (block.fixed) ++(parts[b] == 1 ? boxes : others);
    sheet.sails = std::max(sheet.sails, block.sail + 1);
  }
  using enum Sheet::ThrustLines;
  const bool open = others == 0 && boxes <= 2 && sheet.sails == 1;
  sheet.closed = !open;
  sheet.thrust_lines = !open ? by_azimuth : boxes == 2 ? one : none;
  return sheet;
}

/// Checks everything that later stages rely on.
void check(const Assembly& assembly, const std::string& path) {
  const auto require = [&path](bool holds, const char* what, size_t index) {
    if (!holds) throw InputError(FileLocation{path}, fmt::format("{} {} is invalid", what, index));
  };
  const int num_blocks = static_cast<int>(assembly.blocks.size());
  const int num_vertices = static_cast<int>(assembly.vertices.size());
  for (size_t v = 0; v < assembly.vertices.size(); ++v)
    require(assembly.vertices[v].allFinite(), "vertex", v);
  for (size_t v = 0; v < assembly.vertex_layers.size(); ++v)
    require(assembly.vertex_layers[v] >= -1 && assembly.vertex_depths[v] >= 0.0 &&
                assembly.vertex_depths[v] <= 1.0,
            "layer of vertex", v);
  const std::vector<int>& start = assembly.face_vertex_start;
  const int num_corners = static_cast<int>(assembly.face_vertices.size());
  require(!start.empty() && start.front() == 0 && start.back() == num_corners, "face range", 0);
  // Each start is checked against the list before the next one is compared with it, so that no sum overflows.
  for (size_t f = 0; f < assembly.face_kinds.size(); ++f)
    require(start[f + 1] <= num_corners && start[f + 1] >= start[f] + 3 &&
                assembly.face_kinds[f] <= FaceKind::wythe,
            "face", f);
  for (const int v : assembly.face_vertices) require(v >= 0 && v < num_vertices, "face vertex id", v);
  int next_face = 0;
  for (size_t i = 0; i < assembly.parts.size(); ++i) {
    const Part& part = assembly.parts[i];
    require(part.block >= 0 && part.block < num_blocks, "block of part", i);
    require(i == 0 || assembly.parts[i - 1].block <= part.block, "order of part", i);
    require(part.face_start == next_face && part.num_faces >= 4 &&
                part.num_faces <= assembly.num_faces() - next_face,
            "face range of part", i);
    next_face += part.num_faces;
  }
  require(next_face == assembly.num_faces(), "face range of part", assembly.parts.size());
  for (size_t b = 0; b < assembly.blocks.size(); ++b) {
    const Block& block = assembly.blocks[b];
    require(block.kind <= BlockKind::imported && block.density > 0.0 && block.volume > 0.0 &&
                block.mass > 0.0 && block.member >= 0 &&
                block.member < std::max(1, static_cast<int>(assembly.members.size())) &&
                block.centroid.allFinite() && block.inertia.allFinite(),
            "block", b);
  }
  for (size_t i = 0; i < assembly.sheets.size(); ++i) {
    const Sheet& sheet = assembly.sheets[i];
    const int first = i == 0 ? 0 : assembly.sheets[i - 1].first_ring + assembly.sheets[i - 1].num_rings;
    require(sheet.first_ring == first && (sheet.num_rings > 0 || assembly.num_rings == 0) &&
                sheet.num_rings <= assembly.num_rings - first && sheet.sails > 0 &&
                sheet.origin.allFinite() && std::isfinite(sheet.turn) && !(i == 0 && sheet.on_previous) &&
                sheet.thrust_lines <= Sheet::ThrustLines::radial && sheet.vault >= -1 &&
                sheet.vault < static_cast<int>(assembly.sheets.size()) &&
                (sheet.vault < 0 || assembly.sheets[sheet.vault].thrust_lines != Sheet::ThrustLines::none),
            "sheet", i);
  }
  for (size_t k = 0; k < assembly.ties.size(); ++k) {
    const BuiltTie& tie = assembly.ties[k];
    require(tie.block_a >= 0 && tie.block_a < num_blocks && tie.block_b >= 0 && tie.block_b < num_blocks &&
                tie.point_a.allFinite() && tie.point_b.allFinite() && tie.stiffness > 0.0 &&
                tie.length > 0.0 && tie.yield_force > 0.0 && tie.chain >= -1 &&
                tie.chain < static_cast<int>(assembly.chains.size()),
            "tie", k);
  }
}

}  // namespace

void write_assembly(const std::string& path, const Assembly& assembly, const std::string& options) {
  Mesh mesh;
  mesh.points.reserve(3 * assembly.vertices.size());
  for (const Vec3& v : assembly.vertices) mesh.add_point(v.x(), v.y(), v.z());
  add_part_cells(assembly, &mesh);
  mesh.cell_data = part_arrays(assembly);
  mesh.field_data = field_arrays(assembly);
  add_member_arrays(assembly, &mesh);
  if (std::ranges::any_of(assembly.blocks, [](const Block& b) { return !b.name.empty(); })) {
    std::vector<std::string> names;
    for (const Block& block : assembly.blocks) names.push_back(block.name);
    mesh.field_data.push_back({"block_name", 1, std::move(names)});
  }
  for (const auto& [name, warnings] : {std::pair("block_warnings", &assembly.block_warnings),
                                       std::pair("case_warnings", &assembly.case_warnings)})
    if (!warnings->empty()) mesh.field_data.push_back({name, 1, *warnings});
  if (std::ranges::any_of(assembly.sheets, [](const Sheet& s) { return s.vault >= 0; }))
    mesh.field_data.push_back(
        column<std::int32_t>("sheet_vault", assembly.sheets, [](const Sheet& s) { return s.vault; }));
  if (!options.empty()) mesh.field_data.push_back({"options", 1, std::vector<std::string>{options}});
  write_mesh(path, mesh);
}

Assembly read_assembly(const std::string& path) {
  const Mesh mesh = read_mesh(path);
  if (!mesh.has(mesh.field_data, "format_version"))
    throw InputError(FileLocation{path}, "is not an assembly file: field array `format_version` is missing");
  if (const int version = mesh.field<std::int32_t>("format_version"); version != kAssemblyFormatVersion)
    throw InputError(
        FileLocation{path},
        fmt::format("has format version {}, this program reads version {}; generate the assembly again",
                    version, kAssemblyFormatVersion));
  Assembly assembly;
  assembly.vertices = points_of(mesh);
  const auto& face_kinds = mesh.array<std::uint8_t>(mesh.field_data, "face_kind", 1);
  assembly.face_vertex_start =
      array_of<std::int32_t>(mesh, mesh.field_data, "face_vertex_start", face_kinds.size() + 1);
  assembly.face_vertices = mesh.array<std::int32_t>(mesh.field_data, "face_vertices", 1);
  for (const std::uint8_t kind : face_kinds) assembly.face_kinds.push_back(static_cast<FaceKind>(kind));
  assembly.title = mesh.field<std::string>("title");
  assembly.geometry_hash = mesh.field<std::string>("geometry_hash");
  assembly.check_report = mesh.field<std::string>("check_report");
  for (const auto& [name, warnings] : {std::pair("block_warnings", &assembly.block_warnings),
                                       std::pair("case_warnings", &assembly.case_warnings)})
    if (mesh.has(mesh.field_data, name)) *warnings = mesh.array<std::string>(mesh.field_data, name, 1);
  assembly.num_rings = mesh.field<std::int32_t>("num_rings");
  assembly.parts = read_rows<Part>(mesh, mesh.cell_data, mesh.cell_types.size());
  read_blocks(mesh, &assembly);
  const auto has = [&mesh](const char* name) { return mesh.has(mesh.field_data, name); };
  if (has("tie_block_a")) assembly.ties = read_all_rows<BuiltTie>(mesh, "tie_block_a");
  if (has("chain_name")) assembly.chains = read_all_rows<BuiltChain>(mesh, "chain_name");
  read_members(mesh, &assembly);
  if (has("sheet_name")) read_sheets(mesh, &assembly);
  check(assembly, path);
  if (!has("sheet_name") && assembly.num_rings > 0) assembly.sheets = {assumed_sheet(assembly)};
  if (content_hash(assembly) != mesh.field<std::string>("content_hash"))
    throw InputError(
        FileLocation{path},
        "is damaged or was edited: its content does not match its content_hash; generate the assembly again");
  return assembly;
}

}  // namespace cupola
