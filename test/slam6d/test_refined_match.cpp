// SPDX-License-Identifier: BSD-3-Clause
// The end of a match between sparse lines, where many normals belong to no surface.
#include "matching/refined_match.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/registration/icp_model.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::icp;
using pcl6d::IcpModel;
using pcl6d::IcpOptions;
using pcl6d::IcpResult;
using pcl6d::Metric;
using pcl6d::Normals;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::RobustKernel;
using pcl6d::Status;
using pcl6d::slam6d::areNormalsUncertain;
using pcl6d::slam6d::refineMatch;

const Eigen::Isometry3d kTruth = Eigen::Isometry3d::Identity();

/** A corner of three walls, and points whose patches cover two surfaces: of another height in each
 * scan, with normals that claim to know the height. */
class Corner {
public:
  Corner(std::uint64_t seed, double height_of_steps, bool has_walls = true)
  : random_(seed)
  {
    for (int i = 0; i < 1200; ++i)
      for (int axis = 0; axis < 3; ++axis)
        if (has_walls || axis == 2)
          add(axis,
              random_.uniform(0, 4),
              random_.uniform(0, 4),
              0.005 * random_.normal());
    for (int i = 0; i < 400; ++i)
      add(2, random_.uniform(0, 4), random_.uniform(0, 4), -1 + height_of_steps);
  }

  IcpModel
  model() const
  {
    return IcpModel(points_, normals_, {});
  }

private:
  void
  add(int axis, double a, double b, double across)
  {
    Eigen::Vector3d p;
    p[axis] = across;
    p[(axis + 1) % 3] = a;
    p[(axis + 2) % 3] = b;
    points_.push_back(p.cast<float>());
    normals_.push_back(Eigen::Vector3f::Unit(axis));
  }

  Random random_;
  Points points_;
  Normals normals_;
};

IcpOptions
matchOptions()
{
  IcpOptions options;
  options.metric = Metric::kGicp;
  options.gicp_epsilon = 0.01;
  options.max_distance = 0.5;
  options.max_distance_start = 1;
  return options;
}

struct Match {
  IcpModel target, source;
  IcpOptions options = matchOptions();

  IcpResult
  found() const
  {
    const Eigen::Isometry3d guess = poseFromEuler({0.05, -0.03, 0.08}, {0.01, 0, 0.01});
    return icp({target.part()}, source.source(), guess, options);
  }

  IcpResult
  refined(const IcpResult& found) const
  {
    IcpResult refined = found;
    refineMatch({target.part()}, source.source(), options, refined);
    return refined;
  }
};

double
errorOf(const IcpResult& match)
{
  return pcl6d::distanceBetween(kTruth, match.T_target_source).translation;
}

TEST(RefinedMatch, IsRightWhereWrongNormalsPull)
{
  const Match match{Corner(1, 0.2).model(), Corner(2, 0).model()};
  const IcpResult found = match.found();
  ASSERT_EQ(found.status, Status::kOk);
  EXPECT_GT(errorOf(found), 0.03) << "nothing pulls";
  const IcpResult refined = match.refined(found);
  EXPECT_LT(errorOf(refined), 0.004);
  EXPECT_GT(refined.iterations, found.iterations);
  EXPECT_EQ(refined.status, found.status);
  EXPECT_EQ(refined.pairs, found.pairs);
  EXPECT_EQ(refined.rms, found.rms);
  EXPECT_EQ(refined.overlap, found.overlap);
  EXPECT_EQ(*refined.covariance, *found.covariance);
}

TEST(RefinedMatch, StaysWhereEveryNormalIsRight)
{
  const Match match{Corner(3, 0).model(), Corner(4, 0).model()};
  const IcpResult found = match.found();
  EXPECT_LT(errorOf(found), 0.001);
  EXPECT_LT(errorOf(match.refined(found)), 0.001);
}

TEST(RefinedMatch, LeavesOpenMotionsAlone)
{
  const Match match{Corner(5, 0.2, false).model(), Corner(6, 0, false).model()};
  const IcpResult found = match.found();
  ASSERT_EQ(found.status, Status::kRankDeficient);
  const IcpResult refined = match.refined(found);
  EXPECT_EQ(refined.T_target_source.matrix(), found.T_target_source.matrix());
  EXPECT_EQ(refined.iterations, found.iterations);
}

TEST(RefinedMatch, LeavesOtherMetricsAndKernelsAlone)
{
  Match match{Corner(7, 0.2).model(), Corner(8, 0).model()};
  const auto expectUnchanged = [&match] {
    const IcpResult found = match.found();
    const IcpResult refined = match.refined(found);
    EXPECT_EQ(refined.T_target_source.matrix(), found.T_target_source.matrix());
    EXPECT_EQ(refined.iterations, found.iterations);
  };
  match.options.metric = Metric::kPlane;
  expectUnchanged();
  match.options = matchOptions();
  match.options.robust = RobustKernel::kHuber;
  expectUnchanged();
}

TEST(RefinedMatch, StaysAfterFailure)
{
  const Match match{Corner(9, 0.2).model(), Corner(10, 0).model()};
  IcpResult failed;
  failed.T_target_source = poseFromEuler({100, 0, 0}, {});
  for (const Status status : {Status::kTooFewPairs, Status::kDiverged, Status::kOk}) {
    failed.status = status;
    const IcpResult after = match.refined(failed);
    EXPECT_EQ(after.T_target_source.matrix(), failed.T_target_source.matrix());
    EXPECT_EQ(after.status, status);
  }
}

TEST(RefinedMatch, IsForLinesAboutAsFarApartAsVoxels)
{
  EXPECT_TRUE(areNormalsUncertain(0.361, 1.3 * 0.361)) << "16 rings, derived voxel";
  EXPECT_TRUE(areNormalsUncertain(0.361, 0.1)) << "a finer voxel";
  EXPECT_FALSE(areNormalsUncertain(0.061, 0.18)) << "dense lines";
  EXPECT_FALSE(areNormalsUncertain(0, 0.18)) << "no lines";
}
} // namespace
