// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/plane_segmentation/noise_model.h>
#include <pcl6d/plane_segmentation/surfels.h>
#include <pcl6d/search/point_tree.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Disjoint sets of points, one per candidate plane of a detector; indices into
 * PlaneCloud::points(). */
using PlaneCandidates = std::vector<std::vector<std::uint32_t>>;

/** \brief Properties of a cloud besides its points, and knobs of its preparation. */
struct PlaneCloudOptions {
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero(); ///< [m] where the sensor stood
  /** [m] per point, if viewpoints differ; else empty. Opposite faces of a wall closer
   * than the neighbours of a surfel disturb each other; PlaneMap keeps them apart. */
  Points viewpoints;
  std::size_t width = 0;       ///< > 1: an organized cloud, in rows of this length
  std::optional<double> voxel; ///< [m] of the surfels, > 0; default: by spacing and
                               ///< noise
  std::optional<double> noise; ///< [m] of a point, > 0; default: estimated, over range
  /** Residual of calibration, as a share of the range: constant among neighbours, but
   * different across a flat wall; >= 0. Adds to the noise. */
  double distortion = 0.002;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value
   * \param[in] num_points of the cloud */
  void
  validate(std::size_t num_points) const;
};

/** \brief A cloud prepared for plane detection: finite points, surfels with normals and
 * neighbours, and the sensor's noise. Detectors may use one cloud together. \ingroup
 * plane_segmentation */
class PlaneCloud {
public:
  /** \param[in] points [m] in one frame; points with a non-finite coordinate are left
   * out
   * \throws BadArgument an option is invalid, or the points spread over more than 2^21
   * voxels along an axis */
  explicit PlaneCloud(const Points& points, const PlaneCloudOptions& options);

  /** \brief Seen from the origin, by an unknown sensor.
   * \param[in] points [m] with the sensor at the origin
   * \param[in] num_threads 0: one per core; never changes the result */
  explicit PlaneCloud(const Points& points, unsigned int num_threads = 0);

  /** \return the finite points [m] */
  const Points&
  points() const
  {
    return points_;
  }

  /** \return per finite point its index in the input cloud */
  const std::vector<std::uint32_t>&
  places() const
  {
    return places_;
  }

  /** \return a search tree over points() */
  const PointTree&
  tree() const
  {
    return tree_;
  }

  /** \return unit normals of points(), taken from their surfels, towards the sensor;
   * zero without a normal */
  const Normals&
  normals() const
  {
    return normals_;
  }

  /** \return the surfels: averaged points(), with neighbours and normals */
  const Surfels&
  surfels() const
  {
    return surfels_;
  }

  /** \return the standard deviation [m] of a point's distance to its surface, noise
   * and distortion */
  double
  noise(std::size_t point) const
  {
    const double range = (points_[point] - viewpoint(point)).norm();
    const double noise = noise_.at(range);
    return std::sqrt(noise * noise + distortion_ * distortion_ * range * range);
  }

  /** \return the median distance [m] of a point to its nearest neighbour; 0 for fewer
   * than two points */
  double
  spacing() const
  {
    return spacing_;
  }

  /** \return the sensor's position [m] for a point */
  const Eigen::Vector3f&
  viewpoint(std::size_t point) const
  {
    return viewpoints_.empty() ? viewpoint_ : viewpoints_[point];
  }

  unsigned int
  numThreads() const
  {
    return num_threads_;
  }

private:
  std::vector<std::uint32_t> places_;
  Points points_;
  Eigen::Vector3f viewpoint_;
  Points viewpoints_; // of the finite points, or empty
  unsigned int num_threads_;
  PointTree tree_;
  double spacing_ = 0;
  NoiseModel noise_;
  double distortion_ = 0;
  Surfels surfels_;
  Normals normals_;
};

} // namespace pcl6d
