#include "assembly/files/folder_lock.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

std::string lock_file(const std::string& folder) {
  return (std::filesystem::path(folder) / ".lock").string();
}

std::string this_process() {
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  return fmt::format("process {} on {}\n", ::getpid(), host);
}

std::string owner_of(int file) {
  char text[512] = "";
  const ssize_t size = ::pread(file, text, sizeof text - 1, 0);
  const std::string owner(text, size > 0 ? static_cast<size_t>(size) : 0);
  return owner.empty() ? "another process" : owner.substr(0, owner.find('\n'));
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) : folder_(folder) {
  make_folder(folder);
  const std::string path = lock_file(folder);
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw SystemError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  // File systems without locks refuse with another error; the run then goes on without.
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    const std::string owner = owner_of(file_);
    ::close(file_);
    throw SystemError(fmt::format(
        "{}: {} writes into this folder; wait until it ends, or choose another --output", folder, owner));
  }
  const std::string owner = this_process();
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, owner.data(), owner.size(), 0) < 0) {
    const std::string reason = std::strerror(errno);
    ::close(file_);
    throw SystemError(fmt::format("{}: cannot be written: {}", path, reason));
  }
  remove_part_files(folder);
}

FolderLock::~FolderLock() {
  ::close(file_);
}

void FolderLock::check() const {
  struct stat held {
  }, present{};
  if (::fstat(file_, &held) == 0 && ::stat(lock_file(folder_).c_str(), &present) == 0 &&
      held.st_ino == present.st_ino && held.st_dev == present.st_dev)
    return;
  throw SystemError(fmt::format("{}: the folder was removed during the run, which therefore stops", folder_));
}

}  // namespace cupola
