#include "assembly/files/atomic_file.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr const char* kIsFolder = "is a folder: give the name of a file in it";

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw SystemError(fmt::format("{}: {}: {}", path, what, std::strerror(errno)));
}

/// The file that a chain of symbolic links leads to; it need not exist.
std::filesystem::path followed(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(path); ++i)
    path = path.parent_path() / std::filesystem::read_symlink(path);
  return path;
}

/// The process that writes a temporary file `.STEM.PROCESS.part.EXTENSION`; 0 for other files.
int process_of_part(const std::string& name) {
  const size_t end = name.rfind(".part");
  if (!name.starts_with('.') || end == std::string::npos || end == 0) return 0;
  if (const size_t after = end + 5; after < name.size() && name[after] != '.') return 0;
  const size_t start = name.rfind('.', end - 1) + 1;
  int process = 0;
  const auto [stop, error] = std::from_chars(name.data() + start, name.data() + end, process);
  return error == std::errc() && stop == name.data() + end ? process : 0;
}

/// Also true of a process that was killed and for which nobody has waited yet.
bool has_ended(int process) {
  if (::kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream status(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(status, text);
  const size_t name_end = text.rfind(')');
  return name_end != std::string::npos && text.compare(name_end, 3, ") Z") == 0;
}

/// Removes temporary files of processes that have ended, if their names begin with `start`.
void remove_parts_of_ended(const std::filesystem::path& folder, const std::string& start) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(start)) continue;
    if (const int process = process_of_part(name); process > 0 && has_ended(process))
      std::filesystem::remove(entry.path(), ignored);
  }
}

/// Flushes the data before the rename. Some file systems delay allocation and report a full disk only here.
void flush_to_disk(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) fail(path, "cannot be reopened");
  const int result = ::fsync(fd);
  ::close(fd);
  if (result != 0) fail(path, "cannot be flushed to disk");
}

}  // namespace

void write_atomically(const std::string& path, const std::function<bool(const std::string&)>& write) {
  check_output_file(path);
  const std::filesystem::path target = followed(path);
  // VTK chooses its format by the extension, which must therefore stay last.
  const std::string side = (target.parent_path() / fmt::format(".{}.{}.part{}", target.stem().string(),
                                                               ::getpid(), target.extension().string()))
                               .string();
  try {
    errno = 0;
    if (!write(side)) fail(path, "cannot be written");
    flush_to_disk(side);
    if (std::rename(side.c_str(), target.c_str()) != 0) fail(path, "cannot be renamed into place");
  } catch (...) {
    std::remove(side.c_str());
    throw;
  }
}

void write_text_atomically(const std::string& path, const std::string& text) {
  write_atomically(path, [&text](const std::string& side) {
    std::ofstream out(side, std::ios::binary);
    out << text;
    out.close();
    return static_cast<bool>(out);
  });
}

std::string in_folder(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

void check_output_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  throw InputError(FileLocation{path}, fs::is_directory(status)
                                           ? kIsFolder
                                           : "is a device or a pipe: the output must be a regular file");
}

void remove_part_files(const std::string& folder) {
  remove_parts_of_ended(folder, ".");
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw SystemError(fmt::format("{}: cannot create the folder: {}", path, error.message()));
}

std::string read_text(const std::string& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // as Excel and Notepad write it
  std::string text = read_bytes(path);
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

std::string read_bytes(const std::string& path) {
  std::error_code unknown;  // a pipe has no size
  if (std::filesystem::is_directory(path, unknown)) throw InputError(FileLocation{path}, kIsFolder);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(FileLocation{path}, errno == ENOENT ? "does not exist" : "cannot be read");
  std::string text;
  if (const auto size = std::filesystem::file_size(path, unknown); !unknown) text.reserve(size);
  std::array<char, 1 << 16> chunk{};
  while (in.read(chunk.data(), chunk.size()) || in.gcount() > 0)
    text.append(chunk.data(), static_cast<size_t>(in.gcount()));
  if (in.bad()) throw SystemError(path + ": reading failed");
  return text;
}

}  // namespace cupola
