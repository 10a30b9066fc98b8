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

/** \brief Places one scan on another without any guess, and says whether it is the only
 * place: placeScan() as a pcl::Registration, where code says
 * pcl::SampleConsensusPrerejective or pcl::registration::FPCSInitialAlignment.
 *
 * hasConverged() is true only for a place that is *unique*: good by surfaces and rays, and
 * no other nearly as good. It is matched finely then: no ICP is needed after it.
 * getFinalTransformation() is the best place, or the guess if there is none; a guess changes
 * nothing else. Of equal rooms, bays of shelves, levels of a car park no pair of scans can
 * tell which is which: see the README of the module.
 *
 * Clouds must be scans: unreduced, in one piece, seen from one place, their sensor_origin_,
 * as RegistrationVerifier has it. Each is made ready by its own range gate and voxel, the
 * target once for all sources. Points that are not finite are left out.
 * \code
 * pcl6d::GlobalRegistration<pcl::PointXYZ, pcl::PointXYZ> placing;
 * placing.setInputTarget(target);
 * placing.setInputSource(source);
 * placing.align(aligned);
 * if (!placing.hasConverged())
 *   std::cerr << toString(placing.answer()) << ": " << placing.reason() << '\n';
 * \endcode
 * \note Source: algorithms.md G \ingroup global_registration */
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

  /** \brief All knobs at once. \throws BadArgument naming the first field that breaks its
   * rule, with its value */
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

  /** \brief So many places are kept. \throws BadArgument 0 */
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

  /** \brief The largest second score / score of a unique place. \throws BadArgument unless
   * in [0, 1] */
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

  /** \brief The largest share of surfaces that the other scan looked through, of a unique
   * place: 0.01 unless set. More lets scans among people and in traffic be placed, and folds
   * of symmetric halls. \throws BadArgument unless in [0, 1] */
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

  /** \brief The least share of surfaces that meet at a unique place: 0.2 unless set.
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

  /** \brief The edge [m] of the cubes by which both are reduced; none: each by its own.
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

  /** \brief Whether a source is also looked for as if it lay on its side. */
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

  /** \brief Which way is up in each cloud, about: z unless set; of a camera that looks along
   * z it is -y. \throws BadArgument no unit vector */
  void
  setExpectedUp(const Eigen::Vector3d& target, const Eigen::Vector3d& source)
  {
    change([&](PairPlacerOptions& o) {
      o.target_up = target;
      o.source_up = source;
    });
  }

  /** \param[in] num_threads 0: one per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    change([&](PairPlacerOptions& o) { o.search.num_threads = num_threads; });
  }

  /** \return what the last align() came to */
  PlaceAnswer
  answer() const
  {
    return found_.answer;
  }

  /** \return the places that it looked at, the best first, also those not accepted:
   * T_first_second moves the source cloud onto the target, within a third of a voxel; their
   * evidence is in the frames of the scanners */
  const std::vector<PlaceCandidate>&
  candidates() const
  {
    return found_.candidates;
  }

  /** \return why the answer is not unique, in words */
  const std::string&
  reason() const
  {
    return found_.reason;
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

  mutable PairPlacer placer_; // remembers what it made of the clouds
  mutable PlaceResult found_;
};

} // namespace pcl6d
#include <pcl6d/global_registration/pcl/impl/global_registration.hpp>

#include <pcl/point_types.h>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(GlobalRegistration)
} // namespace pcl6d
