// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "evidence_parts.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace verification;

namespace {
/** Ratio of successive displacements: the precision of the result. */
constexpr double kLadder = 1.5;

/** The first displacement, in standard deviations: smaller ones are never detected. */
constexpr double kFirst = 3;

/** Tests a link at displaced poses. */
class DisplacedLink {
public:
  DisplacedLink(const VerifiedScan& first,
                const VerifiedScan& second,
                const LinkEvidence& evidence,
                double background)
  : first_(first), second_(second), evidence_(evidence), background_(background)
  {}

  /** \param[in] motion about the centroid of the pairs, in the frame of the first scan
   * \return whether the displaced link would no longer be good */
  bool
  isNoticed(const Twist& motion) const
  {
    const Eigen::Vector3d centre = evidence_.fit.centroid;
    const Eigen::Isometry3d T = Eigen::Translation3d(centre) * motionFromTwist(motion) *
                                Eigen::Translation3d(-centre) *
                                evidence_.T_first_second;
    LinkEvidence there = evidence_;
    const SurfaceFit fit = settledFit(
        first_, second_, T, evidence_.voxel, kProbedPoints, kProbedSteps, false);
    there.fit.step = fit.step; // the deviation stays: from all points
    if (testLink(there, background_).trust != LinkTrust::kGood)
      return true;
    there.sight = sightBothWays(first_, second_, T, evidence_.voxel, there.fit);
    return testLink(there, background_).trust != LinkTrust::kGood;
  }

  /** \param[in] unit a motion of size 1 \return the detectable size in both directions;
   * infinite if no size up to the limit is detected */
  double
  leastNoticed(const Twist& unit, double first, double limit) const
  {
    for (double size = first; size < limit; size *= kLadder)
      if (isNoticed(size * unit) && isNoticed(-size * unit))
        return size;
    return std::numeric_limits<double>::infinity();
  }

private:
  const VerifiedScan& first_;
  const VerifiedScan& second_;
  const LinkEvidence& evidence_;
  double background_;
};
} // namespace

std::optional<NoticedError>
noticedError(const VerifiedScan& first,
             const VerifiedScan& second,
             const LinkEvidence& evidence,
             double background)
{
  if (testLink(evidence, background).trust != LinkTrust::kGood)
    return std::nullopt;
  const DisplacedLink link(first, second, evidence, background);
  const SurfaceFit& fit = evidence.fit;
  const double start = kFirst * evidence.deviation();
  NoticedError noticed;
  noticed.most = noticed.turn = 0;
  const auto shifts = symmetricEigen<3>(fit.covariance.topLeftCorner<3, 3>());
  const auto turns = symmetricEigen<3>(fit.covariance.bottomRightCorner<3, 3>());
  for (int k = 2; k >= 0; --k) { // the least sensitive direction first
    Twist shift = Twist::Zero(), turn = Twist::Zero();
    shift.head<3>() = shifts.vectors.col(k);
    turn.tail<3>() = turns.vectors.col(k);
    const double size = link.leastNoticed(shift, start, fit.spread);
    if (size > noticed.most) {
      noticed.most = size;
      noticed.weakest = shifts.vectors.col(k);
    }
    noticed.least = std::min(noticed.least, size);
    // Turns with an equal displacement of the pairs, up to a straight angle.
    noticed.turn = std::max(
        noticed.turn, link.leastNoticed(turn, start / fit.spread, 3.141592653589793));
  }
  return noticed;
}

} // namespace pcl6d
