#include "generators/generate.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/geometry.hpp"
#include "assembly/case/imported_blocks.hpp"
#include "assembly/case/keys_without_effect.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/case/plausibility.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/model/applied_loads.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/block_region.hpp"
#include "assembly/model/loads_on_top.hpp"
#include "assembly/model/random_field.hpp"
#include "generators/chains.hpp"
#include "generators/importer/import_supports.hpp"
#include "generators/stereotomy/borne_vaults.hpp"
#include "generators/stereotomy/cut_blocks.hpp"
#include "generators/stereotomy/placement.hpp"
#include "generators/surface/make_surface.hpp"

namespace cupola {
namespace {

/// True for an assembly of Cupola, .vtu, such as `cupola-post export` writes of the end of a path.
bool is_assembly_file(const ImportedBlocks& source) {
  return source.path.ends_with(".vtu");
}

/// Its blocks with their courses, supports, densities and ties. Throws InputError for keys that complete the
/// files of other programs.
Assembly import_assembly(const ImportedBlocks& source) {
  const ImportedBlocks plain;
  const std::pair<const char*, bool> given[] = {
      {"format", source.format != plain.format},
      {"metres_per_unit", source.metres_per_unit.has_value()},
      {"up", source.up != plain.up},
      {"supports", !source.supports.empty()},
      {"flagged_supports", source.flagged_supports != plain.flagged_supports},
      {"fixed_below", source.fixed_below.has_value()},
      {"fixed_by", source.fixed_by != plain.fixed_by},
      {"axis", source.axis.has_value()},
      {"densities", !source.densities.empty()},
      {"springs", !source.springs.empty()},
      {"rods", !source.rods.empty()},
      {"facet_angle", source.facet_angle.has_value()},
      {"snap", source.snap.has_value()}};
  for (const auto& [key, is_given] : given)
    if (is_given)
      throw InputError(fmt::format(
          "geometry.import.{}: has no effect on {}, an assembly of Cupola with its supports, densities and "
          "ties; remove it",
          key, source.path));
  return read_assembly(source.path);
}

/// Throws InputError for a material of the case that no free block of an import takes.
void refuse_material(const Case& input) {
  if (input.material.unit_weight != Material{}.unit_weight)
    throw InputError(
        fmt::format("material: has no effect: every free block of {} has a density of its own; remove it",
                    input.geometry.imported->path));
}

/// Multiplies density, mass and inertia of each free block by the mean of a random function of place over the
/// block, by its values at the centroids of tetrahedra. Nothing if the density does not vary.
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

CutOptions cut_options(const Case& input) {
  CutOptions options;
  options.density = input.material.density();
  options.support_width = input.geometry.support_width;
  options.base_blocks = input.geometry.base_blocks;
  options.imperfections = input.geometry.imperfections;
  return options;
}

/// Volume of the smooth shell, m3; none if parts of the grid are empty or the thickness varies over the
/// height, whose breaks no extrapolation follows.
std::optional<double> smooth_volume(const Storey& shell) {
  const SurfaceMap& surface = shell.surface;
  if (has_empty_cells(shell.bond) || surface.key_stone || surface.webs > 0 || !surface.smooth_beds ||
      !shell.cuts.empty() || !std::ranges::all_of(surface.wythes, &Thickness::constant))
    return std::nullopt;
  return surface.shell_volume ? *surface.shell_volume : extrapolated_shell_volume(surface);
}

/// m3, of all storeys; none if that of one is not known.
std::optional<double> smooth_volume(const std::vector<Storey>& storeys) {
  std::optional<double> sum = 0.0;
  for (const Storey& storey : storeys) {
    const std::optional<double> volume = smooth_volume(storey);
    if (!volume) return std::nullopt;
    *sum += *volume;
  }
  return sum;
}

/// True if blocks were cut after they were laid.
bool has_cuts(const std::vector<Storey>& storeys) {
  return std::ranges::any_of(storeys, [](const Storey& s) { return !s.cuts.empty() || s.surface.webs > 0; });
}

/// Refuses a member, or what cuts leave of it, that stands on nothing. `joint_gap`: m, the widest of a joint.
void refuse_floating(const Geometry& geometry, const Assembly& assembly, const ModelReport& report,
                     double joint_gap) {
  if (!report.floating) return;
  const Block& block = assembly.blocks[*report.floating];
  const Sheet* sheet = assembly.sheet_of(block.ring);
  const double gap = geometry.imperfections ? geometry.imperfections->gap : 0.0;
  throw InputError(fmt::format(
      "geometry: a part of the member {} floats: block {} about ({:.4g}, {:.4g}, {:.4g}) m has "
      "no joint with a support or with blocks that have one{}",
      sheet ? sheet->name : "", *report.floating, block.centroid.x(), block.centroid.y(), block.centroid.z(),
      gap > joint_gap ? fmt::format("; imperfections.gap = {:g} m is wider than contact.margin, "
                                    "{:.2g} m here: reduce it, or give that margin",
                                    gap, joint_gap)
                      : ""));
}

/// The middle between a member and its first copy or mirror image, as a place for an arch; "" without.
std::string place_between(const Storey& member, const std::vector<Storey>& storeys) {
  const auto is_copy = [&](const Storey& other) { return other.key == member.key && &other != &member; };
  const auto copy = std::ranges::find_if(storeys, is_copy);
  if (copy == storeys.end()) return {};
  const Vec3 middle = 0.5 * (member.placement.translation() + copy->placement.translation());
  return fmt::format(", here {{origin: [{:.6g}, {:.6g}, 0]}}", middle.x(), middle.y());
}

/// Refuses a member beside the one on which it stands: its other end, on a support, may hold it in the air.
void refuse_misplaced(const std::vector<Storey>& storeys, const ModelReport& report) {
  for (int i = 1; i < static_cast<int>(storeys.size()); ++i)
    if (storeys[i].stands_on_previous && !report.joined_sheets.contains({i - 1, i}))
      throw InputError(fmt::format(
          "{}.on = {}: nothing of {} touches {}, on whose axis it stands; an arch on two walls, which are "
          "copies, requires `at` in the middle between them{}, a half arch on one a `straight` vault of its "
          "span and plan as its pier",
          storeys[i].key, storeys[i - 1].name, storeys[i].name, storeys[i - 1].name,
          place_between(storeys[i - 1], storeys)));
}

/// Refuses an arch on several copies of a member that has none under one of its feet.
void refuse_hanging_feet(const std::vector<Storey>& storeys, const ModelReport& report) {
  for (const Storey& arch : storeys) {
    const SurfaceMap& surface = arch.surface;
    const bool on_its_own = surface.first_bed_held || surface.first_row_held || surface.last_bed_held;
    if (arch.stands_on_previous || on_its_own || surface.closed || surface.webs > 0) continue;
    const int first = surface.rings_below, last = first + arch.num_rings() - 1;
    for (const auto& [ring, bed] : {std::pair(first, 0), std::pair(last, surface.num_rows)}) {
      if (report.is_borne[ring]) continue;
      const Vec3 foot = arch.placement * surface.intrados(bed, 0.0);
      throw InputError(
          fmt::format("{}.at: nothing stands under the foot of {} at ({:.4g}, {:.4g}, {:.4g}) m; "
                      "each foot needs a pier that ends there",
                      arch.key, arch.name, foot.x(), foot.y(), foot.z()));
    }
  }
}

std::vector<GenerateReport::Springing> springings_of(const std::vector<Storey>& storeys) {
  std::vector<GenerateReport::Springing> springings;
  for (const Storey& vault : storeys)
    if (vault.surface.springers > 0)
      springings.push_back({vault.name, vault.placement.translation().z(),
                            vault.placement.translation().z() + level_of_springers(vault)});
  return springings;
}

Assembly cut_storeys(const Case& input, const std::vector<Storey>& storeys) {
  Assembly assembly = cut_blocks(storeys, cut_options(input));
  if (input.geometry.imperfections) vary_density(*input.geometry.imperfections, &assembly);
  add_chains(input.geometry.chains, storeys, &assembly);
  assembly.title = input.title;
  assembly.geometry_hash = input.geometry_hash;
  return assembly;
}

/// The case with numbers for the names of blocks. Throws InputError for blocks, members and faces that the
/// assembly does not have: the solver would refuse them later.
Case resolved_case(const Case& input, const Assembly& assembly) {
  Case resolved = input;
  resolve_block_names(assembly, &resolved.loads, &resolved.ties, &resolved.supports);
  resolve_block_names(assembly, &resolved.analysis.range.quantities);
  applied_loads(resolved.loads, assembly);
  if (seeks_lantern(resolved.analysis)) require_top_for_lantern(assembly, resolved.loads.gravity.norm());
  for (size_t i = 0; i < resolved.supports.moves.size(); ++i)
    blocks_of_region(resolved.supports.moves[i].region, assembly, true, fmt::format("supports.moves[{}]", i));
  for (size_t i = 0; i < resolved.loads.heat.size(); ++i)
    blocks_of_region(resolved.loads.heat[i].region, assembly, false, fmt::format("loads.heat[{}]", i));
  return resolved;
}

/// The assembly with what the checks found and what is doubtful about its case.
Assembly with_report(Assembly assembly, const GenerateReport& report, const Case& scene) {
  assembly.check_report = to_text(report);
  assembly.block_warnings = warnings_of(report);
  assembly.case_warnings = scene.warnings;
  for (std::string& text : implausible_for_blocks(scene, assembly))
    assembly.case_warnings.push_back(std::move(text));
  return assembly;
}

/// An imported assembly of Cupola, checked as its joints are found by the solver.
Assembly assembly_again(const Case& input, GenerateReport* report) {
  refuse_material(input);
  Assembly assembly = import_assembly(*input.geometry.imported);
  if (input.geometry.imperfections) vary_density(*input.geometry.imperfections, &assembly);
  assembly.title = input.title;
  assembly.geometry_hash = input.geometry_hash;
  report->model = check_model(
      assembly,
      imported_tolerances(assembly, 0.0, joint_rule(smallest_block_size(assembly), input.contact.margin)));
  refuse_keys_without_effect(input, assembly);
  const Case resolved = resolved_case(input, assembly);
  return with_report(std::move(assembly), *report, resolved);
}

}  // namespace

Assembly cut_assembly(const Case& input) {
  return cut_storeys(input, make_storeys(input.geometry));
}

Assembly generate(const Case& input, GenerateReport* report) {
  GenerateReport unused;
  if (!report) report = &unused;
  const Geometry& geometry = input.geometry;
  if (geometry.imported) {
    if (geometry.imperfections && geometry.imperfections->of_shape())
      throw InputError("imperfections: gap and noise are not available for imported blocks; remove them");
    if (is_assembly_file(*geometry.imported)) return assembly_again(input, report);
    report->import.emplace();
    Assembly assembly = import_blocks(*geometry.imported, input.material.density(), &*report->import);
    refuse_all_fixed(*geometry.imported, assembly);
    if (!report->import->uses_material) refuse_material(input);
    if (geometry.imperfections) vary_density(*geometry.imperfections, &assembly);
    assembly.title = input.title;
    assembly.geometry_hash = input.geometry_hash;
    const auto check = [&] {
      report->model =
          check_model(assembly,
                      imported_tolerances(assembly, report->import->facet_angle,
                                          joint_rule(smallest_block_size(assembly), input.contact.margin)),
                      report->import->origins);
    };
    check();
    if (fix_ends(*geometry.imported, report->model.joint_faces, &assembly) > 0) {
      refuse_all_fixed(*geometry.imported, assembly);
      check();
    }
    report->import->courses = set_courses(report->model.joint_faces, report->import->course_numbers,
                                          geometry.imported->axis, &assembly);
    refuse_keys_without_effect(input, assembly);
    const Case resolved = resolved_case(input, assembly);
    return with_report(std::move(assembly), *report, resolved);
  }
  const std::vector<Storey> storeys = make_storeys(geometry);
  Assembly assembly = cut_storeys(input, storeys);
  refuse_keys_without_effect(input, assembly);
  ModelTolerances tolerances = generated_tolerances(assembly);
  if (geometry.imperfections && geometry.imperfections->gap > 0.0) {  // joints as the solver finds them
    const JointRule rule = joint_rule(smallest_block_size(assembly), input.contact.margin);
    tolerances.joint_gap = rule.margin;
    tolerances.joint_width = rule.min_width;
    tolerances.joint_angle = rule.max_angle;
  }
  tolerances.part_by_part = has_cuts(storeys);
  report->model = check_model(assembly, tolerances);
  refuse_floating(geometry, assembly, report->model, tolerances.joint_gap);
  refuse_misplaced(storeys, report->model);
  refuse_hanging_feet(storeys, report->model);
  find_borne_vaults(report->model.joined_sheets, &assembly);
  if (!geometry.stage) report->model.shell_volume = smooth_volume(storeys);
  report->springings = springings_of(storeys);
  const Case resolved = resolved_case(input, assembly);
  return with_report(std::move(assembly), *report, resolved);
}

Assembly generate_again(const Case& input, Assembly assembly, const GenerateReport& report) {
  assembly.title = input.title;
  refuse_keys_without_effect(input, assembly);
  const Case resolved = resolved_case(input, assembly);
  return with_report(std::move(assembly), report, resolved);
}

bool have_same_blocks(const Case& a, const Case& b) {
  return !a.geometry.imported && a.geometry_hash == b.geometry_hash && a.contact.margin == b.contact.margin;
}

std::string to_text(const GenerateReport& report) {
  if (report.import) return to_text(*report.import) + to_text(report.model);
  std::string text = to_text(report.model);
  for (const GenerateReport::Springing& at : report.springings)
    text += fmt::format("{} springs at z = {:.4g} m, its first beds lie at {:.4g} m\n", at.member, at.z,
                        at.first_beds);
  return text;
}

std::vector<std::string> warnings_of(const GenerateReport& report) {
  if (!report.import) return warnings_of(report.model);
  std::vector<std::string> warnings = warnings_of(report.model, report.import->origins);
  for (std::string& text : warnings_of(*report.import)) warnings.push_back(std::move(text));
  return warnings;
}

}  // namespace cupola
