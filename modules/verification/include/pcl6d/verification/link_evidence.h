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

/** \brief What two scans say of their relative pose. */
struct LinkEvidence {
  SightEvidence
      sight;      ///< points of each in the rays of the other; empty if both abstain
  SurfaceFit fit; ///< of their surfaces, after a few steps towards their best place
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity(); ///< that was judged
  double voxel = 0;       ///< [m] the larger one
  bool abstained = false; ///< the rays of one of them say nothing

  /** \return [m] how far the surfaces would move the pairs */
  double
  leaving() const
  {
    return fit.displacement();
  }
  /** \return [m] standard deviation of the place of the pairs: never less than a tenth of
   * the voxel, below which surfaces of reduced points are not told apart */
  double
  deviation() const;
};

/** \brief Collects the evidence of a link.
 * \param[in] T_first_second pose of the second scan seen from the first
 * \param[out] contradictions if given: points of the second scan, in its frame, that the
 * rays of the first contradict */
LinkEvidence
linkEvidence(const VerifiedScan& first,
             const VerifiedScan& second,
             const Eigen::Isometry3d& T_first_second,
             std::vector<Contradiction>* contradictions = nullptr);

/** \brief The same, with each contradicted thing that stands alone counted as one patch.
 *
 * The patches of one thing are no independent witnesses: a person who walked on between two scans
 * makes five or six of them where the scanner stands near, and a link is doubted that all walls
 * confirm. But a place that looks like the right one is contradicted by such things alone, too: a
 * parked car, a pillar. So this is for places that something else speaks for, such as odometry;
 * a place found anywhere, and a map, are judged by all patches. */
LinkEvidence
withThingsOnce(LinkEvidence evidence);

/** \brief The judgement on a link. */
struct LinkOpinion {
  LinkTrust trust = LinkTrust::kWeak;
  double probability_wrong = 1; ///< in [0, 1]
  double elsewhere = 1; ///< of this: the probability of another place, by the rays
  double beside = 1;    ///< of this: that of a shift, by the surfaces
  std::string reason;   ///< in words, with numbers; empty for a good link
};

/** \brief A link between two places of a map, in plain data. Its covariance is that of the
 * surfaces with a quarter of the error that all their pairs may share: what many links hold is
 * known better than one of them may be judged; see share/doc/trust.md. */
LinkCheck
linkCheck(std::size_t from,
          std::size_t to,
          const LinkEvidence& evidence,
          const LinkOpinion& opinion);

/** \return the points of a scan, in its frame, that the rays of another contradict; none if
 * those abstain. \param[in] T_from_at pose of the points' scan seen from that of the rays */
std::vector<Contradiction>
contradictedPoints(const VerifiedScan& from,
                   const VerifiedScan& at,
                   const Eigen::Isometry3d& T_from_at);

/** \brief The share of patches that right links contradict, from the links of a run: the
 * better half of them, as most links of most runs are right. At least 0.002. Above 0.05 rays
 * are no judges of this run; if the better half contradicts more than 0.12, it is not right.
 * \param[in] links fewer than two, or not right: what scans have on average */
double
contradictionBackground(const std::vector<LinkEvidence>& links);

/** \brief Judges a link: how much more likely its contradicted patches are of a wrong one
 * than of a right one, and how many standard deviations its surfaces would leave it by.
 * \param[in] background of contradictionBackground(); in (0, 1)
 * \throws BadArgument background is not
 * \note Source: share/doc/trust.md \ingroup verification */
LinkOpinion
judgeLink(const LinkEvidence& evidence, double background);

/** \brief Displaces a link by more and more along and about its three axes, both ways, until
 * the scans would no longer call it good. Axes: those of the covariance of the surfaces.
 * \param[in] evidence of the link where it is
 * \param[in] background of contradictionBackground()
 * \return none if the link is not good where it is
 * \note Source: algorithms.md T.4 */
std::optional<NoticedError>
noticedError(const VerifiedScan& first,
             const VerifiedScan& second,
             const LinkEvidence& evidence,
             double background);

} // namespace pcl6d
