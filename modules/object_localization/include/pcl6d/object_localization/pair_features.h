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
  /** Largest share of a model's pairs that may be left out as coplanar, with little
   * information on the pose. Above it every pair is kept: the model is a sheet. */
  double largest_flat_share = 0.98;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The frame of a point on a surface, with the normal as x axis.
 * \return the transformation from the surface's frame: T_frame_surface */
Eigen::Isometry3f
frameOf(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);

/** \brief The point pairs of a model, indexed by an invariant feature: their distance,
 * and the three angles between the joining line and the normals.
 *
 * A scene pair with an equal feature determines the model's pose: the frame of its
 * first point, turned about the normal by the difference of two angles.
 * \note Source: B. Drost, M. Ulrich, N. Navab, S. Ilic, "Model globally, match locally:
 * efficient and robust 3D object recognition", CVPR 2010. \ingroup
 * object_localization */
class PairFeatureTable {
public:
  /** A pair of the model. */
  struct Entry {
    std::uint32_t first; ///< index of the first point
    float angle; ///< [rad] of the second point about the first's normal, in the first's
                 ///< frame
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

  /** \param[in] model reduced to a spacing of about one distance step
   * \param[in] diameter [m] > 0, the largest distance of a pair
   * \throws BadArgument an option is invalid, or fewer than 3 points */
  PairFeatureTable(const OrientedPoints& model,
                   double diameter,
                   const PairFeatureOptions& options = {});

  /** \return the feature of a pair as a number; -1: too far apart, coincident, or left
   * out as coplanar */
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

  /** \return the transformation from the model into the frame of a point */
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
