#include "assembly/files/assembly_file.hpp"

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/part_cells.hpp"

namespace cupola {
namespace {

constexpr std::int32_t kAssemblyFormatVersion = 1;
constexpr const char* kUnits = "m, kg, s, N";
constexpr std::uint8_t kRibFlag = 1;
constexpr std::uint8_t kTruncatedFlag = 2;

std::uint8_t flags_of(const Block& block) {
  return static_cast<std::uint8_t>((block.rib ? kRibFlag : 0) | (block.truncated ? kTruncatedFlag : 0));
}

/// One array with a value (or a fixed-size vector) per item.
template <class T, class Items, class Get>
MeshArray column(const char* name, const Items& items, Get get, int components = 1) {
  std::vector<T> values;
  values.reserve(items.size() * static_cast<size_t>(components));
  for (const auto& item : items) {
    const auto value = get(item);
    if constexpr (std::is_class_v<std::decay_t<decltype(value)>>)
      values.insert(values.end(), value.data(), value.data() + components);
    else
      values.push_back(static_cast<T>(value));
  }
  return {name, components, std::move(values)};
}

std::vector<MeshArray> part_arrays(const Assembly& assembly) {
  using I = std::int32_t;
  using B = std::uint8_t;
  const auto& parts = assembly.parts;
  const auto block = [&assembly](const Part& p) -> const Block& { return assembly.blocks[p.block]; };
  std::vector<I> index_in_block(parts.size(), 0);
  for (size_t i = 1; i < parts.size(); ++i)
    if (parts[i].block == parts[i - 1].block) index_in_block[i] = index_in_block[i - 1] + 1;
  return {column<I>("block", parts, [](const Part& p) { return p.block; }),
          {"part", 1, std::move(index_in_block)},
          column<I>("ring", parts, [](const Part& p) { return p.ring; }),
          column<I>("slice", parts, [](const Part& p) { return p.slice; }),
          column<I>("slot", parts, [&](const Part& p) { return block(p).slot; }),
          column<I>("sail", parts, [&](const Part& p) { return block(p).sail; }),
          column<I>("spiral", parts, [&](const Part& p) { return block(p).spiral; }),
          column<B>("kind", parts, [&](const Part& p) { return block(p).kind; }),
          column<B>("flags", parts, [&](const Part& p) { return flags_of(block(p)); }),
          column<B>("fixed", parts, [&](const Part& p) { return block(p).fixed; }),
          column<double>("volume", parts, [](const Part& p) { return p.volume; }),
          column<I>("face_start", parts, [](const Part& p) { return p.face_start; }),
          column<I>("num_faces", parts, [](const Part& p) { return p.num_faces; })};
}

std::vector<MeshArray> field_arrays(const Assembly& assembly) {
  using I = std::int32_t;
  using B = std::uint8_t;
  using S = std::vector<std::string>;
  const auto& blocks = assembly.blocks;
  return {{"format_version", 1, std::vector<I>{kAssemblyFormatVersion}},
          {"units", 1, S{kUnits}},
          {"program_version", 1, S{program_version()}},
          {"title", 1, S{assembly.title}},
          {"geometry_hash", 1, S{assembly.geometry_hash}},
          {"check_report", 1, S{assembly.check_report}},
          {"content_hash", 1, S{content_hash(assembly)}},
          {"num_rings", 1, std::vector<I>{assembly.num_rings}},
          column<B>("block_kind", blocks, [](const Block& b) { return b.kind; }),
          column<B>("block_fixed", blocks, [](const Block& b) { return b.fixed; }),
          column<B>("block_flags", blocks, flags_of),
          column<I>("block_ring", blocks, [](const Block& b) { return b.ring; }),
          column<I>("block_num_rings", blocks, [](const Block& b) { return b.num_rings; }),
          column<I>("block_slot", blocks, [](const Block& b) { return b.slot; }),
          column<I>("block_sail", blocks, [](const Block& b) { return b.sail; }),
          column<double>("block_sail_position", blocks, [](const Block& b) { return b.sail_position; }),
          column<I>("block_spiral", blocks, [](const Block& b) { return b.spiral; }),
          column<double>("block_density", blocks, [](const Block& b) { return b.density; }),
          column<double>("block_volume", blocks, [](const Block& b) { return b.volume; }),
          column<double>("block_mass", blocks, [](const Block& b) { return b.mass; }),
          column<double>(
              "block_centroid", blocks, [](const Block& b) { return b.centroid; }, 3),
          column<double>(
              "block_inertia", blocks, [](const Block& b) { return b.inertia; }, 9),
          {"face_vertex_start", 1, assembly.face_vertex_start},
          {"face_vertices", 1, assembly.face_vertices},
          column<B>("face_kind", assembly.face_kinds, [](FaceKind kind) { return kind; })};
}

/// Arrays that only a model with ties has.
void add_tie_arrays(const Assembly& assembly, std::vector<MeshArray>* arrays) {
  const std::vector<BuiltTie>& ties = assembly.ties;
  if (ties.empty()) return;
  using I = std::int32_t;
  arrays->push_back(column<I>("tie_block_a", ties, [](const BuiltTie& t) { return t.block_a; }));
  arrays->push_back(column<I>("tie_block_b", ties, [](const BuiltTie& t) { return t.block_b; }));
  arrays->push_back(column<double>(
      "tie_point_a", ties, [](const BuiltTie& t) { return t.point_a; }, 3));
  arrays->push_back(column<double>(
      "tie_point_b", ties, [](const BuiltTie& t) { return t.point_b; }, 3));
  arrays->push_back(column<double>("tie_stiffness", ties, [](const BuiltTie& t) { return t.stiffness; }));
  arrays->push_back(column<double>("tie_length", ties, [](const BuiltTie& t) { return t.length; }));
  arrays->push_back(column<std::uint8_t>("tie_pushes", ties, [](const BuiltTie& t) { return t.pushes; }));
  arrays->push_back(column<double>("tie_yield_force", ties, [](const BuiltTie& t) { return t.yield_force; }));
  arrays->push_back(column<I>("tie_chain", ties, [](const BuiltTie& t) { return t.chain; }));
  if (assembly.chains.empty()) return;
  std::vector<std::string> names;
  for (const BuiltChain& chain : assembly.chains) names.push_back(chain.name);
  arrays->push_back({"chain_name", 1, std::move(names)});
  arrays->push_back(
      column<double>("chain_height", assembly.chains, [](const BuiltChain& c) { return c.height; }));
}

/// The arrays of a mesh file by name, with a check of their number of rows.
class Columns {
 public:
  Columns(const Mesh& mesh, const std::vector<MeshArray>& arrays) : mesh_(mesh), arrays_(arrays) {}

  template <class T>
  const std::vector<T>& get(const std::string& name, size_t rows, int components = 1) const {
    const auto& values = mesh_.array<T>(arrays_, name, components);
    if (values.size() != rows * static_cast<size_t>(components))
      throw InputError(FileLocation{mesh_.file},
                       fmt::format("array `{}` has {}, expected {}", name, counted(values.size(), "value"),
                                   rows * components));
    return values;
  }
  bool has(const std::string& name) const { return mesh_.has(arrays_, name); }
  template <class T>
  const std::vector<T>& get_any_size(const std::string& name) const {
    return mesh_.array<T>(arrays_, name, 1);
  }

 private:
  const Mesh& mesh_;
  const std::vector<MeshArray>& arrays_;
};

void read_blocks(const Columns& fields, Assembly* assembly) {
  const auto& kind = fields.get_any_size<std::uint8_t>("block_kind");
  const size_t n = kind.size();
  const auto& fixed = fields.get<std::uint8_t>("block_fixed", n);
  const auto& flags = fields.get<std::uint8_t>("block_flags", n);
  const auto& ring = fields.get<std::int32_t>("block_ring", n);
  const auto& num_rings = fields.get<std::int32_t>("block_num_rings", n);
  const auto& slot = fields.get<std::int32_t>("block_slot", n);
  const auto& sail = fields.get<std::int32_t>("block_sail", n);
  const auto& sail_position = fields.get<double>("block_sail_position", n);
  const auto& spiral = fields.get<std::int32_t>("block_spiral", n);
  const auto& density = fields.get<double>("block_density", n);
  const auto& volume = fields.get<double>("block_volume", n);
  const auto& mass = fields.get<double>("block_mass", n);
  const auto& centroid = fields.get<double>("block_centroid", n, 3);
  const auto& inertia = fields.get<double>("block_inertia", n, 9);
  assembly->blocks.resize(n);
  for (size_t b = 0; b < n; ++b) {
    Block& block = assembly->blocks[b];
    block.kind = static_cast<BlockKind>(kind[b]);
    block.fixed = fixed[b] != 0;
    block.rib = (flags[b] & kRibFlag) != 0;
    block.truncated = (flags[b] & kTruncatedFlag) != 0;
    block.ring = ring[b];
    block.num_rings = num_rings[b];
    block.slot = slot[b];
    block.sail = sail[b];
    block.sail_position = sail_position[b];
    block.spiral = spiral[b];
    block.density = density[b];
    block.volume = volume[b];
    block.mass = mass[b];
    block.centroid = Vec3(centroid.data() + 3 * b);
    block.inertia = Mat3(inertia.data() + 9 * b);
  }
  if (!fields.has("block_name")) return;
  const auto& names = fields.get<std::string>("block_name", n);
  for (size_t b = 0; b < n; ++b) assembly->blocks[b].name = names[b];
}

void read_parts(const Mesh& mesh, Assembly* assembly) {
  const Columns cells(mesh, mesh.cell_data);
  const size_t n = mesh.cell_types.size();
  const auto& block = cells.get<std::int32_t>("block", n);
  const auto& ring = cells.get<std::int32_t>("ring", n);
  const auto& slice = cells.get<std::int32_t>("slice", n);
  const auto& face_start = cells.get<std::int32_t>("face_start", n);
  const auto& num_faces = cells.get<std::int32_t>("num_faces", n);
  const auto& volume = cells.get<double>("volume", n);
  assembly->parts.resize(n);
  for (size_t i = 0; i < n; ++i)
    assembly->parts[i] = {block[i], ring[i], slice[i], face_start[i], num_faces[i], volume[i]};
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
  mesh->point_data.push_back({"layer", 1, assembly.vertex_layers});
  mesh->point_data.push_back({"depth", 1, assembly.vertex_depths});
}

void read_members(const Mesh& mesh, const Columns& fields, Assembly* assembly) {
  if (!fields.has("member_name")) return;
  assembly->members = fields.get_any_size<std::string>("member_name");
  const auto& member = fields.get<std::int32_t>("block_member", assembly->blocks.size());
  for (size_t b = 0; b < assembly->blocks.size(); ++b) assembly->blocks[b].member = member[b];
  const auto& wythe = Columns(mesh, mesh.cell_data).get<std::int32_t>("wythe", assembly->parts.size());
  for (size_t i = 0; i < assembly->parts.size(); ++i) assembly->parts[i].wythe = wythe[i];
  const Columns points(mesh, mesh.point_data);
  assembly->vertex_layers = points.get<std::int32_t>("layer", assembly->vertices.size());
  assembly->vertex_depths = points.get<double>("depth", assembly->vertices.size());
}

void add_sheet_arrays(const Assembly& assembly, std::vector<MeshArray>* arrays) {
  const std::vector<Sheet>& sheets = assembly.sheets;
  if (sheets.empty()) return;
  using I = std::int32_t;
  using B = std::uint8_t;
  std::vector<std::string> names;
  for (const Sheet& sheet : sheets) names.push_back(sheet.name);
  arrays->push_back({"sheet_name", 1, std::move(names)});
  arrays->push_back(column<I>("sheet_first_ring", sheets, [](const Sheet& s) { return s.first_ring; }));
  arrays->push_back(column<I>("sheet_num_rings", sheets, [](const Sheet& s) { return s.num_rings; }));
  arrays->push_back(column<B>("sheet_closed", sheets, [](const Sheet& s) { return s.closed; }));
  arrays->push_back(column<B>("sheet_thrust_lines", sheets, [](const Sheet& s) { return s.thrust_lines; }));
  arrays->push_back(column<I>("sheet_sails", sheets, [](const Sheet& s) { return s.sails; }));
  arrays->push_back(column<B>("sheet_on_previous", sheets, [](const Sheet& s) { return s.on_previous; }));
  arrays->push_back(column<double>(
      "sheet_origin", sheets, [](const Sheet& s) { return s.origin; }, 3));
  arrays->push_back(column<double>("sheet_turn", sheets, [](const Sheet& s) { return s.turn; }));
}

/// The sheet of a file of version 0.2, which does not state it: those programs put one box below a wall and two behind the
/// ends of an arch.
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

void read_sheets(const Columns& fields, Assembly* assembly) {
  if (!fields.has("sheet_name")) {
    if (assembly->num_rings > 0) assembly->sheets = {assumed_sheet(*assembly)};
    return;
  }
  const auto& name = fields.get_any_size<std::string>("sheet_name");
  const size_t n = name.size();
  const auto& first_ring = fields.get<std::int32_t>("sheet_first_ring", n);
  const auto& num_rings = fields.get<std::int32_t>("sheet_num_rings", n);
  const auto& closed = fields.get<std::uint8_t>("sheet_closed", n);
  const auto& thrust_lines = fields.get<std::uint8_t>("sheet_thrust_lines", n);
  const auto& sails = fields.get<std::int32_t>("sheet_sails", n);
  const auto& on_previous = fields.get<std::uint8_t>("sheet_on_previous", n);
  const auto& origin = fields.get<double>("sheet_origin", n, 3);
  const auto& turn = fields.get<double>("sheet_turn", n);
  for (size_t i = 0; i < n; ++i)
    assembly->sheets.push_back({name[i], first_ring[i], num_rings[i], closed[i] != 0,
                                static_cast<Sheet::ThrustLines>(thrust_lines[i]), sails[i],
                                on_previous[i] != 0,
                                Vec3(origin[3 * i], origin[3 * i + 1], origin[3 * i + 2]), turn[i]});
}

void read_ties(const Mesh& mesh, const Columns& fields, Assembly* assembly) {
  if (!mesh.has(mesh.field_data, "tie_block_a")) return;
  const auto& block_a = fields.get_any_size<std::int32_t>("tie_block_a");
  const size_t n = block_a.size();
  const auto& block_b = fields.get<std::int32_t>("tie_block_b", n);
  const auto& point_a = fields.get<double>("tie_point_a", n, 3);
  const auto& point_b = fields.get<double>("tie_point_b", n, 3);
  const auto& stiffness = fields.get<double>("tie_stiffness", n);
  const auto& length = fields.get<double>("tie_length", n);
  const auto& pushes = fields.get<std::uint8_t>("tie_pushes", n);
  const auto& yield_force = fields.get<double>("tie_yield_force", n);
  const auto& chain = fields.get<std::int32_t>("tie_chain", n);
  for (size_t k = 0; k < n; ++k)
    assembly->ties.push_back({block_a[k], block_b[k], Vec3(point_a.data() + 3 * k),
                              Vec3(point_b.data() + 3 * k), stiffness[k], length[k], pushes[k] != 0,
                              yield_force[k], chain[k]});
  if (!fields.has("chain_name")) return;
  const auto& name = fields.get_any_size<std::string>("chain_name");
  const auto& height = fields.get<double>("chain_height", name.size());
  for (size_t c = 0; c < name.size(); ++c) assembly->chains.push_back({name[c], height[c]});
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
    require(sheet.first_ring == first && sheet.num_rings > 0 &&
                sheet.num_rings <= assembly.num_rings - first && sheet.sails > 0 &&
                sheet.origin.allFinite() && std::isfinite(sheet.turn) && !(i == 0 && sheet.on_previous) &&
                sheet.thrust_lines <= Sheet::ThrustLines::by_azimuth,
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
  add_tie_arrays(assembly, &mesh.field_data);
  add_member_arrays(assembly, &mesh);
  add_sheet_arrays(assembly, &mesh.field_data);
  if (std::ranges::any_of(assembly.blocks, [](const Block& b) { return !b.name.empty(); })) {
    std::vector<std::string> names;
    for (const Block& block : assembly.blocks) names.push_back(block.name);
    mesh.field_data.push_back({"block_name", 1, std::move(names)});
  }
  for (const auto& [name, warnings] : {std::pair("block_warnings", &assembly.block_warnings),
                                       std::pair("case_warnings", &assembly.case_warnings)})
    if (!warnings->empty()) mesh.field_data.push_back({name, 1, *warnings});
  if (!options.empty()) mesh.field_data.push_back({"options", 1, std::vector<std::string>{options}});
  write_mesh(path, mesh);
}

Assembly read_assembly(const std::string& path) {
  const Mesh mesh = read_mesh(path);
  const Columns fields(mesh, mesh.field_data);
  if (!mesh.has(mesh.field_data, "format_version"))
    throw InputError(FileLocation{path}, "is not an assembly file: field array `format_version` is missing");
  if (const int version = mesh.field<std::int32_t>("format_version"); version != kAssemblyFormatVersion)
    throw InputError(
        FileLocation{path},
        fmt::format("has format version {}, this program reads version {}; generate the assembly again",
                    version, kAssemblyFormatVersion));
  Assembly assembly;
  for (int i = 0; i < mesh.num_points(); ++i) assembly.vertices.emplace_back(mesh.points.data() + 3 * i);
  const auto& face_kinds = fields.get_any_size<std::uint8_t>("face_kind");
  assembly.face_vertex_start = fields.get<std::int32_t>("face_vertex_start", face_kinds.size() + 1);
  assembly.face_vertices = fields.get_any_size<std::int32_t>("face_vertices");
  for (const std::uint8_t kind : face_kinds) assembly.face_kinds.push_back(static_cast<FaceKind>(kind));
  assembly.title = mesh.field<std::string>("title");
  assembly.geometry_hash = mesh.field<std::string>("geometry_hash");
  assembly.check_report = mesh.field<std::string>("check_report");
  for (const auto& [name, warnings] : {std::pair("block_warnings", &assembly.block_warnings),
                                       std::pair("case_warnings", &assembly.case_warnings)})
    if (fields.has(name)) *warnings = fields.get_any_size<std::string>(name);
  assembly.num_rings = mesh.field<std::int32_t>("num_rings");
  read_parts(mesh, &assembly);
  read_blocks(fields, &assembly);
  read_ties(mesh, fields, &assembly);
  read_members(mesh, fields, &assembly);
  read_sheets(fields, &assembly);
  check(assembly, path);
  if (content_hash(assembly) != mesh.field<std::string>("content_hash"))
    throw InputError(
        FileLocation{path},
        "is damaged or was edited: its content does not match its content_hash; generate the assembly again");
  return assembly;
}

}  // namespace cupola
