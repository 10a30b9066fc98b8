// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/training_images.h>
#include <pcl6d/simulation/ray_caster.h>

namespace pcl6d::object_localization {

/** \brief A model to be put into scans. */
class TrainingModel {
public:
  explicit TrainingModel(const TriangleMesh& mesh);

  const RayCaster&
  caster() const
  {
    return caster_;
  }
  /** \return [m] with the lowest point at z = 0, the middle of its box above the origin */
  const Eigen::AlignedBox3d&
  box() const
  {
    return box_;
  }

private:
  Eigen::AlignedBox3d box_;
  RayCaster caster_; // in that frame
};

/** \brief A scan to put models into. */
class TrainingScan {
public:
  /** Keeps a reference. */
  explicit TrainingScan(const BackgroundScan& scan);

  const Points&
  points() const
  {
    return scan_->points;
  }
  const std::vector<float>&
  reflectance() const
  {
    return scan_->reflectance;
  }

  /** \return [m] range of the nearest point in about the direction of another */
  float
  nearestTowards(const Eigen::Vector3f& point) const;

private:
  const BackgroundScan* scan_;
  std::vector<float> nearest_; // per half degree
};

/** \brief Points with one reflectance each, or without reflectances. */
struct MeasuredPoints {
  Points points;
  std::vector<float> reflectance;
};

/** \brief Why a position for an object was rejected. */
enum class PlaceVerdict { kFree, kNoFloor, kBlocked, kTooFewSamples, kHidden };

/** \brief A scan with a model added. */
struct ObjectInScan {
  PlaceVerdict verdict = PlaceVerdict::kFree;
  MeasuredPoints scan; ///< remaining points of the scan, and the samples on the object
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); ///< of the object [m]
  double nearest = 0;                               ///< [m] smallest range of a sample
  double farthest = 0;                              ///< [m]
};

/** \brief Puts a model at a random position in a scan, determined by the random numbers
 * alone. */
ObjectInScan
putIntoScan(const TrainingModel& model,
            const ScannerPreset& scanner,
            const TrainingScan& scan,
            const TrainingImageOptions& options,
            Random& random);

} // namespace pcl6d::object_localization
