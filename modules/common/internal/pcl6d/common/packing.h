// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/** \file Results as bytes, for further processes of the program and for journals on one machine:
 * values in sequence, in memory layout. A function beside a struct lists the members, for
 * packing and unpacking:
 * \code
 * template <typename Archive>
 * void
 * packFields(Archive& archive, MyResult& result)
 * {
 *   archive(result.count, result.name);
 * }
 * \endcode */
namespace PCL6D_EXPORTS pcl6d {

namespace packing {
/** Whether a value is packed by copying memory. */
template <typename Value>
struct IsPlain : std::bool_constant<std::is_trivially_copyable_v<Value>> {};
template <typename Scalar, int Rows, int Cols>
struct IsPlain<Eigen::Matrix<Scalar, Rows, Cols>>
: std::bool_constant<(Rows > 0 && Cols > 0)> {};
template <>
struct IsPlain<Eigen::Isometry3d> : std::true_type {};
} // namespace packing

/** \brief Appends values to bytes. */
class Packer {
public:
  template <typename... Values>
  void
  operator()(const Values&... values)
  {
    (value(values), ...);
  }

  template <typename Value>
  void
  value(const Value& v)
  {
    if constexpr (packing::IsPlain<Value>::value)
      bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
    else
      packFields(*this, const_cast<Value&>(v)); // only reads
  }
  void
  value(const std::string& v)
  {
    value(v.size());
    bytes += v;
  }
  template <typename Value>
  void
  value(const std::vector<Value>& v)
  {
    value(v.size());
    if constexpr (packing::IsPlain<Value>::value)
      bytes.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(Value));
    else
      for (const Value& one : v)
        value(one);
  }
  template <typename Value>
  void
  value(const std::optional<Value>& v)
  {
    value(v.has_value());
    if (v)
      value(*v);
  }
  template <typename First, typename Second>
  void
  value(const std::pair<First, Second>& v)
  {
    (*this)(v.first, v.second);
  }

  std::string bytes;
};

/** \brief Takes values from bytes. */
class Unpacker {
public:
  /** \param[in] bytes kept by reference */
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}

  /** \throws IoFailed the buffer is too short */
  template <typename... Values>
  void
  operator()(Values&... values)
  {
    (value(values), ...);
  }

  template <typename Value>
  void
  value(Value& v)
  {
    if constexpr (packing::IsPlain<Value>::value)
      std::memcpy(static_cast<void*>(&v), next(sizeof v), sizeof v);
    else
      packFields(*this, v);
  }
  void
  value(std::string& v)
  {
    std::size_t size = 0;
    value(size);
    v.assign(next(size), size);
  }
  template <typename Value>
  void
  value(std::vector<Value>& v)
  {
    std::size_t size = 0;
    value(size);
    if (size > bytes_.size() - place_) // each takes a byte at least
      next(size);
    v.resize(size);
    if constexpr (packing::IsPlain<Value>::value) {
      const char* from = next(size * sizeof(Value));
      if (size > 0)
        std::memcpy(static_cast<void*>(v.data()), from, size * sizeof(Value));
    }
    else {
      for (Value& one : v)
        value(one);
    }
  }
  template <typename Value>
  void
  value(std::optional<Value>& v)
  {
    bool has_value = false;
    value(has_value);
    v.reset();
    if (has_value)
      value(v.emplace());
  }
  template <typename First, typename Second>
  void
  value(std::pair<First, Second>& v)
  {
    (*this)(v.first, v.second);
  }

  /** \throws IoFailed bytes are left */
  void
  finish() const
  {
    if (place_ != bytes_.size())
      throw IoFailed("a record is too long");
  }

private:
  const char*
  next(std::size_t size)
  {
    if (size > bytes_.size() - place_)
      throw IoFailed("a record is too short");
    place_ += size;
    return bytes_.data() + place_ - size;
  }

  const std::string& bytes_;
  std::size_t place_ = 0;
};

} // namespace pcl6d
