// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "pair/pair_places.h"
#include "pair/place_matching.h"
#include "pair/place_support.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/twist.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl6d::global_registration {

namespace {
/** Tested distances along an open motion: the nearest different pose, then doubled steps. This
 * range reaches the pillars and doors of a corridor: 8 times a cell and a half are 2 m in
 * rooms, 10 m in a street. */
constexpr double kAlong[] = {1, 2, 4, 8};

/** \return motions of the second scan along the directions left open by the surfaces, each
 * moving the pairs by a distance of 1 m, rms */
std::vector<Twist>
openMotions(const SurfaceFit& fit)
{
  const auto eigen = symmetricEigen<6>(fit.covariance);
  std::vector<Twist> motions;
  for (int k = 0; k < std::min(fit.open_directions, 6); ++k) {
    const Twist motion = eigen.vectors.col(5 - k); // the most uncertain first
    const double turning = fit.spread * motion.tail<3>().norm();
    motions.push_back(motion /
                      Eigen::Vector2d(motion.head<3>().norm(), turning).norm());
  }
  return motions;
}
} // namespace

PairPlaces::PairPlaces(const PlaceableScan& first, const PlaceableScan& second)
: first_(first)
, second_(second)
, voxel_(std::max(first.scan().voxel(), second.scan().voxel()))
, cell_(std::max(first.cell(), second.cell()))
{}

bool
PairPlaces::areNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const MotionSize apart = distanceBetween(a, b);
  return apart.translation < kOtherCells * cell_ && apart.rotation < kOtherTurn;
}

PlaceStart
PairPlaces::matched(const Eigen::Isometry3d& T_first_second,
                    const PlaceableScan::Sample& sample) const
{
  const IcpResult found = icp({first_.scan().surfaces().part()},
                              {&sample.points, &sample.normals},
                              T_first_second,
                              matchingOptions(voxel_, 2 * cell_));
  PlaceStart place;
  place.T_first_second = found.T_target_source;
  place.score = supportOf(first_,
                          second_,
                          place.T_first_second,
                          kMetVoxels * voxel_,
                          kPlaceVoxels * voxel_)
                    .score(kContradictedMatch);
  return place;
}

PlaceCandidate
PairPlaces::evaluated(const Eigen::Isometry3d& T_first_second) const
{
  PlaceCandidate one;
  one.T_first_second = T_first_second;
  one.overlap = supportOf(first_,
                          second_,
                          one.T_first_second,
                          kMetVoxels * voxel_,
                          kPlaceVoxels * voxel_)
                    .overlap();
  one.evidence = linkEvidence(first_.scan(), second_.scan(), one.T_first_second);
  one.contradiction = one.evidence.sight.contradiction();
  one.score = one.overlap * portableExp(-one.contradiction / kContradictedPlace);
  one.test_result = testLink(one.evidence, contradictionBackground({}));
  return one;
}

bool
PairPlaces::isHeld(const PlaceCandidate& best, double most_ambiguity) const
{
  const SurfaceFit& fit = best.evidence.fit;
  for (const Twist& motion : openMotions(fit))
    for (const double along : kAlong)
      for (const double sign : {1.0, -1.0}) {
        const Twist way = sign * along * kOtherCells * cell_ * motion;
        const Eigen::Isometry3d moved =
            Eigen::Translation3d(fit.centroid) * motionFromTwist(way) *
            Eigen::Translation3d(-fit.centroid) * best.T_first_second;
        const Eigen::Isometry3d place =
            matched(moved, second_.evaluated()).T_first_second;
        if (!areNear(place, best.T_first_second) &&
            evaluated(place).score > most_ambiguity * best.score)
          return false;
      }
  return true;
}

} // namespace pcl6d::global_registration
