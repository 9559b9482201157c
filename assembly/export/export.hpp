#pragma once

#include <string>
#include <vector>

#include "assembly/export/export_model.hpp"

namespace cupola {

/// Formats, chosen by the ending of the file.
inline constexpr const char* kExportFormats = ".gltf, .obj, .json (COMPAS), .csv or .vtu (Cupola)";

/// Throws InputError if the ending is none of them.
void check_export_path(const std::string& path);

/// Warnings of what the format cannot hold of the model.
std::vector<std::string> lost_by_export(const std::string& path, const Assembly& assembly);

/// Writes the model in the format of the ending, atomically; folders are created. A .csv file holds the
/// blocks.
void write_export(const std::string& path, const ExportModel& model);

}  // namespace cupola
