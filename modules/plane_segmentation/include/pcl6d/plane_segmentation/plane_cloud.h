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

/** \brief Sets of points, disjoint, one per plane that a detector believes in; places
 * in PlaneCloud::points(). */
using PlaneCandidates = std::vector<std::vector<std::uint32_t>>;

/** \brief What is known of a cloud beside its points, and how it is prepared. */
struct PlaneCloudOptions {
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero(); ///< [m] where the sensor stood
  /** [m] of each point, if they differ; else empty. Faces of a wall that are closer than
   * the neighbours of a surfel get in each other's way; PlaneMap keeps them apart. */
  Points viewpoints;
  std::size_t width = 0;       ///< > 1: an organized cloud, in rows of this length
  std::optional<double> voxel; ///< [m] of the surfels, > 0; none: by spacing and noise
  std::optional<double> noise; ///< [m] of a point, > 0; none: estimated, over range
  /** What calibration leaves: ranges along a flat wall are off by so much of the range,
   * as neighbours agree and far places do not; >= 0. Adds to the noise. */
  double distortion = 0.002;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value
   * \param[in] num_points of the cloud */
  void
  validate(std::size_t num_points) const;
};

/** \brief A cloud prepared for the search for planes: its finite points, small patches
 * of surface with their normals (surfels), who is next to whom, and how much the sensor
 * errs. Detectors share one. \ingroup plane_segmentation */
class PlaneCloud {
public:
  /** \param[in] points [m] of one frame; those that are not finite are left out
   * \throws BadArgument an option breaks its rule, or the points spread over more than
   * 2^21 voxels along an axis */
  explicit PlaneCloud(const Points& points, const PlaneCloudOptions& options);

  /** \brief Seen from the origin, by a sensor of which nothing is known.
   * \param[in] num_threads 0: one per core; never changes the result */
  explicit PlaneCloud(const Points& points, unsigned int num_threads = 0);

  /** \return the finite points [m] */
  const Points&
  points() const
  {
    return points_;
  }

  /** \return per finite point its place in the cloud that was given */
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

  /** \return unit normals of points(), those of their surfels, towards the sensor; zero
   * where there is none */
  const Normals&
  normals() const
  {
    return normals_;
  }

  /** \return where points() are averaged, with neighbours and normals */
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

  /** \return the median distance [m] of a point to the nearest other one; 0 for fewer
   * than two */
  double
  spacing() const
  {
    return spacing_;
  }

  /** \return from where a point was seen [m] */
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
