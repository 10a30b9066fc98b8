// SPDX-License-Identifier: BSD-3-Clause
// Input that allows no answer: ICP says so, and never calls a pose fixed that is not.
#include "icp_cases.h"
#include "support/constants.h"

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::badArgumentOf;
using pcl6d::test::corner;
using pcl6d::test::kAllMetrics;
using pcl6d::test::kIdentity;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::sameBits;
using pcl6d::test::Surface;

namespace {

IcpResult
run(const Surface& target,
    const Surface& source,
    Metric metric,
    const Eigen::Isometry3d& guess = kIdentity)
{
  IcpOptions options;
  options.metric = metric;
  const IcpModel model = target.model(), data = source.model();
  return icp({model.part()}, data.source(), guess, options);
}

/** Expects honest numbers whatever came out. */
void
expectSound(const IcpResult& result)
{
  EXPECT_TRUE(std::isfinite(result.rms));
  EXPECT_TRUE(std::isfinite(result.residual));
  EXPECT_GE(result.overlap, 0);
  EXPECT_LE(result.overlap, 1);
  if (result.information) {
    EXPECT_TRUE(result.information->allFinite());
  }
  if (result.covariance) {
    EXPECT_TRUE(result.covariance->allFinite());
  }
}

class IcpBadInput : public testing::TestWithParam<Metric> {
protected:
  Random random_{1};
  Surface scene_ = corner(random_, 900, 2, 0.002);
};

std::string
nameOf(const testing::TestParamInfo<Metric>& tested)
{
  return toString(tested.param);
}
} // namespace

TEST_P(IcpBadInput, GuessesThatAreNotFiniteAreNoSuccess)
{
  for (const float bad : {kNan, kInfinity, -kInfinity, 3e38f}) {
    Eigen::Isometry3d shifted = kIdentity, turned = kIdentity;
    shifted.translation().y() = bad;
    turned.linear()(1, 2) = bad;
    for (const auto& guess : {shifted, turned}) {
      const IcpResult result = run(scene_, scene_, GetParam(), guess);
      EXPECT_TRUE(result.status == Status::kTooFewPairs ||
                  result.status == Status::kDiverged)
          << toString(result.status);
      EXPECT_TRUE(sameBits(result.T_target_source, guess));
      expectSound(result);
    }
  }
}

TEST_P(IcpBadInput, EmptyCloudsAreTooFewPairs)
{
  const Eigen::Isometry3d guess = poseFromEuler({1, 2, 3}, {0.1, 0.2, 0.3});
  for (const auto& [target, source] :
       std::vector<std::pair<Surface, Surface>>{{{}, {}}, {scene_, {}}, {{}, scene_}}) {
    if (target.points.empty() && GetParam() != Metric::kPoint)
      continue; // an IcpModel without points has no normals to show
    const IcpResult result = run(target, source, GetParam(), guess);
    EXPECT_EQ(result.status, Status::kTooFewPairs);
    EXPECT_TRUE(sameBits(result.T_target_source, guess));
    EXPECT_EQ(result.overlap, 0);
    expectSound(result);
  }
}

TEST_P(IcpBadInput, EmptyScansAmongOthersNeedNoNormals)
{
  // A scan that was emptied by a range gate, made ready like all others.
  const IcpModel model = scene_.model();
  IcpModel::Options options;
  options.normals = true;
  const IcpModel empty(Points(), options);
  IcpOptions of_icp;
  of_icp.metric = GetParam();
  IcpResult result;
  EXPECT_NO_THROW(
      result = icp({model.part(), empty.part()}, model.source(), kIdentity, of_icp));
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_NO_THROW(result = icp({model.part()}, empty.source(), kIdentity, of_icp));
  EXPECT_EQ(result.status, Status::kTooFewPairs);
}

TEST_P(IcpBadInput, DuplicatesAloneFixNothing)
{
  Surface same;
  for (int i = 0; i < 50; ++i)
    same.add({1, 2, 3}, {0, 0, 1});
  Surface other = same.moved(poseFromEuler({0.1, 0, 0.05}, {}));
  for (const Surface& source : {same, other}) {
    const IcpResult result = run(same, source, GetParam());
    EXPECT_EQ(result.status, Status::kRankDeficient) << toString(result.status);
    EXPECT_FALSE(result.covariance);
    expectSound(result);
  }
}

TEST_P(IcpBadInput, LinesFixNothing)
{
  for (const double scale : {1.0, 100.0})
    for (const Eigen::Vector3d& along :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.3, -0.1, 0.7)}) {
      SCOPED_TRACE(testing::Message() << along.transpose() << " from " << scale);
      Surface line;
      for (int i = 0; i < 50; ++i)
        line.add(Eigen::Vector3d(scale, 0, -scale) + 0.5 * i * along,
                 along.unitOrthogonal());
      const IcpResult result = run(line, line, GetParam());
      EXPECT_EQ(result.status, Status::kRankDeficient) << toString(result.status);
      EXPECT_FALSE(result.covariance);
      expectSound(result);
    }
}

TEST_P(IcpBadInput, FarPointsAreNoPairs)
{
  Surface far = scene_;
  for (auto& p : far.points)
    p *= 1e30f;
  for (const auto& [target, source] :
       std::vector<std::pair<Surface, Surface>>{{scene_, far}, {far, scene_}}) {
    const IcpResult result = run(target, source, GetParam());
    EXPECT_NE(result.status, Status::kOk);
    expectSound(result);
  }
}

TEST_P(IcpBadInput, ScansWithoutOverlapAreTooFewPairs)
{
  const Eigen::Isometry3d away = poseFromEuler({50, 0, 0}, {});
  const IcpResult result = run(scene_, scene_, GetParam(), away);
  EXPECT_EQ(result.status, Status::kTooFewPairs);
  EXPECT_TRUE(sameBits(result.T_target_source, away));
}

INSTANTIATE_TEST_SUITE_P(All, IcpBadInput, testing::ValuesIn(kAllMetrics), nameOf);

TEST(IcpFewPairs, WithNormalsFixNothing)
{
  // 3, 4 and 5 planes leave a motion open.
  Random random(7);
  for (const std::size_t count : {3u, 4u, 5u}) {
    Surface few;
    for (std::size_t i = 0; i < count; ++i)
      few.add(test::randomCube(random, 1, 2).front().cast<double>(),
              test::randomCube(random, 1, 2).front().cast<double>().normalized());
    const IcpResult result = run(few, few, Metric::kPlane);
    EXPECT_EQ(result.status, Status::kRankDeficient) << count;
  }
}

TEST(IcpBadOptions, NameWhatIsWrong)
{
  for (const double gate : {0.0, -1.0, double{kNan}})
    EXPECT_EQ(badArgumentOf([&] {
                IcpOptions options;
                options.max_distance = gate;
                options.validate();
              }).find("max_distance = "),
              0u);
  IcpOptions none, no_planes;
  none.minimiser = nullptr;
  no_planes.plane_minimiser = nullptr;
  EXPECT_EQ(badArgumentOf([&] { none.validate(); }).find("minimiser = "), 0u);
  EXPECT_EQ(badArgumentOf([&] { no_planes.validate(); }).find("plane_minimiser = "),
            0u);
}

TEST(IcpStops, HaveNames)
{
  EXPECT_STREQ(toString(IcpStop::kAtRest), "at rest");
  EXPECT_STREQ(toString(IcpStop::kIterationLimit), "iteration limit");
  EXPECT_STREQ(toString(IcpStop::kObserver), "observer");
  EXPECT_STREQ(toString(IcpStop::kTooFewPairs), "too few pairs");
  EXPECT_STREQ(toString(IcpStop::kDiverged), "diverged");
}
