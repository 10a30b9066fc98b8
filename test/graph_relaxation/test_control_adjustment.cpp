// SPDX-License-Identifier: BSD-3-Clause
#include "control/control_problem.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/graph_relaxation/control_adjustment.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;

constexpr double kLinkTurn = 0.0002; ///< [rad] standard deviation of a link's rotation
constexpr double kLinkShift = 0.001; ///< [m] of its translation

Eigen::Vector3d
randomVector(Random& random, double sigma)
{
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

Eigen::Isometry3d
smallMotion(const Eigen::Vector3d& shift, const Eigen::Vector3d& turn)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0)
    T.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  T.translation() = shift;
  return T;
}

/** Six scans in a row, 8 m apart, and a map of them in its own frame. */
struct Survey {
  std::vector<Eigen::Isometry3d> truth; ///< T_control_scan
  PoseGraph map;
  ControlOptions options;

  /** \param[in] noise factor of the errors of links, targets and points
   * \param[in] offset [m] of the frame of the control points */
  explicit Survey(double noise = 0,
                  std::uint64_t seed = 1,
                  const Eigen::Vector3d& offset = Eigen::Vector3d::Zero())
  {
    Random random(seed);
    for (int i = 0; i < 6; ++i)
      truth.push_back(
          Eigen::Translation3d(offset + Eigen::Vector3d(8 * i, i % 2, 1.6)) *
          smallMotion(Eigen::Vector3d::Zero(), {0.01, -0.02, 0.9 * i}));
    addLinks(noise, random);
    const Eigen::Vector3d points[] = {
        {0, 5, 0.5}, {40, 6, 2.5}, {38, -7, 1}, {2, -6, 3}, {20, 7, 4}};
    for (std::size_t p = 0; p < std::size(points); ++p) {
      const std::string name = "P" + std::to_string(p + 1);
      options.points.push_back(
          {name, offset + points[p] + randomVector(random, noise * 0.002), {}});
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const Eigen::Vector3d seen = truth[i].inverse() * (offset + points[p]);
        if (seen.norm() < 12)
          options.targets.push_back(
              {name, i, seen + randomVector(random, noise * 0.002)});
      }
    }
    options.num_threads = 1;
  }

  void
  addLinks(double noise, Random& random)
  {
    Vector6 weights;
    weights << Eigen::Vector3d::Constant(1 / (kLinkShift * kLinkShift)),
        Eigen::Vector3d::Constant(1 / (kLinkTurn * kLinkTurn));
    map.poses = {smallMotion({3, -4, 0.2}, {0.3, 0.1, 2})};
    for (std::size_t i = 1; i < truth.size(); ++i) {
      PoseLink link;
      link.from = i - 1;
      link.to = i;
      const Eigen::Vector3d shift = randomVector(random, noise * kLinkShift);
      link.T_from_to = truth[i - 1].inverse() * truth[i] *
                       smallMotion(shift, randomVector(random, noise * kLinkTurn));
      link.information = weights.asDiagonal();
      map.links.push_back(link);
      map.poses.push_back(map.poses.back() * link.T_from_to);
    }
  }
};

/** Errors of a result [m]. */
double
largestError(const ControlAdjustment& done, const std::vector<Eigen::Isometry3d>& truth)
{
  double most = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    most = std::max(most, (truth[i].inverse() * done.poses[i]).translation().norm());
  return most;
}

std::string
refusal(const Survey& survey)
{
  try {
    adjustToControl(survey.map, survey.options);
  } catch (const BadArgument& e) {
    return e.what();
  }
  return "";
}

TEST(ControlAdjustment, JacobianIsThatOfFiniteDifferences)
{
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Isometry3d T =
        smallMotion(randomVector(random, 20), randomVector(random, 1));
    const Eigen::Vector3d target = randomVector(random, 10);
    const auto J = graph_relaxation::targetJacobian(T, target);
    constexpr double kStep = 1e-5; // the error of central differences is its square
    for (int i = 0; i < 6; ++i) {
      Vector6 step = Vector6::Zero();
      step(i) = kStep;
      const Eigen::Vector3d ahead =
          T * smallMotion(step.head<3>(), step.tail<3>()) * target;
      const Eigen::Vector3d behind =
          T * smallMotion(-step.head<3>(), -step.tail<3>()) * target;
      EXPECT_LT((J.col(i) - (ahead - behind) / (2 * kStep)).norm(), 1e-7);
    }
  }
}

TEST(ControlAdjustment, ExactPointsGiveExactPoses)
{
  const Survey survey;
  const auto done = adjustToControl(survey.map, survey.options);
  ASSERT_TRUE(done.result.adjusted) << done.result.reason;
  EXPECT_LT(largestError(done, survey.truth), 1e-9);
  EXPECT_LT(*done.result.rms(ControlUse::kControl), 1e-9);
  EXPECT_TRUE(done.result.rejected().empty());
  EXPECT_LT(done.result.largest_change, 1e-9);
}

TEST(ControlAdjustment, FarCoordinatesLoseNothing)
{
  const Eigen::Vector3d offset(3512345, 5412345, 431); // Gauss-Krueger, say
  const Survey survey(0, 1, offset);
  const auto done = adjustToControl(survey.map, survey.options);
  ASSERT_TRUE(done.result.adjusted);
  // Doubles at 5e6 m have steps of 1e-9 m; products of poses and points lose a few.
  EXPECT_LT(largestError(done, survey.truth), 1e-7);
}

TEST(ControlAdjustment, NamesTheControlPointThatIsWrong)
{
  for (std::size_t wrong = 0; wrong < 5; ++wrong) {
    Survey survey(1, 7 + wrong);
    survey.options.points[wrong].position += Eigen::Vector3d(0.03, -0.04, 0);
    const auto done = adjustToControl(survey.map, survey.options);
    ASSERT_TRUE(done.result.adjusted) << done.result.reason;
    EXPECT_EQ(done.result.rejected(),
              std::vector<std::string>{survey.options.points[wrong].name});
    for (const ControlResidual& one : done.result.residuals)
      EXPECT_EQ(one.use == ControlUse::kRejected,
                one.name == survey.options.points[wrong].name);
    EXPECT_LT(largestError(done, survey.truth), 0.012); // links and points of 1 to 2 mm
  }
}

TEST(ControlAdjustment, NamesTheTargetThatIsWrongInOneScan)
{
  Survey survey(1, 11);
  std::size_t wrong = 0;
  while (survey.options.targets[wrong].name != "P5" ||
         survey.options.targets[wrong].scan != 3)
    ++wrong;
  survey.options.targets[wrong].position.x() += 0.05;
  const auto done = adjustToControl(survey.map, survey.options);
  ASSERT_TRUE(done.result.adjusted);
  for (const ControlResidual& one : done.result.residuals)
    EXPECT_EQ(one.use == ControlUse::kRejected, one.name == "P5" && one.scan == 3)
        << one.name << " in scan " << one.scan;
}

TEST(ControlAdjustment, SwappedNamesAreBothRejected)
{
  Survey survey(1, 5);
  std::swap(survey.options.points[0].position, survey.options.points[4].position);
  const auto done = adjustToControl(survey.map, survey.options);
  ASSERT_TRUE(done.result.adjusted) << done.result.reason;
  EXPECT_EQ(done.result.rejected(), (std::vector<std::string>{"P1", "P5"}));
}

TEST(ControlAdjustment, CheckPointsDoNotCount)
{
  Survey survey(1, 21);
  survey.options.checks = {"P5"};
  const auto with = adjustToControl(survey.map, survey.options);
  survey.options.points[4].position.z() += 1;
  const auto moved = adjustToControl(survey.map, survey.options);
  for (std::size_t i = 0; i < with.poses.size(); ++i)
    EXPECT_EQ(with.poses[i].matrix(), moved.poses[i].matrix());
  EXPECT_LT(*with.result.largest(ControlUse::kCheck), 0.012);
  EXPECT_NEAR(*moved.result.largest(ControlUse::kCheck), 1, 0.012);
  for (const ControlResidual& one : moved.result.residuals) {
    EXPECT_EQ(one.use == ControlUse::kCheck, one.name == "P5");
    if (one.use == ControlUse::kCheck) {
      EXPECT_GT(one.standardised, 100);
    }
  }
}

TEST(ControlAdjustment, CovariancesAreThoseOfTheErrors)
{
  double sum = 0, factors = 0;
  int count = 0, rejected = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Survey survey(1, 100 + static_cast<std::uint64_t>(trial));
    const auto done = adjustToControl(survey.map, survey.options);
    ASSERT_TRUE(done.result.adjusted);
    rejected += done.result.rejected().empty() ? 0 : 1;
    factors += done.result.variance_factor / kTrials;
    const double factor = std::max(1.0, done.result.variance_factor);
    for (std::size_t i = 0; i < survey.truth.size(); ++i) {
      const Eigen::Isometry3d off = survey.truth[i].inverse() * done.poses[i];
      Vector6 error;
      error << off.translation(), 2 * Eigen::Quaterniond(off.linear()).vec();
      sum += factor * error.dot(done.covariances[i]->inverse() * error);
      ++count;
    }
  }
  // Chi2 of 6 degrees of freedom: mean 6, deviation 3.5; scans of a trial are alike, so 200
  // samples count: 0.25, times 4.
  EXPECT_NEAR(sum / count, 6, 1);
  EXPECT_NEAR(factors, 1, 0.15);
  EXPECT_LE(rejected, 10); // a dozen tests of 0.1 % each: 2.4 expected
}

TEST(ControlAdjustment, TellsWhereTheBlunderIsNotCertain)
{
  // Four points in one plane: an error across it is noticed, but may be of any of them.
  Survey survey;
  survey.options.targets.clear();
  const Eigen::Vector3d points[] = {{0, 5, 1}, {40, 6, 1}, {38, -7, 1}, {2, -6, 1}};
  survey.options.points.resize(4);
  for (std::size_t p = 0; p < 4; ++p) {
    survey.options.points[p].position = points[p];
    const std::size_t scan = p == 0 || p == 3 ? 0 : 5;
    survey.options.targets.push_back({survey.options.points[p].name,
                                      scan,
                                      survey.truth[scan].inverse() * points[p]});
  }
  survey.options.points[2].position.z() += 0.2;
  const auto done = adjustToControl(survey.map, survey.options);
  ASSERT_TRUE(done.result.adjusted);
  EXPECT_EQ(done.result.rejected().size(), 1U);
  for (const char* name : {"P1", "P2", "P3", "P4"})
    EXPECT_NE(done.result.doubt.find(name), std::string::npos) << done.result.doubt;
}

TEST(ControlAdjustment, PointsOfAnotherSiteFitNothing)
{
  Survey survey;
  Random random(2);
  for (ControlPoint& point : survey.options.points)
    point.position = randomVector(random, 30);
  const auto done = adjustToControl(survey.map, survey.options);
  EXPECT_FALSE(done.result.adjusted);
  EXPECT_NE(done.result.reason.find("no three control points fit"), std::string::npos);
  for (std::size_t i = 0; i < done.poses.size(); ++i)
    EXPECT_EQ(done.poses[i].matrix(), survey.map.poses[i].matrix());
}

TEST(ControlAdjustment, ScansThatNothingConnectsMoveWithTheOneBefore)
{
  Survey survey;
  survey.map.links.pop_back();
  survey.map.poses[5] = survey.map.poses[4] * smallMotion({0, 0, 5}, {0, 0, 1});
  const auto done = adjustToControl(survey.map, survey.options);
  ASSERT_TRUE(done.result.adjusted) << done.result.reason;
  EXPECT_FALSE(done.result.bounds[5]);
  EXPECT_LT(((done.poses[4] * smallMotion({0, 0, 5}, {0, 0, 1})).matrix() -
             done.poses[5].matrix())
                .norm(),
            1e-9);
  for (const ControlResidual& one : done.result.residuals)
    EXPECT_EQ(one.use == ControlUse::kUnused, one.scan == 5);
}

TEST(ControlAdjustment, ThreadsDoNotChangeTheResult)
{
  Survey survey(1, 4);
  const auto one = adjustToControl(survey.map, survey.options);
  survey.options.num_threads = 4;
  const auto four = adjustToControl(survey.map, survey.options);
  for (std::size_t i = 0; i < one.poses.size(); ++i)
    EXPECT_EQ(one.poses[i].matrix(), four.poses[i].matrix());
}

TEST(ControlAdjustment, RefusesWhatBreaksARule)
{
  Survey survey;
  survey.options.points.resize(2);
  EXPECT_NE(refusal(survey).find("only 2 of 2 have a target"), std::string::npos);
  survey = Survey();
  for (std::size_t p = 0; p < 5; ++p)
    survey.options.points[p].position = Eigen::Vector3d(10, 2, 1) * p;
  EXPECT_NE(refusal(survey).find("on one line"), std::string::npos);
  survey = Survey();
  survey.options.checks = {"P9"};
  EXPECT_NE(refusal(survey).find("P9 is no control point"), std::string::npos);
  survey = Survey();
  survey.options.points[1].name = "P1";
  EXPECT_NE(refusal(survey).find("P1 occurs twice"), std::string::npos);
  survey = Survey();
  survey.options.targets.push_back(survey.options.targets[0]);
  EXPECT_NE(refusal(survey).find("twice in scan 0"), std::string::npos);
  survey = Survey();
  survey.options.targets[0].scan = 6;
  EXPECT_NE(refusal(survey).find("there are 6 scans"), std::string::npos);
  survey = Survey();
  survey.options.target_sigma = 0;
  EXPECT_NE(refusal(survey).find("target_sigma = 0"), std::string::npos);
  survey = Survey();
  survey.options.points[0].position.x() = NAN;
  EXPECT_NE(refusal(survey).find("P1 is not finite"), std::string::npos);
}

TEST(ControlAdjustment, NamesPointsAndTargetsWithoutPartner)
{
  Survey survey;
  survey.options.points.push_back({"far", Eigen::Vector3d(99, 0, 0), {}});
  survey.options.targets.push_back({"unknown", 0, Eigen::Vector3d(1, 0, 0)});
  const auto done = adjustToControl(survey.map, survey.options);
  EXPECT_EQ(done.result.without_target, std::vector<std::string>{"far"});
  EXPECT_EQ(done.result.without_control, std::vector<std::string>{"unknown"});
}
} // namespace
