#include "tests/reference/hdf5_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <type_traits>

#include <fmt/format.h>
#include <hdf5.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Largest compression ratio: that of deflate, the highest of HDF5's own filters.
constexpr double kLargestCompression = 1032.0;

[[noreturn]] void reject_hdf5(const std::string& path, const std::string& what) {
  throw InputError(FileLocation{path}, "HDF5: " + what);
}

/// Closes an HDF5 handle at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Bytes of one chunk, which HDF5 holds in memory as a whole; 0 for data without chunks.
double chunk_bytes(hid_t layout, int rank, double element_bytes) {
  if (H5Pget_layout(layout) != H5D_CHUNKED) return 0.0;
  std::vector<hsize_t> sides(static_cast<size_t>(std::max(rank, 1)), 1);
  H5Pget_chunk(layout, rank, sides.data());
  return std::accumulate(sides.begin(), sides.end(), element_bytes,
                         [](double bytes, hsize_t side) { return bytes * static_cast<double>(side); });
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::string& path) : path_(path), file_(-1) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
  if (H5Fis_hdf5(path.c_str()) <= 0) reject_hdf5(path, "not an HDF5 file, or not readable");
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) reject_hdf5(path, "cannot be opened");
}

Hdf5Reader::~Hdf5Reader() {
  H5Fclose(file_);
}

bool Hdf5Reader::has(const std::string& name) const {
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) return false;
    H5L_info_t link;
    if (H5Lget_info(file_, part.c_str(), &link, H5P_DEFAULT) < 0) return false;
    if (link.type != H5L_TYPE_HARD)
      reject_hdf5(path_, fmt::format("{} is a link: links are not followed", part));
    if (end == std::string::npos) return true;
  }
}

bool Hdf5Reader::written(const std::string& name) const {
  if (!has(name)) return false;
  const Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  return data >= 0 && H5Dget_storage_size(data) > 0;
}

template <class T>
std::vector<T> Hdf5Reader::read(const std::string& name) const {
  constexpr bool whole = std::is_same_v<T, int>;
  if (!has(name)) reject_hdf5(path_, name + " is missing");
  const Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (data < 0) reject_hdf5(path_, name + " is not an array");
  const Handle type(H5Dget_type(data), H5Tclose), space(H5Dget_space(data), H5Sclose),
      layout(H5Dget_create_plist(data), H5Pclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && (whole || kind != H5T_FLOAT))
    reject_hdf5(path_, fmt::format("{} does not hold {}numbers", name, whole ? "whole " : ""));
  if (H5Pget_external_count(layout) != 0 || H5Pget_layout(layout) == H5D_VIRTUAL)
    reject_hdf5(path_, name + " is stored in another file: copy it into this one");

  const hssize_t size = H5Sget_simple_extent_npoints(space);
  if (size < 0) reject_hdf5(path_, name + " has no size");
  const double stored = std::min(static_cast<double>(H5Dget_storage_size(data)),
                                 static_cast<double>(std::filesystem::file_size(path_)));
  const double element_bytes = static_cast<double>(std::max(H5Tget_size(type), sizeof(T)));
  const double declared = std::max(static_cast<double>(size) * element_bytes,
                                   chunk_bytes(layout, H5Sget_simple_extent_ndims(space), element_bytes));
  if (declared > kLargestCompression * stored)
    reject_hdf5(path_, fmt::format("{} declares {}, but the file has only {} bytes of data for it", name,
                                   counted(size, "element"), stored));
  std::vector<T> values(static_cast<size_t>(size));
  const hid_t memory_type = whole ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
  if (size > 0 && H5Dread(data, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    reject_hdf5(path_, name + " cannot be read");
  return values;
}

std::vector<int> Hdf5Reader::integers(const std::string& name) const {
  return read<int>(name);
}

std::vector<double> Hdf5Reader::numbers(const std::string& name) const {
  return read<double>(name);
}

int Hdf5Reader::integer(const std::string& name) const {
  const std::vector<int> values = integers(name);
  if (values.size() != 1)
    reject_hdf5(path_, fmt::format("{} has {}, expected one", name, counted(values.size(), "element")));
  return values.front();
}

}  // namespace cupola
