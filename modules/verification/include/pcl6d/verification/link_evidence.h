// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/verification/surface_fit.h>
#include <pcl6d/verification/verified_scan.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The evidence of two scans on their relative pose. */
struct LinkEvidence {
  SightEvidence sight; ///< points of each scan against the other's rays; empty if both
                       ///< scans' rays are unusable
  SurfaceFit fit;      ///< of the surfaces, after a few steps towards their best fit
  /** of the surfaces with the weights of refined matches; none unless asked for */
  std::optional<SurfaceFit> refined;
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity(); ///< tested pose
  double voxel = 0;        ///< [m] of the coarser scan
  bool abstained = false;  ///< rays of a scan are unusable
  bool off_centre = false; ///< because a scan's origin is not its scanner

  /** \return [m] rms shift of the pairs required by the surfaces */
  double
  leaving() const
  {
    return fit.displacement();
  }
  /** \return [m] standard deviation of the pairs' position, at least a tenth of the voxel: smaller
   * shifts cannot be resolved with reduced points */
  double
  deviation() const;
};

/** \brief Collects the evidence of a link.
 * \param[in] T_first_second pose of the second scan seen from the first
 * \param[out] contradictions if given: points of the second scan, in its frame, contradicted by
 * rays of the first */
LinkEvidence
linkEvidence(const VerifiedScan& first,
             const VerifiedScan& second,
             const Eigen::Isometry3d& T_first_second,
             std::vector<Contradiction>* contradictions = nullptr);

/** \brief Adds LinkEvidence::refined: where many normals belong to no surface, pairs of equal planes
 * count, and pairs whose planes lie apart lose their weight, as in refined matches. None if the
 * motion to rest is longer than the pair distance, or does not end, or surfaces leave it open.
 * \note Source: share/doc/trust.md, Refined links */
void
refineEvidence(const VerifiedScan& first,
               const VerifiedScan& second,
               LinkEvidence& evidence);

/** \brief Counts each contradicted isolated object as a single patch.
 *
 * The patches of an object are not independent: a person who walked on between two scans covers
 * five or six patches near the scanner, enough to reject a link confirmed by all walls. A wrong
 * pose at a similar place, however, may also be contradicted only by isolated objects: a parked
 * car, a pillar. To be used only for poses supported by further evidence, such as odometry; for
 * poses without prediction and for maps, all patches count. */
LinkEvidence
withThingsOnce(LinkEvidence evidence);

/** \brief The result of a link test. */
struct LinkTestResult {
  LinkTrust trust = LinkTrust::kWeak;
  double probability_wrong = 1; ///< in [0, 1]
  double elsewhere = 1;         ///< probability of a different pose, by rays
  double beside = 1;            ///< probability of a shift, by surfaces
  Rejection rejection;          ///< why the link is not consistent
};

/** \brief A tested link of a map, in plain data. The covariance is taken from the surfaces, with a
 * quarter of the error common to all pairs: many links determine a pose more accurately than the
 * test of a single link may assume; see share/doc/trust.md. With LinkEvidence::refined, covariance
 * and pull are of this fit. */
LinkCheck
linkCheck(std::size_t from,
          std::size_t to,
          const LinkEvidence& evidence,
          const LinkTestResult& test_result);

/** \return the points of a scan, in its frame, contradicted by rays of another scan; none if the
 * rays are unusable. \param[in] T_from_at pose of the points' scan seen from the rays' scan */
std::vector<Contradiction>
contradictedPoints(const VerifiedScan& from,
                   const VerifiedScan& at,
                   const Eigen::Isometry3d& T_from_at);

/** \brief The share of patches contradicted in right links, estimated from the better half of a
 * run's links, because most links of most runs are right, up to the first link that is wrong by the
 * background of better ones. At least 0.002. Above 0.05 ray tests are inconclusive in this run; a
 * better half with more than 0.12 is wrong.
 * \param[in] links if fewer than two, or wrong: the average of scans is returned */
double
contradictionBackground(const std::vector<LinkEvidence>& links);

/** \brief Tests a link by two criteria: the likelihood ratio of its contradicted patches for a
 * wrong and a right link, and the shift required by its surfaces, in standard deviations.
 * \param[in] background of contradictionBackground(); in (0, 1)
 * \throws BadArgument background out of range
 * \note Source: share/doc/trust.md \ingroup verification */
LinkTestResult
testLink(const LinkEvidence& evidence, double background);

/** \brief Displaces a link increasingly along and about three axes, in both directions, until the
 * test finds it inconsistent. Axes: principal axes of the surfaces' covariance.
 * \param[in] evidence of the link at its pose
 * \param[in] background of contradictionBackground()
 * \return none if the link is not consistent at its pose
 * \note Source: share/doc/trust.md, Detectable shift */
std::optional<NoticedError>
noticedError(const VerifiedScan& first,
             const VerifiedScan& second,
             const LinkEvidence& evidence,
             double background);

} // namespace pcl6d
