#pragma once

#include <functional>
#include <string>

namespace cupola {

/// Writes a temporary file (same folder, `.part` in its name), flushes it to disk and renames it to `path`.
/// Readers see either the old file or the new one, never part of one, even after a power failure. `write`
/// gets the name of the temporary file; if it throws SystemError or returns false, the temporary file is
/// removed and SystemError with `path` and the reason is thrown. A symbolic link is followed: its target is
/// replaced. InputError if `path` is neither a regular file nor absent. Removes what killed runs left of the
/// same file.
void write_atomically(const std::string& path,
                      const std::function<bool(const std::string& side_path)>& write);
void write_text_atomically(const std::string& path, const std::string& text);

/// The path of a file in a folder.
std::string in_folder(const std::string& folder, const std::string& name);
/// Throws InputError if `path` is a device, a folder or anything else that a file must not replace. For
/// programs that compute long before they write.
void check_output_file(const std::string& path);

/// Removes the temporary files that killed runs left in a folder.
void remove_part_files(const std::string& folder);

/// Creates a folder and its parents. Throws SystemError with the path.
void make_folder(const std::string& path);

/// The content of a file without a byte order mark (UTF-8). Throws InputError when it cannot be read.
std::string read_text(const std::string& path);

std::string read_bytes(const std::string& path);  ///< the same as it is

}  // namespace cupola
