#pragma once

#include <functional>
#include <string>

namespace cupola {

/// Writes a temporary file (same folder, `.part` in its name), flushes it to disk and renames it to `path`.
/// Readers see either the old file or the new one, never part of one, even after a power failure. `write`
/// gets the name of the temporary file; if it throws SystemError or returns false, the temporary file is
/// removed and SystemError with `path` is thrown.
void write_atomically(const std::string& path,
                      const std::function<bool(const std::string& side_path)>& write);
void write_text_atomically(const std::string& path, const std::string& text);

/// The path of a file in a folder.
std::string in_folder(const std::string& folder, const std::string& name);

/// Creates a folder and its parents. Throws SystemError with the path.
void make_folder(const std::string& path);

std::string read_text(const std::string& path);  ///< throws InputError when it cannot be read

}  // namespace cupola
