// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/oriented_points.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of PairFeatureTable. */
struct PairFeatureOptions {
  int distance_steps = 20; ///< along the diameter; 4 to 60
  int angle_steps = 15;    ///< in a half turn; 4 to 30
  /** of the pairs of a model that may be left out because they lie in one plane and say
   * little of the pose; above it, all are kept: the model is a sheet */
  double largest_flat_share = 0.98;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The frame of a point on a surface: its normal is the x axis.
 * \return the motion into it: T_frame_surface */
Eigen::Isometry3f
frameOf(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);

/** \brief The pairs of a model's points, found by what does not change when it moves:
 * their distance and the three angles between the line that joins them and their normals.
 *
 * A pair of a scene with the same feature says where the model would be: the frame of its
 * first point, turned about the normal by the difference of two angles.
 * \note Source: B. Drost, M. Ulrich, N. Navab, S. Ilic, "Model globally, match locally:
 * efficient and robust 3D object recognition", CVPR 2010. \ingroup object_localization */
class PairFeatureTable {
public:
  /** A pair of the model. */
  struct Entry {
    std::uint32_t first; ///< place of the first point
    float angle;         ///< [rad] of the second about the first's normal, in its frame
  };
  /** The pairs with one feature. */
  struct Range {
    const Entry* first;
    const Entry* last;
    const Entry*
    begin() const
    {
      return first;
    }
    const Entry*
    end() const
    {
      return last;
    }
  };

  /** \param[in] model reduced, so that its spacing is about a step of distance
   * \param[in] diameter [m] > 0, no pair is farther apart
   * \throws BadArgument an option breaks its rule, or fewer than 3 points */
  PairFeatureTable(const OrientedPoints& model,
                   double diameter,
                   const PairFeatureOptions& options = {});

  /** \return the feature of a pair as a number; -1: too far apart, in one place, or left
   * out as flat */
  int
  featureOf(const Eigen::Vector3f& p1,
            const Eigen::Vector3f& n1,
            const Eigen::Vector3f& p2,
            const Eigen::Vector3f& n2) const;

  /** \return the model's pairs with a feature >= 0 */
  Range
  pairsWith(int feature) const
  {
    return {entries_.data() + begin_[static_cast<std::size_t>(feature)],
            entries_.data() + begin_[static_cast<std::size_t>(feature) + 1]};
  }

  std::size_t
  numPoints() const
  {
    return frames_.size();
  }

  /** \return the motion from the model into the frame of one of its points */
  const Eigen::Isometry3f&
  frame(std::size_t point) const
  {
    return frames_[point];
  }

  double
  diameter() const
  {
    return diameter_;
  }

private:
  void
  fill(const OrientedPoints& model);
  int
  angleStep(float cosine) const;

  double diameter_;
  PairFeatureOptions options_;
  bool skips_flat_ = true;
  std::vector<Eigen::Isometry3f> frames_;
  std::vector<std::uint8_t> angle_steps_; ///< by the cosine, finely
  std::vector<std::uint32_t> begin_;      ///< per feature and one more: into entries_
  std::vector<Entry> entries_;
};

} // namespace pcl6d
