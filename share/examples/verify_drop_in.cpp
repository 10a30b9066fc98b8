// SPDX-License-Identifier: BSD-3-Clause
// Shows: after any pcl::Registration, pcl6d::RegistrationVerifier tells a right pose from a
// wrong one, where hasConverged() and the fitness score do not.
#include "synthetic.h"

#include <pcl6d/verification/pcl/registration_verifier.h>

#include <pcl/registration/gicp.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

// PCL's GICP from a guess, and what the points and rays of both scans say of its result.
pcl6d::LinkTrust
registerAndVerify(const Cloud::ConstPtr& source,
                  const Cloud::ConstPtr& target,
                  const Eigen::Isometry3d& guess,
                  const char* name)
{
  pcl::GeneralizedIterativeClosestPoint<Point, Point> icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaximumIterations(100);
  icp.setMaxCorrespondenceDistance(0.5); // [m]
  Cloud aligned;
  icp.align(aligned, guess.matrix().cast<float>());

  pcl6d::RegistrationVerifier<Point> verifier;
  verifier.setInputSource(source); // as measured, neither reduced nor moved
  verifier.setInputTarget(target);
  const pcl6d::PairVerdict verdict = verifier.verify(icp.getFinalTransformation());
  std::printf(
      "%-10s PCL: %s, fitness %.4f m^2; PCL6D: %s (%zu of %zu patches contradicted) "
      "%s\n",
      name,
      icp.hasConverged() ? "converged" : "not converged",
      icp.getFitnessScore(),
      pcl6d::toString(verdict.test_result.trust),
      verdict.evidence.sight.contradicted_patches,
      verdict.evidence.sight.patches,
      toWords(verdict.test_result.rejection).c_str());
  return verdict.test_result.trust;
}

int
main()
{
  const Eigen::Isometry3d first = pcl6d::poseFromEuler({0, 0, 0}, {0, 0, 0});
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.6, 0.3, 0}, {0, 0, 0.2}); // [m], [rad]
  const Cloud::Ptr target = scanRoom(first), source = scanRoom(first * truth);

  const auto right = registerAndVerify(source, target, truth, "near");
  const auto wrong = registerAndVerify(
      source, target, truth * pcl6d::planarPose(0, 0, M_PI), "turned");
  const bool told =
      right == pcl6d::LinkTrust::kGood && wrong != pcl6d::LinkTrust::kGood;
  std::puts(told ? "the wrong pose is told from the right one" : "a verdict is WRONG");
  return told ? 0 : 1;
}
