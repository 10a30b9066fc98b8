// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "evidence_parts.h"
#include "refined_fit.h"
#include "surface_pairs.h"

#include <pcl6d/registration/reduced_scans.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace verification;

namespace {
/** An even selection of the values. */
std::vector<Eigen::Vector3f>
sampleOf(const std::vector<Eigen::Vector3f>& values)
{
  const std::size_t stride = std::max<std::size_t>(1, values.size() / kLookedAt);
  std::vector<Eigen::Vector3f> sample;
  for (std::size_t i = 0; i < values.size(); i += stride)
    sample.push_back(values[i]);
  return sample;
}

SightEvidence
lookFrom(const VerifiedScan& from,
         const VerifiedScan& at,
         const Eigen::Isometry3d& T_from_at,
         double voxel,
         const SurfaceFit& fit,
         std::vector<Contradiction>* contradictions)
{
  PlaceUncertainty uncertainty;
  const double misfit = std::min(fit.residual, kMostMisfit * voxel);
  uncertainty.noise = std::sqrt(at.noise() * at.noise() + misfit * misfit);
  const Points points = sampleOf(at.surfaces().points());
  const Normals normals = sampleOf(at.surfaces().normals());
  return sightEvidence(from.rays(),
                       TestedSurface(points, normals),
                       T_from_at,
                       uncertainty,
                       {std::max(kPatchVoxels * voxel, kPatchSpread * fit.spread),
                        std::min(kLargestThing, fit.spread)},
                       contradictions);
}

/** Fits surfaces to each other in several steps, up to the least residual. */
class Settling {
public:
  Settling(const VerifiedScan& first,
           const VerifiedScan& second,
           const Eigen::Isometry3d& T_first_second,
           const SurfaceFitOptions& options)
  : first_(first), second_(second), options_(options), T_(T_first_second)
  {
    pairs_ = pairSurfaces(first_, second_, T_, options_);
    fit_ = fitOf(pairs_, options_);
    moved_ = fit_.step;
  }

  /** Takes up to the given number of steps. A step without any pairs is reverted. */
  void
  go(int steps, double voxel)
  {
    for (int k = 0; k < steps && isMoving(voxel); ++k) {
      const Eigen::Isometry3d T = Eigen::Translation3d(fit_.centroid) *
                                  motionFromTwist(fit_.step) *
                                  Eigen::Translation3d(-fit_.centroid) * T_;
      SurfacePairs pairs = pairSurfaces(first_, second_, T, options_);
      const SurfaceFit fit = fitOf(pairs, options_);
      if (fit.spread == 0)
        return;
      pairs_ = std::move(pairs);
      fit_ = fit;
      T_ = T;
      moved_ += fit.step;
    }
  }

  bool
  isMoving(double voxel) const
  {
    return fit_.displacement() > kSettled * voxel;
  }

  const Eigen::Isometry3d&
  place() const
  {
    return T_;
  }

  /** \return the last fit, with the sum of all steps */
  SurfaceFit
  result(bool with_covariance) const
  {
    SurfaceFit fit = fit_;
    if (with_covariance) {
      SurfaceFitOptions options = options_;
      options.covariance = true;
      fit = fitOf(pairs_, options);
    }
    fit.step = moved_;
    return fit;
  }

private:
  const VerifiedScan& first_;
  const VerifiedScan& second_;
  SurfaceFitOptions options_;
  Eigen::Isometry3d T_;
  SurfacePairs pairs_; // at T_
  SurfaceFit fit_;     // from pairs_
  Twist moved_;
};

SurfaceFitOptions
optionsOf(double voxel, std::size_t points)
{
  SurfaceFitOptions options;
  options.max_distance = kPlanePairVoxels * voxel;
  options.points = points;
  options.covariance = false;
  return options;
}
} // namespace

namespace verification {
SurfaceFit
settledFit(const VerifiedScan& first,
           const VerifiedScan& second,
           const Eigen::Isometry3d& T_first_second,
           double voxel,
           std::size_t points,
           int steps,
           bool with_covariance)
{
  Settling surfaces(first, second, T_first_second, optionsOf(voxel, points));
  surfaces.go(steps - 1, voxel);
  return surfaces.result(with_covariance);
}

SightEvidence
sightBothWays(const VerifiedScan& first,
              const VerifiedScan& second,
              const Eigen::Isometry3d& T_first_second,
              double voxel,
              const SurfaceFit& fit,
              std::vector<Contradiction>* contradictions)
{
  SightEvidence sight;
  if (!first.abstains())
    sight += lookFrom(first, second, T_first_second, voxel, fit, contradictions);
  if (!second.abstains())
    sight += lookFrom(second, first, T_first_second.inverse(), voxel, fit, nullptr);
  return sight;
}
} // namespace verification

double
LinkEvidence::deviation() const
{
  return std::max(fit.deviation(), kResolution * voxel);
}

LinkEvidence
withThingsOnce(LinkEvidence evidence)
{
  SightEvidence& sight = evidence.sight;
  const std::size_t once_more = sight.patches_of_things - sight.things;
  sight.patches -= once_more;
  sight.contradicted_patches -= once_more;
  sight.patches_of_things = sight.things;
  return evidence;
}

namespace {
/** Continues a fit before convergence. The final pose is taken if more patches are confirmed and no
 * more are contradicted: scans near a door can also slide through it. */
void
settleFarther(const VerifiedScan& first,
              const VerifiedScan& second,
              Settling surfaces,
              LinkEvidence& evidence)
{
  const double voxel = evidence.voxel;
  surfaces.go(kMostSteps - kSteps, voxel);
  const SurfaceFit fit = surfaces.result(true);
  const SightEvidence there =
      sightBothWays(first, second, surfaces.place(), voxel, fit, nullptr);
  if (there.confirmed_patches > evidence.sight.confirmed_patches &&
      there.contradicted_patches <= evidence.sight.contradicted_patches)
    evidence.fit = fit;
}
} // namespace

LinkEvidence
linkEvidence(const VerifiedScan& first,
             const VerifiedScan& second,
             const Eigen::Isometry3d& T_first_second,
             std::vector<Contradiction>* contradictions)
{
  LinkEvidence evidence;
  evidence.T_first_second = T_first_second;
  evidence.voxel = std::max(first.voxel(), second.voxel());
  evidence.abstained = first.abstains() || second.abstains();
  evidence.off_centre = first.isOffCentre() || second.isOffCentre();
  Settling surfaces(
      first, second, T_first_second, optionsOf(evidence.voxel, kPairedPoints));
  surfaces.go(kSteps - 1, evidence.voxel);
  const bool is_moving = surfaces.isMoving(evidence.voxel);
  evidence.fit = surfaces.result(true);
  evidence.sight = sightBothWays(
      first, second, T_first_second, evidence.voxel, evidence.fit, contradictions);
  if (is_moving)
    settleFarther(first, second, surfaces, evidence);
  return evidence;
}

void
refineEvidence(const VerifiedScan& first,
               const VerifiedScan& second,
               LinkEvidence& evidence)
{
  evidence.refined = refinedFit(
      first, second, evidence.T_first_second, optionsOf(evidence.voxel, kPairedPoints));
}

namespace {
/** \return the matrix from a small motion about the centroid of the pairs, in the frame of the
 * first scan, to a motion about the second scan's origin in its axes */
Eigen::Matrix<double, 6, 6>
intoSecondScan(const LinkEvidence& evidence, const SurfaceFit& fit)
{
  const Eigen::Matrix3d R = evidence.T_first_second.linear().transpose();
  const Eigen::Vector3d arm = evidence.T_first_second.translation() - fit.centroid;
  Eigen::Matrix3d cross;
  cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Zero();
  J.topLeftCorner<3, 3>() = R;
  J.topRightCorner<3, 3>() = -R * cross; // w x arm
  J.bottomRightCorner<3, 3>() = R;
  return J;
}
} // namespace

LinkCheck
linkCheck(std::size_t from,
          std::size_t to,
          const LinkEvidence& evidence,
          const LinkTestResult& test_result)
{
  LinkCheck link;
  link.from = from;
  link.to = to;
  link.trust = test_result.trust;
  link.probability_wrong = test_result.probability_wrong;
  link.elsewhere = test_result.elsewhere;
  link.patches = evidence.sight.patches;
  link.contradicted = evidence.sight.contradicted_patches;
  link.shift = evidence.leaving();
  link.deviation = evidence.deviation();
  link.open_directions = evidence.fit.open_directions;
  link.rejection = test_result.rejection;
  const SurfaceFit& of_pose = evidence.refined ? *evidence.refined : evidence.fit;
  const Eigen::Matrix<double, 6, 6> J = intoSecondScan(evidence, of_pose);
  link.covariance = J * of_pose.pose_covariance * J.transpose();
  link.pull = J * of_pose.step;
  link.refined = evidence.refined.has_value();
  return link;
}

std::vector<Contradiction>
contradictedPoints(const VerifiedScan& from,
                   const VerifiedScan& at,
                   const Eigen::Isometry3d& T_from_at)
{
  std::vector<Contradiction> points;
  const double voxel = std::max(from.voxel(), at.voxel());
  if (!from.abstains())
    lookFrom(from,
             at,
             T_from_at,
             voxel,
             settledFit(from, at, T_from_at, voxel, kPairedPoints, kMostSteps, true),
             &points);
  return points;
}

} // namespace pcl6d
