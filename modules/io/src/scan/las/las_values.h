// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/scan_encoder.h"

#include <array>
#include <optional>

namespace pcl6d::io {

/** \brief Converts points of a cloud to LAS points of format 6 or 7.
 *
 * Points lie in the world (ScanShape::T_world_scan), in multiples of a scale from an offset,
 * both chosen from the first points passed to lookAt(). `classification` is kept; if missing,
 * `dynamic` points get class 18 and static points class 0; `scan`, else `point_source_id`, is
 * the point source. */
class LasValues {
public:
  /** \throws BadArgument no x, y, z of floating point */
  explicit LasValues(const ScanShape& shape);

  bool
  hasColours() const
  {
    return colours_.has_value();
  }

  /** \return [byte] */
  std::size_t
  recordSize() const
  {
    return hasColours() ? 36 : 30;
  }

  /** \return fields that are not written */
  const std::vector<std::string>&
  losses() const
  {
    return losses_;
  }

  /** \brief Chooses scale, offset and the unit of the intensity, from the first block with a
   * finite point. \param[in] is_all whether no further points come */
  void
  lookAt(const pcl::PCLPointCloud2& block, bool is_all);

  /** \brief Writes a point. \return false if the point is not finite
   * \throws BadArgument the point lies too far from the first points */
  bool
  encode(const std::uint8_t* point, std::uint8_t* record);

  /** \return the fields rounded or scaled in the points encoded so far */
  std::vector<std::string>
  lossesOfPoints() const;

  /** \brief Writes scale, offset and bounds in the layout of the header: 96 bytes. */
  void
  storeTransform(char* place) const;

  /** \return how many points have return number 1, 2, ... */
  const std::array<std::uint64_t, 15>&
  numOfReturns() const
  {
    return num_of_returns_;
  }

private:
  using Field = std::optional<pcl::PCLPointField>;

  Field
  take(const std::vector<pcl::PCLPointField>& fields,
       std::initializer_list<const char*> names);
  double
  valueOf(const std::uint8_t* point, const Field& field, double otherwise) const;
  double
  whole(double value, double least, double most);
  void
  encodePlace(const Eigen::Vector3d& place, std::uint8_t* record);
  void
  encodeColours(const std::uint8_t* point, std::uint8_t* record) const;

  std::array<pcl::PCLPointField, 3> place_;
  Eigen::Isometry3d T_world_scan_;
  Field intensity_, number_, count_, class_, dynamic_, user_data_, angle_, source_,
      time_, colours_;
  std::vector<std::string> losses_;
  bool has_looked_ = false;
  double scale_ = 0;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d lowest_, highest_;
  double intensity_unit_ = 1; ///< value for 1
  bool is_rounded_ = false;   ///< a value but the coordinates
  std::array<std::uint64_t, 15> num_of_returns_{};
};

} // namespace pcl6d::io
