#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cupola {

/// Reads arrays of numbers by name from an untrusted HDF5 file. The size of an array is that of its data,
/// never one that another array states, and no more memory is allocated than the file can hold. Links and
/// data in other files are rejected, and no filters are loaded. Throws InputError with the file and the
/// array.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::string& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& name) const;      ///< "/group/name", without links
  bool written(const std::string& name) const;  ///< exists and has data
  std::vector<int> integers(const std::string& name) const;
  std::vector<double> numbers(const std::string& name) const;
  int integer(const std::string& name) const;  ///< of an array with one element
  const std::string& path() const { return path_; }

 private:
  template <class T>
  std::vector<T> read(const std::string& name) const;

  std::string path_;
  std::int64_t file_;  // HDF5's handle
};

}  // namespace cupola
