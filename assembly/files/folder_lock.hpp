#pragma once

#include <string>

namespace cupola {

/// Lets one process at a time write into a folder. The kernel releases the lock when its owner ends, however
/// it ends; the file `.lock` remains and names the last owner.
class FolderLock {
 public:
  /// Creates the folder and removes temporary files of killed runs. SystemError that names the owner if
  /// another process has the lock.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// SystemError if the folder was removed, so that a later file would lie in another folder of the same
  /// name.
  void check() const;

 private:
  std::string folder_;
  int file_ = -1;
};

}  // namespace cupola
