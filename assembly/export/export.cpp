#include "assembly/export/export.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/export/formats.hpp"
#include "assembly/export/placed_assembly.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

template <std::string (*text)(const ExportModel&)>
void write(const std::string& path, const ExportModel& model) {
  write_text_atomically(path, text(model));
}

void write_placed_assembly(const std::string& path, const ExportModel& model) {
  write_assembly(path, placed_assembly(model), "");
}

struct ExportFormat {
  const char* ending;
  void (*write)(const std::string& path, const ExportModel&);
  bool loses_ties;  ///< holds the structure, but without them
};
constexpr std::array kFormats{
    ExportFormat{".gltf", write<gltf_text>, true}, ExportFormat{".obj", write<obj_text>, true},
    ExportFormat{".json", write<compas_text>, true}, ExportFormat{".csv", write<blocks_csv>, false},
    ExportFormat{".vtu", write_placed_assembly, false}};

const ExportFormat& format_of(const std::string& path) {
  for (const ExportFormat& format : kFormats)
    if (path.ends_with(format.ending)) return format;
  throw InputError(fmt::format("cannot export to {}: the file must end in {}", path, kExportFormats));
}

}  // namespace

void check_export_path(const std::string& path) {
  format_of(path);
}

std::vector<std::string> lost_by_export(const std::string& path, const Assembly& assembly) {
  if (assembly.ties.empty() || !format_of(path).loses_ties) return {};
  return {fmt::format("{} holds no ties: {} of chains, rods or springs are lost; export to .vtu to keep them",
                      path, counted(assembly.ties.size(), "tie"))};
}

void write_export(const std::string& path, const ExportModel& model) {
  const ExportFormat& format = format_of(path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) make_folder(folder.string());
  format.write(path, model);
}

}  // namespace cupola
