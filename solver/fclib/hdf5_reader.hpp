#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cupola {

/// Arrays of numbers by name from an HDF5 file that nobody vouches for. An array's size is its own in the
/// file, never one that another array states, and no memory is taken for more than the file can hold. Links
/// and data that lie in other files are refused, and no filter is loaded. Throws InputError naming file and
/// array.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::string& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& name) const;      ///< "/group/name", reached within this file
  bool written(const std::string& name) const;  ///< there, and not only declared
  std::vector<int> integers(const std::string& name) const;
  std::vector<double> numbers(const std::string& name) const;
  int integer(const std::string& name) const;  ///< an array of one element
  const std::string& path() const { return path_; }

 private:
  template <class T>
  std::vector<T> read(const std::string& name) const;

  std::string path_;
  std::int64_t file_;  // HDF5's handle
};

/// What HDF5 does at the end of the process: closes what is open, and gives its memory back.
void close_hdf5();

}  // namespace cupola
