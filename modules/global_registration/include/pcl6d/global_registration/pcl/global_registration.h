// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/global_registration/pair_placer.h>
#include <pcl6d/registration/pcl/coarse_registration.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Registers two scans without an initial pose, and tests whether the pose is unique:
 * placeScan() as a pcl::Registration, in place of pcl::SampleConsensusPrerejective or
 * pcl::registration::FPCSInitialAlignment.
 *
 * hasConverged() is true only for a *unique* pose: supported by surfaces and rays, with no
 * second pose that fits nearly as well. Such a pose is matched finely: no ICP is needed after
 * align(). getFinalTransformation() is the best pose, or the guess without a candidate; a guess
 * changes no other result. No pair of scans can tell equal rooms, bays of shelves or levels of
 * a car park apart: see the README of the module.
 *
 * Clouds must be scans: unreduced, in one piece, seen from one position, their sensor_origin_,
 * as in RegistrationVerifier. Each scan is prepared with its own range gate and voxel, the
 * target once for every source. Non-finite points are skipped.
 * \code
 * pcl6d::GlobalRegistration<pcl::PointXYZ, pcl::PointXYZ> placing;
 * placing.setInputTarget(target);
 * placing.setInputSource(source);
 * placing.align(aligned);
 * if (!placing.hasConverged())
 *   std::cerr << toString(placing.answer()) << ": " << placing.reason() << '\n';
 * \endcode
 * \note Source: share/doc/place_recognition.md
 * \ingroup global_registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class GlobalRegistration : public CoarseRegistration<PointSource, PointTarget, Scalar> {
public:
  using Base = CoarseRegistration<PointSource, PointTarget, Scalar>;
  using Ptr = pcl::shared_ptr<GlobalRegistration<PointSource, PointTarget, Scalar>>;
  using ConstPtr =
      pcl::shared_ptr<const GlobalRegistration<PointSource, PointTarget, Scalar>>;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;

  GlobalRegistration() : Base("GlobalRegistration") {}

  /** \brief Sets every option.
   * \throws BadArgument naming the first invalid field and its value */
  void
  setOptions(const PairPlacerOptions& options)
  {
    placer_.setOptions(options);
  }
  const PairPlacerOptions&
  options() const
  {
    return placer_.options();
  }

  /** \brief The largest number of candidates kept.
   * \throws BadArgument 0 */
  void
  setMaximumCandidates(std::size_t candidates)
  {
    change([&](PairPlacerOptions& o) { o.search.candidates = candidates; });
  }
  std::size_t
  getMaximumCandidates() const
  {
    return options().search.candidates;
  }

  /** \brief The largest second score / score of a unique pose.
   * \throws BadArgument unless in [0, 1] */
  void
  setMaximumAmbiguity(double ambiguity)
  {
    change([&](PairPlacerOptions& o) { o.search.max_ambiguity = ambiguity; });
  }
  double
  getMaximumAmbiguity() const
  {
    return options().search.max_ambiguity;
  }

  /** \brief The largest share of surfaces that rays of the other scan pass through, for a
   * unique pose: 0.01 unless set. A larger share accepts scans among people and in traffic,
   * but also folds of symmetric halls.
   * \throws BadArgument unless in [0, 1] */
  void
  setMaximumContradiction(double share)
  {
    change([&](PairPlacerOptions& o) { o.search.max_contradiction = share; });
  }
  double
  getMaximumContradiction() const
  {
    return options().search.max_contradiction;
  }

  /** \brief The least overlap of a unique pose, as share of surfaces: 0.2 unless set.
   * \throws BadArgument unless in [0, 1] */
  void
  setMinimumOverlap(double share)
  {
    change([&](PairPlacerOptions& o) { o.search.min_overlap = share; });
  }
  double
  getMinimumOverlap() const
  {
    return options().search.min_overlap;
  }

  /** \brief The voxel edge [m] for the reduction of both scans; default: each scan by its own
   * voxel.
   * \throws BadArgument unless finite and > 0 */
  void
  setVoxel(const std::optional<double>& voxel)
  {
    change([&](PairPlacerOptions& o) { o.parameters.voxel = voxel; });
  }
  const std::optional<double>&
  getVoxel() const
  {
    return options().parameters.voxel;
  }

  /** \brief Whether to search also for a source that lies on its side. */
  void
  setAnyAxis(bool any_axis)
  {
    change([&](PairPlacerOptions& o) { o.search.any_axis = any_axis; });
  }
  bool
  getAnyAxis() const
  {
    return options().search.any_axis;
  }

  /** \brief The approximate up direction of each cloud: z unless set; -y for a camera that
   * looks along z.
   * \throws BadArgument no unit vector */
  void
  setExpectedUp(const Eigen::Vector3d& target, const Eigen::Vector3d& source)
  {
    change([&](PairPlacerOptions& o) {
      o.target_up = target;
      o.source_up = source;
    });
  }

  /** \param[in] num_threads 0: a thread per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    change([&](PairPlacerOptions& o) { o.search.num_threads = num_threads; });
  }

  /** \return the result of the last align() */
  PlaceAnswer
  answer() const
  {
    return found_.answer;
  }

  /** \return the candidates, the best first, including rejected candidates. T_first_second
   * moves the source cloud onto the target, within a third of a voxel; the evidence is in the
   * scanner frames */
  const std::vector<PlaceCandidate>&
  candidates() const
  {
    return found_.candidates;
  }

  /** \return why the answer is not unique, in words */
  std::string
  reason() const
  {
    return toWords(found_.rejection);
  }
  /** \return why the answer is not unique; false as a condition if it is */
  const Rejection&
  rejection() const
  {
    return found_.rejection;
  }

protected:
  CoarseEstimate
  search(const Points& target,
         const Points& source,
         const Eigen::Isometry3d& guess) const override;

  Eigen::Vector3f
  originOf(const Points& /*points*/,
           const Eigen::Vector3f& sensor_origin) const override
  {
    return sensor_origin;
  }

  /** \throws BadArgument as CoarseRegistration */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  template <typename Change>
  void
  change(const Change& what)
  {
    PairPlacerOptions options = placer_.options();
    what(options);
    placer_.setOptions(options);
  }

  mutable PairPlacer placer_; // caches the prepared clouds
  mutable PlaceResult found_;
};

} // namespace pcl6d
#include <pcl6d/global_registration/pcl/impl/global_registration.hpp>

#include <pcl/point_types.h>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(GlobalRegistration)
} // namespace pcl6d
