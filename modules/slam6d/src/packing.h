// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/run/run_fields.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

/** \file Results as bytes, for journals of this machine: values one after the other, as they
 * are in memory. The fields are those of run_fields.h, and those that no file keeps. */
namespace pcl6d::slam6d {

/** Appends values to bytes. */
class Packer {
public:
  template <typename Value>
  std::enable_if_t<std::is_arithmetic_v<Value> || std::is_enum_v<Value>>
  value(const Value& v)
  {
    bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void
  value(const std::string& v)
  {
    value(v.size());
    bytes += v;
  }
  template <typename Scalar, int Rows, int Cols>
  void
  value(const Eigen::Matrix<Scalar, Rows, Cols>& v)
  {
    for (Eigen::Index i = 0; i < v.size(); ++i)
      value(v.data()[i]);
  }
  void
  value(const Eigen::Isometry3d& v)
  {
    value(v.matrix());
  }

  std::string bytes;
};

/** Takes values from bytes. */
class Unpacker {
public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}

  /** \throws IoFailed there are too few bytes */
  template <typename Value>
  std::enable_if_t<std::is_arithmetic_v<Value> || std::is_enum_v<Value>>
  value(Value& v)
  {
    std::memcpy(&v, next(sizeof v), sizeof v);
  }
  void
  value(std::string& v)
  {
    std::size_t size = 0;
    value(size);
    v.assign(next(size), size);
  }
  template <typename Scalar, int Rows, int Cols>
  void
  value(Eigen::Matrix<Scalar, Rows, Cols>& v)
  {
    for (Eigen::Index i = 0; i < v.size(); ++i)
      value(v.data()[i]);
  }
  void
  value(Eigen::Isometry3d& v)
  {
    value(v.matrix());
  }

  /** \throws IoFailed bytes are left */
  void
  finish() const
  {
    if (place_ != bytes_.size())
      throw IoFailed("a record of the journal is too long");
  }

private:
  const char*
  next(std::size_t size)
  {
    if (size > bytes_.size() - place_)
      throw IoFailed("a record of the journal is too short");
    place_ += size;
    return bytes_.data() + place_ - size;
  }

  const std::string& bytes_;
  std::size_t place_ = 0;
};

/** \return the bytes of a result */
std::string
packed(const ScanResult& scan);
std::string
packed(const Slam6DResult& result);

/** \throws IoFailed there are too few bytes, or too many */
void
unpack(const std::string& bytes, ScanResult& scan);
void
unpack(const std::string& bytes, Slam6DResult& result);

} // namespace pcl6d::slam6d
