#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace cupola {

/// Converts plain data to bytes and back, bit for bit, on one kind of machine. A type is supported if there
/// is a function for it, used in both directions:
///
///     template <class Archive> void visit(Archive& archive, Type& value) { archive(value.x, value.y); }
class ByteWriter {
 public:
  template <class... Values>
  void operator()(Values&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  template <class T>
  void put(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      raw(&value, sizeof value);
    else
      visit(*this, value);
  }
  void put(std::string& text) {
    std::size_t size = text.size();
    put(size);
    raw(text.data(), size);
  }
  template <int Rows>
  void put(Eigen::Matrix<double, Rows, 1>& x) {
    auto size = x.size();
    if constexpr (Rows == Eigen::Dynamic) put(size);
    raw(x.data(), static_cast<std::size_t>(size) * sizeof(double));
  }
  template <int N>
  void put(Eigen::Matrix<double, N, N>& x) {
    raw(x.data(), sizeof(double) * N * N);
  }
  void put(Eigen::Quaterniond& q) { raw(q.coeffs().data(), 4 * sizeof(double)); }
  template <class A, class B>
  void put(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T>
  void put(std::vector<T>& values) {
    std::size_t size = values.size();
    put(size);
    for (T& value : values) put(value);
  }

  std::string bytes_;
};

/// Reads the bytes of ByteWriter. Throws std::runtime_error if the bytes end early or declare more than they
/// hold, before any memory is allocated.
class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  bool at_end() const { return next_ == bytes_.size(); }

 private:
  void raw(void* data, std::size_t size) {
    if (size > bytes_.size() - next_) throw std::runtime_error("ends early");
    if (size > 0) std::memcpy(data, bytes_.data() + next_, size);
    next_ += size;
  }
  /// Number of elements; each takes at least one byte.
  std::size_t size() {
    std::size_t count = 0;
    raw(&count, sizeof count);
    if (count > bytes_.size() - next_) throw std::runtime_error("declares more than it holds");
    return count;
  }
  template <class T>
  void get(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      raw(&value, sizeof value);
    else
      visit(*this, value);
  }
  void get(std::string& text) {
    text.resize(size());
    raw(text.data(), text.size());
  }
  template <int Rows>
  void get(Eigen::Matrix<double, Rows, 1>& x) {
    if constexpr (Rows == Eigen::Dynamic) x.resize(static_cast<Eigen::Index>(size()));
    raw(x.data(), static_cast<std::size_t>(x.size()) * sizeof(double));
  }
  template <int N>
  void get(Eigen::Matrix<double, N, N>& x) {
    raw(x.data(), sizeof(double) * N * N);
  }
  void get(Eigen::Quaterniond& q) { raw(q.coeffs().data(), 4 * sizeof(double)); }
  template <class A, class B>
  void get(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.clear();
    values.resize(size());
    for (T& value : values) get(value);
  }

  const std::string& bytes_;
  std::size_t next_ = 0;
};

}  // namespace cupola
