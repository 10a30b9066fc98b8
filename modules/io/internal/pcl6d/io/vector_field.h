// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointField.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace pcl6d {

/** \brief Three floating-point fields of a point, accessed as a vector in the point's bytes.
 * \ingroup io */
class VectorField {
public:
  VectorField(const std::vector<pcl::PCLPointField>& fields,
              const std::array<std::string, 3>& names)
  {
    for (const auto& name : names)
      for (const auto& field : fields)
        if (field.name == name && (field.datatype == pcl::PCLPointField::FLOAT32 ||
                                   field.datatype == pcl::PCLPointField::FLOAT64))
          parts_.push_back(field);
  }

  /** \return whether all three fields exist */
  explicit operator bool() const { return parts_.size() == 3; }

  Eigen::Vector3d
  read(const std::uint8_t* point) const
  {
    Eigen::Vector3d vector;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_float = parts_[i].datatype == pcl::PCLPointField::FLOAT32;
      vector[static_cast<Eigen::Index>(i)] =
          is_float ? partAt<float>(point + parts_[i].offset)
                   : partAt<double>(point + parts_[i].offset);
    }
    return vector;
  }

  void
  write(const Eigen::Vector3d& vector, std::uint8_t* point) const
  {
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = vector[static_cast<Eigen::Index>(i)];
      const auto rounded = static_cast<float>(value);
      if (parts_[i].datatype == pcl::PCLPointField::FLOAT32)
        std::memcpy(point + parts_[i].offset, &rounded, sizeof rounded);
      else
        std::memcpy(point + parts_[i].offset, &value, sizeof value);
    }
  }

private:
  template <typename T>
  static double
  partAt(const std::uint8_t* place)
  {
    T value;
    std::memcpy(&value, place, sizeof value);
    return value;
  }

  std::vector<pcl::PCLPointField> parts_;
};

} // namespace pcl6d
