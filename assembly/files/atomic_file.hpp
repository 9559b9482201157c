#pragma once

#include <functional>
#include <string>

namespace cupola {

/// Writes a file aside (same folder, `.part` ending), flushes it to the disk and renames it over `path`: a
/// reader, or a machine switched off, sees the old file or the new one, never half of one.
/// `write` receives the name to write to and throws SystemError (or returns false) when it fails; then the
/// side file is removed and SystemError names `path`.
void write_atomically(const std::string& path,
                      const std::function<bool(const std::string& side_path)>& write);
void write_text_atomically(const std::string& path, const std::string& text);

/// Creates a folder and its parents. Throws SystemError with the path.
void make_folder(const std::string& path);

std::string read_text(const std::string& path);  ///< throws InputError when it cannot be read

}  // namespace cupola
