// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/messages/frame_tree.h"
#include "bag/messages/gnss_messages.h"

#include <string>
#include <vector>

/** \file Poses of a robot from satellite receiver and inertial unit. */
namespace pcl6d::sources {

/** \brief Earth-centred, earth-fixed coordinates [m] of a position on WGS84. */
Eigen::Vector3d
earthFixed(const GeodeticPosition& position);

/** \return the position in the tangential plane of the ellipsoid below the origin: east, north,
 * up [m] */
Eigen::Vector3d
eastNorthUp(const GeodeticPosition& position, const GeodeticPosition& origin);

/** \brief Fixes and orientations of a recording, and the derived poses. */
class GnssTrack {
public:
  void
  add(const SatelliteFix& fix, std::int64_t recorded);
  void
  add(const InertialOrientation& inertial, std::int64_t recorded);

  /** \brief Poses of the antenna in the plane about the first fix: x east, y north, z up.
   *
   * Rotations come from the inertial unit, carried over to the frame of the antenna by the
   * transforms, or without an inertial unit from the heading of the motion, level: from the
   * last fix behind to the next fix ahead at a sufficient distance (1 m, and three standard
   * deviations of the fixes).
   * \param[in] uses_record use times of recording instead of header times
   * \param[in] tree of all transforms, finished
   * \param[out] notes for people \throws IoFailed no fix, or an inertial unit without
   * orientations \param[in] fix_title, inertial_title for messages; the latter is empty without
   * an inertial unit */
  PoseSeries
  poses(bool uses_record,
        const FrameTree& tree,
        const std::filesystem::path& path,
        const std::string& fix_title,
        const std::string& inertial_title,
        std::vector<std::string>& notes) const;

  /** \return the frame of the antenna */
  const std::string&
  frame() const
  {
    return frame_;
  }

  /** \return the origin of the poses, for people: latitude, longitude [deg] and height [m] */
  std::string
  originText() const;

private:
  struct Fix {
    SatelliteFix fix;
    std::int64_t recorded = 0; ///< [ns]
  };
  struct Orientation {
    InertialOrientation inertial;
    std::int64_t recorded = 0; ///< [ns]
  };
  PoseSeries
  orientations(bool uses_record,
               const FrameTree& tree,
               const std::filesystem::path& path,
               const std::string& title,
               std::vector<std::string>& notes) const;

  std::vector<Fix> fixes_; ///< with a position
  std::vector<Orientation> orientations_;
  std::size_t num_without_fix_ = 0, num_without_orientation_ = 0;
  std::string frame_;
};

} // namespace pcl6d::sources
