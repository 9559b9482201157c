#include "assembly/files/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw SystemError(fmt::format("{}: {}: {}", path, what, std::strerror(errno)));
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
  // VTK chooses its format by the extension, which must therefore stay last.
  const std::filesystem::path target(path);
  const std::string side = (target.parent_path() / fmt::format(".{}.{}.part{}", target.stem().string(),
                                                               ::getpid(), target.extension().string()))
                               .string();
  try {
    errno = 0;
    if (!write(side)) fail(path, "cannot be written");
    flush_to_disk(side);
    if (std::rename(side.c_str(), path.c_str()) != 0) fail(path, "cannot be renamed into place");
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

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw SystemError(fmt::format("{}: cannot create the folder: {}", path, error.message()));
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) {
    throw InputError(FileLocation{path}, errno == ENOENT ? "does not exist" : "cannot be read");
  }
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw SystemError(path + ": reading failed");
  return text.str();
}

}  // namespace cupola
