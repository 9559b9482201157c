#include "assembly/export/export.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/export/formats.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

struct ExportFormat {
  const char* ending;
  std::string (*text)(const ExportModel&);
};
constexpr std::array kFormats{ExportFormat{".gltf", gltf_text}, ExportFormat{".obj", obj_text},
                              ExportFormat{".json", compas_text}, ExportFormat{".csv", blocks_csv}};

const ExportFormat& format_of(const std::string& path) {
  for (const ExportFormat& format : kFormats)
    if (path.ends_with(format.ending)) return format;
  throw InputError(fmt::format("cannot export to {}: the file must end in {}", path, kExportFormats));
}

}  // namespace

void check_export_path(const std::string& path) {
  format_of(path);
}

void write_export(const std::string& path, const ExportModel& model) {
  const std::string text = format_of(path).text(model);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) make_folder(folder.string());
  write_text_atomically(path, text);
}

}  // namespace cupola
