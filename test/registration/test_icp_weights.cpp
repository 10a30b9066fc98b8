// SPDX-License-Identifier: BSD-3-Clause
// Trimmed and robust ICP: what each pair counts.
#include "icp_cases.h"
#include "support/constants.h"

#include <algorithm>
#include <cmath>

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::badArgumentOf;
using pcl6d::test::corner;
using pcl6d::test::kAllMetrics;
using pcl6d::test::kIdentity;
using pcl6d::test::kNan;
using pcl6d::test::rectangle;
using pcl6d::test::Surface;

namespace {

/** \return the weight of the last of some pairs with known distances */
double
weightOfLast(const std::vector<float>& residuals, const IcpOptions& asked)
{
  // Pair i: source at (0, 0, 0), but the last at (1, 0, 0): the mean of the source
  // points is then the share of the last in the sum of the weights.
  Points source(residuals.size(), {0, 0, 0}), target;
  source.back().x() = 1;
  for (std::size_t i = 0; i < residuals.size(); ++i)
    target.push_back(source[i] + Eigen::Vector3f(0, 0, residuals[i]));
  double weight = -1;
  IcpOptions options = asked;
  options.max_iterations = 1;
  options.minimiser = [&](const PairSums& sums) {
    weight = sums.weight * sums.mean_source.x();
    return RigidEstimate{Status::kOk, kIdentity};
  };
  IcpHooks hooks;
  hooks.find = [&](const Eigen::Isometry3d&, double) {
    std::vector<IcpPair> pairs;
    for (int i = 0; i < static_cast<int>(residuals.size()); ++i)
      pairs.push_back({i, i, residuals[i] * residuals[i]});
    return pairs;
  };
  IcpTargetPart part;
  part.points = &target;
  icp({part}, {&source}, kIdentity, options, hooks);
  return weight;
}

IcpOptions
robust(RobustKernel kernel)
{
  IcpOptions options;
  options.robust = kernel;
  return options;
}

constexpr RobustKernel kKernels[] = {RobustKernel::kHuber,
                                     RobustKernel::kCauchy,
                                     RobustKernel::kGemanMcClure};

/** Two scans of a corner, a fifth of the source being points before the walls. */
struct Cluttered {
  Surface target, source;
  Eigen::Isometry3d truth = poseFromEuler({0.03, -0.02, 0.03}, {0.01, -0.01, 0.01});

  explicit Cluttered(Random& random)
  {
    target = corner(random, 6000, 4, 0.005);
    source = corner(random, 2400, 4, 0.005);
    for (int axis = 0; axis < 3; ++axis)
      source.add(rectangle(random,
                           200,
                           axis,
                           Eigen::Vector3d::Constant(0.2),
                           Eigen::Vector3d::Constant(4)));
    source = source.moved(truth.inverse());
  }
  double
  errorOf(const IcpOptions& options) const
  {
    const IcpModel model = target.model(), data = source.model();
    const IcpResult result = icp({model.part()}, data.source(), kIdentity, options);
    return distanceBetween(truth, result.T_target_source).translation;
  }
};
} // namespace

TEST(IcpWeights, AreOneWithoutAKernel)
{
  EXPECT_EQ(weightOfLast({0.1f, 0.1f, 0.1f, 5}, {}), 1);
}

TEST(IcpWeights, AreThoseOfTheKernelsAtKnownResiduals)
{
  // Four residuals of 0.1 make the scale 0.14826, whatever the fifth is.
  const double scale = 1.4826 * 0.1f;
  for (const float last : {0.0f, 0.05f, 0.1f, 0.19f, 0.21f, 0.5f, 2.0f, 100.0f}) {
    SCOPED_TRACE(last);
    const auto weight = [&](RobustKernel kernel) {
      return weightOfLast({0.1f, 0.1f, 0.1f, 0.1f, last}, robust(kernel));
    };
    const double u = last / scale;
    EXPECT_NEAR(weight(RobustKernel::kHuber), u <= 1.345 ? 1 : 1.345 / u, 1e-6);
    EXPECT_NEAR(weight(RobustKernel::kCauchy), 1 / (1 + std::pow(u / 2.385, 2)), 1e-6);
    EXPECT_NEAR(weight(RobustKernel::kGemanMcClure),
                1 / std::pow(1 + std::pow(u / 2, 2), 2),
                1e-6);
  }
}

TEST(IcpWeights, HoldOutliersDownWhenTheOthersAreExact)
{
  // More than half of the residuals are 0, and so is their scale: the outlier must not
  // count in full. Copies and simulated scans look like this.
  for (const RobustKernel kernel : kKernels)
    EXPECT_LT(weightOfLast({0, 0, 0, 0, 1}, robust(kernel)), 0.5) << toString(kernel);
}

TEST(IcpWeights, StayAtTheTruthOfExactPairsWithOutliers)
{
  // Copies on exact planes, and a fifth of outliers in reach.
  Random random(1);
  const Surface target = corner(random, 3000, 4);
  Surface source = target;
  source.add(rectangle(random, 600, 2, {0.3, 0.3, 0.2}, {3.7, 3.7, 0.2}));
  const IcpModel model = target.model(), data = source.model();
  for (const Metric metric : kAllMetrics)
    for (const RobustKernel kernel : kKernels) {
      SCOPED_TRACE(testing::Message() << toString(metric) << ", " << toString(kernel));
      IcpOptions options = robust(kernel);
      options.metric = metric;
      const IcpResult result = icp({model.part()}, data.source(), kIdentity, options);
      EXPECT_EQ(result.status, Status::kOk) << toString(result.status);
      EXPECT_LT(distanceBetween(kIdentity, result.T_target_source).translation, 1e-3);
    }
}

TEST(IcpWeights, KeepTheShareThatIsAskedFor)
{
  std::vector<float> residuals;
  for (int i = 1; i <= 10; ++i)
    residuals.push_back(0.01f * static_cast<float>(i));
  for (const auto& [share, kept] : std::vector<std::pair<double, std::size_t>>{
           {1, 10}, {0.95, 10}, {0.9, 9}, {0.5, 5}, {0.31, 4}, {0.3, 3}}) {
    IcpOptions options;
    options.kept_share = share;
    std::size_t count = 0;
    Points source, target;
    for (int i = 0; i < 10; ++i) {
      source.push_back({static_cast<float>(i % 7), static_cast<float>(i), 0});
      target.push_back(source.back() + Eigen::Vector3f(0, 0, residuals[i]));
    }
    const PointTree tree(target);
    options.minimiser = [&](const PairSums& sums) {
      count = sums.count;
      return RigidEstimate{Status::kOk, kIdentity};
    };
    icp(tree, target, source, kIdentity, options, options.minimiser);
    EXPECT_EQ(count, kept) << share;
  }
}

TEST(IcpWeights, TreatTiesOfTrimmingAlike)
{
  // All are equally near: those kept must not depend on their order; all or by rule.
  IcpOptions options;
  options.kept_share = 0.5;
  EXPECT_EQ(weightOfLast({0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f}, options), 1);
  EXPECT_EQ(weightOfLast({0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.2f}, options), 0);
  EXPECT_EQ(weightOfLast({0.2f, 0.1f, 0.1f, 0.1f, 0.2f, 0.1f}, options), 1);
}

TEST(IcpWeights, BeatOutliers)
{
  Random random(2);
  const Cluttered scene(random);
  for (const Metric metric : kAllMetrics) {
    SCOPED_TRACE(toString(metric));
    IcpOptions options;
    options.metric = metric;
    options.max_distance = 0.5;
    const double plain = scene.errorOf(options);
    for (const RobustKernel kernel : kKernels) {
      options.robust = kernel;
      EXPECT_LT(scene.errorOf(options), 0.8 * plain) << toString(kernel);
    }
    options.robust = RobustKernel::kNone;
    options.kept_share = 0.75;
    EXPECT_LT(scene.errorOf(options), 0.8 * plain) << "trimmed";
  }
}

TEST(IcpWeights, AreNotSpoiltByPairsWithoutNormals)
{
  // Pairs at normals of NaN or of no length do not count, hence must have no part in the
  // scale nor in the share that is kept: to drop them beforehand changes nothing.
  Random random(3);
  const Cluttered scene(random);
  const IcpModel data = scene.source.model();
  for (const float bad : {0.0f, kNan}) {
    Surface holes = scene.target;
    for (std::size_t i = 0; i < holes.points.size(); i += 3)
      holes.normals[i].setConstant(bad);
    const IcpModel model = holes.model();
    IcpHooks drop;
    drop.reject = [](const Eigen::Isometry3d&, std::vector<IcpPair> pairs) {
      const auto end = std::remove_if(pairs.begin(), pairs.end(), [](const auto& pair) {
        return pair.target % 3 == 0;
      });
      pairs.erase(end, pairs.end());
      return pairs;
    };
    const auto expectSame = [&](const IcpOptions& options) {
      const auto pose = [&](const IcpHooks& hooks) {
        return icp({model.part()}, data.source(), kIdentity, options, hooks)
            .T_target_source;
      };
      EXPECT_LT(distanceBetween(pose({}), pose(drop)).translation, 1e-9) << bad;
    };
    for (const RobustKernel kernel : kKernels) {
      SCOPED_TRACE(toString(kernel));
      IcpOptions options = robust(kernel);
      options.metric = Metric::kPlane;
      expectSame(options);
    }
    IcpOptions trimmed;
    trimmed.metric = Metric::kPlane;
    trimmed.kept_share = 0.6;
    expectSame(trimmed);
  }
}

TEST(IcpWeights, SurvivePairsThatAreNotFinite)
{
  // A caller's pairs may hold points that are not finite: they have no residual.
  for (const RobustKernel kernel : kKernels) {
    const double weight =
        weightOfLast({0.1f, kNan, 0.1f, kNan, 0.1f, kNan, kNan, 1}, robust(kernel));
    EXPECT_LT(weight, 0.7) << toString(kernel);
    EXPECT_GE(weight, 0);
  }
}

TEST(IcpWeights, NeedAShareAboveNoneAndUpToAll)
{
  for (const double share : {0.0, -0.1, 1.0001, double{kNan}})
    EXPECT_EQ(badArgumentOf([&] {
                IcpOptions options;
                options.kept_share = share;
                options.validate();
              }).find("kept_share = "),
              0u);
}

TEST(RobustKernels, HaveNames)
{
  for (const auto& name : robustKernelNames())
    EXPECT_EQ(toString(robustKernelFromName(name)), name);
  for (const auto& name : metricNames())
    EXPECT_EQ(toString(metricFromName(name)), name);
  EXPECT_EQ(badArgumentOf([] { robustKernelFromName("tukey"); }).find("none") ==
                std::string::npos,
            false);
  EXPECT_NE(badArgumentOf([] { metricFromName("icp"); }).find("gicp"),
            std::string::npos);
}
