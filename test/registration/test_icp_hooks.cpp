// SPDX-License-Identifier: BSD-3-Clause
// Callers who take part in ICP, and callers who err.
#include "icp_cases.h"
#include "support/constants.h"

#include <cmath>
#include <stdexcept>

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::badArgumentOf;
using pcl6d::test::corner;
using pcl6d::test::expectSameTrace;
using pcl6d::test::kAllMetrics;
using pcl6d::test::kIdentity;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::kTruth;
using pcl6d::test::sameBits;
using pcl6d::test::Surface;
using pcl6d::test::Trace;
using pcl6d::test::traceOf;
using Pairs = std::vector<IcpPair>;

namespace {

class IcpHooksTest : public testing::Test {
protected:
  IcpHooksTest()
  {
    hooks_.observer = [this](const IcpIteration& i) {
      trace_.seen.push_back(i);
      return true;
    };
  }

  Pairs
  nearest(const Eigen::Isometry3d& T, double limit) const
  {
    return test::pairsByForce(
        scene_.points, data_.points(), T, static_cast<float>(limit));
  }

  Trace
  run()
  {
    trace_ = {};
    trace_.result = icp({model_.part()}, data_.source(), kIdentity, options_, hooks_);
    return trace_;
  }

  Random random_{1};
  Surface scene_ = corner(random_, 900, 2, 0.002);
  IcpModel model_ = scene_.model();
  IcpModel data_ = scene_.moved(kTruth.inverse()).model();
  IcpOptions options_;
  IcpHooks hooks_;
  Trace trace_;
};

Pairs
one(int source, int target)
{
  return {{source, target, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}};
}
} // namespace

TEST_F(IcpHooksTest, FindInPlaceOfTheTreeGivesTheSameWay)
{
  for (const Metric metric : kAllMetrics) {
    SCOPED_TRACE(toString(metric));
    options_.metric = metric;
    options_.max_distance_start = 0.6;
    hooks_.find = nullptr;
    const Trace expected = run();
    hooks_.find = [&](const Eigen::Isometry3d& T, double limit) {
      return nearest(T, limit);
    };
    const Trace found = run();
    expectSameTrace(found, expected);
    EXPECT_EQ(found.seen.back().searched, 0u);
  }
}

TEST_F(IcpHooksTest, FindNeedsNoTree)
{
  hooks_.find = [&](const Eigen::Isometry3d& T, double limit) {
    return nearest(T, limit);
  };
  IcpTargetPart part = model_.part();
  part.tree = nullptr;
  part.normals = nullptr;
  part.search = nullptr;
  const IcpResult result = icp({part}, data_.source(), kIdentity, options_, hooks_);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(distanceBetween(kTruth, result.T_target_source).translation, 2e-6);
  EXPECT_FALSE(result.localizability) << "none without a tree or normals";
}

TEST_F(IcpHooksTest, RejectDropsHalfOfThePairs)
{
  hooks_.reject = [](const Eigen::Isometry3d&, Pairs pairs) {
    Pairs half;
    for (const IcpPair& pair : pairs)
      if (pair.source % 2 == 0)
        half.push_back(pair);
    return half;
  };
  for (const Metric metric : kAllMetrics) {
    options_.metric = metric;
    const Trace trace = run();
    EXPECT_EQ(trace.result.status, Status::kOk);
    EXPECT_EQ(trace.result.pairs, 450u) << toString(metric);
    EXPECT_EQ(trace.result.overlap, 0.5);
    EXPECT_LT(distanceBetween(kTruth, trace.result.T_target_source).translation, 2e-6);
  }
}

TEST_F(IcpHooksTest, RejectLeavesTheSearchAsItIs)
{
  // Whatever the caller makes of the pairs, the next ones are again the nearest.
  Pairs expected;
  hooks_.reject = [&](const Eigen::Isometry3d& T, Pairs pairs) {
    expected = nearest(T, options_.max_distance);
    EXPECT_EQ(pairs.size(), expected.size());
    int wrong = 0;
    for (std::size_t i = 0; i < std::min(pairs.size(), expected.size()); ++i)
      wrong += pairs[i].target != expected[i].target;
    EXPECT_EQ(wrong, 0);
    for (IcpPair& pair : pairs) // one in ten gets the partner of another
      if (pair.source % 10 == 0)
        pair.target = (pair.target + 3) % 900;
    return pairs;
  };
  hooks_.minimise = [](const Eigen::Isometry3d& T, const Pairs&) {
    RigidEstimate small{Status::kOk, kIdentity};
    small.transform.translation().x() = T.translation().x() > 0 ? -2e-4 : 2e-4;
    return small;
  };
  options_.max_iterations = 10;
  run();
}

TEST_F(IcpHooksTest, MinimiseTakesTheStep)
{
  std::size_t most = 0;
  hooks_.minimise = [&](const Eigen::Isometry3d& T, const Pairs& pairs) {
    most = std::max(most, pairs.size());
    RigidEstimate half{Status::kOk, kTruth * T.inverse()};
    half.transform.linear() =
        Eigen::Quaterniond(half.transform.linear()).toRotationMatrix();
    return half;
  };
  const Trace trace = run();
  EXPECT_EQ(trace.result.status, Status::kOk);
  EXPECT_EQ(trace.result.iterations, 2);
  EXPECT_EQ(most, 900u);
  EXPECT_LT(distanceBetween(kTruth, trace.result.T_target_source).translation, 1e-12);
}

TEST_F(IcpHooksTest, MinimiseMaySayWhatItCannot)
{
  for (const auto& [said, expected] : std::vector<std::pair<Status, Status>>{
           {Status::kTooFewPairs, Status::kTooFewPairs},
           {Status::kDiverged, Status::kDiverged},
           {Status::kRankDeficient, Status::kRankDeficient}}) {
    hooks_.minimise = [said = said](const Eigen::Isometry3d&, const Pairs&) {
      return RigidEstimate{said, kIdentity};
    };
    const IcpResult result = run().result;
    EXPECT_EQ(result.status, expected);
    EXPECT_TRUE(sameBits(result.T_target_source, kIdentity));
  }
  hooks_.minimise = [](const Eigen::Isometry3d&, const Pairs&) {
    RigidEstimate bad{Status::kOk, kIdentity};
    bad.transform.translation().y() = kInfinity;
    return bad;
  };
  EXPECT_EQ(run().result.status, Status::kDiverged);
}

TEST_F(IcpHooksTest, MinimiseMustNotMirrorOrScale)
{
  for (const double factor : {-1.0, 2.0, 0.0}) {
    hooks_.minimise = [&](const Eigen::Isometry3d&, const Pairs&) {
      RigidEstimate bad{Status::kOk, kIdentity};
      bad.transform.linear() *= factor;
      return bad;
    };
    options_.max_iterations = 3;
    const IcpResult result = run().result;
    EXPECT_TRUE(isRigid(result.T_target_source)) << factor;
  }
}

TEST_F(IcpHooksTest, ObserverStops)
{
  hooks_.observer = [](const IcpIteration& i) { return i.number < 2; };
  const IcpResult result = run().result;
  EXPECT_EQ(result.stop, IcpStop::kObserver);
  EXPECT_EQ(result.status, Status::kMaxIterations);
  EXPECT_EQ(result.iterations, 2);
}

TEST_F(IcpHooksTest, PairsOutOfRangeAreRefused)
{
  for (const auto& bad : {one(-1, 0),
                          one(900, 0),
                          one(0, -1),
                          one(0, 900),
                          one(1 << 30, 0),
                          one(0, 1 << 30)}) {
    hooks_ = {};
    hooks_.find = [&](const Eigen::Isometry3d&, double) { return bad; };
    EXPECT_NE(badArgumentOf([&] { run(); }).find("of a pair ="), std::string::npos);
    hooks_ = {};
    hooks_.reject = [&](const Eigen::Isometry3d&, Pairs) { return bad; };
    EXPECT_NE(badArgumentOf([&] { run(); }).find("of a pair ="), std::string::npos);
  }
}

TEST_F(IcpHooksTest, OfSeveralPairsOfAPointTheClosestCounts)
{
  for (const bool reversed : {false, true}) {
    hooks_.find = [&](const Eigen::Isometry3d& T, double limit) {
      Pairs pairs;
      for (const IcpPair& pair : nearest(T, limit))
        for (int k = 0; k < 3; ++k) {
          const int other = (pair.target + 100 * k) % 900;
          const Eigen::Vector3f p =
              (T * data_.points()[pair.source].cast<double>()).cast<float>();
          pairs.push_back({pair.source, other, distanceSq(p, scene_.points[other])});
        }
      if (reversed)
        std::reverse(pairs.begin(), pairs.end());
      return pairs;
    };
    const IcpResult result = run().result;
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_EQ(result.pairs, 900u);
    EXPECT_LT(distanceBetween(kTruth, result.T_target_source).translation, 2e-6);
  }
}

TEST_F(IcpHooksTest, NonePairsAreTooFew)
{
  for (const int count : {0, 1, 2}) {
    hooks_.find = [&](const Eigen::Isometry3d&, double) {
      Pairs pairs = one(0, 0);
      pairs.resize(count);
      return pairs;
    };
    const IcpResult result = run().result;
    EXPECT_EQ(result.status, Status::kTooFewPairs);
    EXPECT_EQ(result.stop, IcpStop::kTooFewPairs);
    EXPECT_TRUE(sameBits(result.T_target_source, kIdentity));
    EXPECT_EQ(result.pairs, static_cast<std::size_t>(count));
  }
}

TEST_F(IcpHooksTest, ThatSeePairsNeedATargetOfOnePart)
{
  const IcpTarget two{model_.part(), model_.part()};
  IcpHooks find, reject, minimise, observer;
  find.find = [](const Eigen::Isometry3d&, double) { return Pairs(); };
  reject.reject = [](const Eigen::Isometry3d&, Pairs pairs) { return pairs; };
  minimise.minimise = [](const Eigen::Isometry3d&, const Pairs&) {
    return RigidEstimate();
  };
  observer.observer = [](const IcpIteration&) { return true; };
  for (const IcpTarget& target : {two, IcpTarget()}) {
    for (const IcpHooks& hooks : {find, reject, minimise})
      EXPECT_THROW(icp(target, data_.source(), kIdentity, {}, hooks), BadArgument);
    EXPECT_NO_THROW(icp(target, data_.source(), kIdentity, {}, observer));
  }
}

TEST_F(IcpHooksTest, ExceptionsPassThrough)
{
  hooks_.find = [](const Eigen::Isometry3d&, double) -> Pairs {
    throw std::runtime_error("mine");
  };
  EXPECT_THROW(run(), std::runtime_error);
  IcpTargetPart part = model_.part();
  part.search = [](const Eigen::Vector3f&, float) -> Neighbour {
    throw std::runtime_error("mine");
  };
  EXPECT_THROW(icp({part}, data_.source(), kIdentity, {}), std::runtime_error);
}

TEST_F(IcpHooksTest, ASearchWithAnIndexOutOfRangeIsRefused)
{
  IcpTargetPart part = model_.part();
  part.search = [](const Eigen::Vector3f&, float) { return Neighbour{900, 0.01f}; };
  EXPECT_THROW(icp({part}, data_.source(), kIdentity, {}), BadArgument);
}
