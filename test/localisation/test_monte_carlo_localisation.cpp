// SPDX-License-Identifier: BSD-3-Clause
#include "localisation/plan.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/localisation/monte_carlo_localisation.h>

#include <gtest/gtest.h>

#include <functional>
#include <optional>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
using Estimates = std::vector<MclEstimate>;

/** Localises a drive. \param[in] walls that the scanner sees at a scan */
Estimates
localise(const SegmentMap& map,
         const Drive& drive,
         const std::optional<Eigen::Vector3d>& start,
         const MclOptions& options,
         const std::function<Segments(std::size_t)>& walls)
{
  MonteCarloLocalisation filter(map, start, options);
  Random noise(11);
  Estimates estimates;
  for (std::size_t i = 0; i < drive.poses.size(); ++i)
    estimates.push_back(
        filter.addScan(drive.motions[i], scanOf(walls(i), drive.poses[i], noise)));
  return estimates;
}

Estimates
localise(const Drive& drive, const MclOptions& options = MclOptions())
{
  const SegmentMap map(street());
  return localise(
      map, drive, drive.poses.front(), options, [](std::size_t) { return street(); });
}

struct Errors {
  double rms = 0, max = 0, yaw_rms = 0; ///< [m], [m], [rad]
};

Errors
errorsOf(const Estimates& estimates, const Drive& drive, std::size_t begin = 0)
{
  Errors errors;
  double sum_sq = 0, yaw_sum_sq = 0;
  for (std::size_t i = begin; i < estimates.size(); ++i) {
    const Eigen::Vector3d d = estimates[i].pose - drive.poses[i];
    sum_sq += d.head<2>().squaredNorm();
    yaw_sum_sq += wrapAngle(d.z()) * wrapAngle(d.z());
    errors.max = std::max(errors.max, d.head<2>().norm());
  }
  const auto count = static_cast<double>(estimates.size() - begin);
  errors.rms = std::sqrt(sum_sq / count);
  errors.yaw_rms = std::sqrt(yaw_sum_sq / count);
  return errors;
}
/** A trusted position is wrong by no more than the spread that it may have. */
void
expectNearIfTrusted(const MclEstimate& estimate, const Eigen::Vector3d& truth)
{
  if (estimate.trusted()) {
    EXPECT_LT((estimate.pose - truth).head<2>().norm(), MclOptions().max_spread);
  }
}
} // namespace

TEST(MonteCarloLocalisation, FollowsADriveOf100Metres)
{
  const Drive drive = driveAlongTheStreet();
  EXPECT_GT(drive.odometry_error, 10) << "[m] else the odometry alone would do";
  const Estimates estimates = localise(drive);
  // A prototype in Python: 4 cm rms, 11 cm at most, 0.14 deg; the same within a third.
  const Errors errors = errorsOf(estimates, drive, 5);
  EXPECT_LT(errors.rms, 0.053);
  EXPECT_LT(errors.max, 0.15);
  EXPECT_LT(errors.yaw_rms, 0.2 * M_PI / 180);
  for (const auto& estimate : estimates)
    EXPECT_TRUE(estimate.trusted()) << toString(estimate.doubt);
  RecordProperty("rms_mm", static_cast<int>(1000 * errors.rms));
  RecordProperty("max_mm", static_cast<int>(1000 * errors.max));
  RecordProperty("yaw_mdeg", static_cast<int>(1000 * errors.yaw_rms * 180 / M_PI));
}

TEST(MonteCarloLocalisation, TheErrorsAreWithinTheCovariances)
{
  const Drive drive = driveAlongTheStreet();
  const Estimates estimates = localise(drive);
  double sum =
      0; // of squared Mahalanobis distances, 3 each if the covariances are right
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    Eigen::Vector3d d = estimates[i].pose - drive.poses[i];
    d.z() = wrapAngle(d.z());
    sum += d.dot(estimates[i].covariance.inverse() * d);
  }
  const double mean = sum / static_cast<double>(estimates.size());
  EXPECT_LT(mean, 6) << "the covariances are too small";
  EXPECT_GT(mean, 0.1) << "the covariances are too large";
}

TEST(MonteCarloLocalisation, HasTheSameBitsForAnyNumberOfThreads)
{
  Drive drive = driveAlongTheStreet();
  drive.poses.resize(15);
  drive.motions.resize(15);
  MclOptions options;
  options.num_particles = 1000; // several blocks
  options.num_threads = 1;
  const Estimates one = localise(drive, options);
  options.num_threads = 5;
  const Estimates five = localise(drive, options);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_TRUE(sameBits(one[i].pose, five[i].pose)) << i;
    EXPECT_TRUE(sameBits(one[i].covariance, five[i].covariance)) << i;
  }
  options.seed = 2;
  EXPECT_FALSE(sameBits(one.back().pose, localise(drive, options).back().pose));
}

TEST(MonteCarloLocalisation, MarksAStretchWithoutWallsAndRecovers)
{
  const Drive drive = driveAlongTheStreet();
  const SegmentMap map(street());
  const auto isBlind = [](std::size_t i) { return i >= 40 && i < 60; };
  const Estimates estimates =
      localise(map, drive, drive.poses.front(), {}, [&](std::size_t i) {
        return isBlind(i) ? Segments() : street();
      });
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (isBlind(i)) {
      EXPECT_EQ(estimates[i].doubt, MclDoubt::kFewWalls) << i;
    }
    else if (i < 40 || i >= 65) {
      EXPECT_TRUE(estimates[i].trusted()) << i << ": " << toString(estimates[i].doubt);
    }
    expectNearIfTrusted(estimates[i], drive.poses[i]);
  }
  EXPECT_GT(estimates[59].covariance.trace(), 10 * estimates[39].covariance.trace());
}

TEST(MonteCarloLocalisation, MarksAStretchThatTheMapDoesNotKnow)
{
  const Drive drive = driveAlongTheStreet();
  const SegmentMap map(street());
  Segments others; // what stands there now
  addBuilding(others, 30, 15, 40, 10, 0.5);
  addBuilding(others, 30, -14, 40, 4, -0.4);
  const auto isOther = [](std::size_t i) { return i >= 40 && i < 55; };
  const Estimates estimates =
      localise(map, drive, drive.poses.front(), {}, [&](std::size_t i) {
        return isOther(i) ? others : street();
      });
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (isOther(i)) {
      EXPECT_EQ(estimates[i].doubt, MclDoubt::kDisagreement) << i;
    }
    else if (i < 40 || i >= 60) {
      EXPECT_TRUE(estimates[i].trusted()) << i << ": " << toString(estimates[i].doubt);
    }
    expectNearIfTrusted(estimates[i], drive.poses[i]);
  }
}

TEST(MonteCarloLocalisation, MarksAWallThatLeavesAMotionOpen)
{
  const SegmentMap map({{{-200, 3}, {200, 3}}}); // one long wall: x stays open
  MclOptions options;
  options.translation_per_metre = 0.2;
  MonteCarloLocalisation filter(map, Eigen::Vector3d(0, 0, 0), options);
  Random noise(5);
  MclEstimate estimate;
  for (int i = 0; i < 30; ++i)
    estimate = filter.addScan(Eigen::Vector3d(i > 0 ? 1 : 0, 0, 0),
                              scanOf(map.segments(), Eigen::Vector3d(i, 0, 0), noise));
  EXPECT_EQ(estimate.doubt, MclDoubt::kSpread);
  EXPECT_GT(estimate.covariance(0, 0), 20 * estimate.covariance(1, 1));
}

TEST(MonteCarloLocalisation, FindsItsPlaceAnywhere)
{
  Segments room; // without symmetry
  addBuilding(room, 0, 0, 12, 8, 0);
  addBuilding(room, 9, 0, 3, 2.5, 0);
  room.push_back({{0, 5}, {3.5, 5}});
  const SegmentMap map(room);
  Drive drive;
  for (int i = 0; i < 12; ++i) {
    drive.poses.emplace_back(2 + 0.4 * i, 2 + 0.2 * i, 0.46);
    drive.motions.push_back(
        i > 0 ? motionBetween(drive.poses[drive.poses.size() - 2], drive.poses.back())
              : Eigen::Vector3d(0, 0, 0));
  }
  const Estimates estimates =
      localise(map, drive, std::nullopt, {}, [&](std::size_t) { return room; });
  EXPECT_FALSE(estimates.front().trusted()) << "a place cannot be known at once";
  EXPECT_TRUE(estimates.back().trusted()) << toString(estimates.back().doubt);
  EXPECT_LT((estimates.back().pose - drive.poses.back()).head<2>().norm(), 0.15);
  EXPECT_LT(std::abs(wrapAngle(estimates.back().pose.z() - 0.46)), 0.02);
  EXPECT_GT(estimates.front().particles, estimates.back().particles);
}

TEST(MonteCarloLocalisation, DrivesBackwardsAsWell)
{
  Drive drive = driveAlongTheStreet();
  drive.poses.resize(30);
  std::reverse(drive.poses.begin(), drive.poses.end());
  for (std::size_t i = 0; i < drive.poses.size(); ++i)
    drive.motions[i] = i > 0 ? motionBetween(drive.poses[i - 1], drive.poses[i])
                             : Eigen::Vector3d(0, 0, 0);
  drive.motions.resize(30);
  EXPECT_LT(errorsOf(localise(drive), drive).max, 0.25);
}

TEST(MonteCarloLocalisation, RefusesWhatBreaksItsRules)
{
  const SegmentMap map(street());
  const double nan = std::nan("");
  using Map = MonteCarloLocalisation;
  EXPECT_THROW(Map(map, Eigen::Vector3d(0, nan, 0)), BadArgument);
  EXPECT_THROW(Map(map, std::nullopt).addScan({0, 0, nan}, {}), BadArgument);
  const std::vector<std::pair<const char*, void (*)(MclOptions&)>> spoiled{
      {"num_particles", [](auto& o) { o.num_particles = 0; }},
      {"max_particles", [](auto& o) { o.max_particles = 199; }},
      {"rotation_per_rotation", [](auto& o) { o.rotation_per_rotation = -1; }},
      {"rotation_per_metre", [](auto& o) { o.rotation_per_metre = std::nan(""); }},
      {"translation_per_metre", [](auto& o) { o.translation_per_metre = -1; }},
      {"translation_per_rotation", [](auto& o) { o.translation_per_rotation = -1; }},
      {"start_position", [](auto& o) { o.start_position = -1; }},
      {"start_yaw", [](auto& o) { o.start_yaw = -1; }},
      {"hit_sigma", [](auto& o) { o.hit_sigma = 0; }},
      {"hit_share", [](auto& o) { o.hit_share = 1; }},
      {"beam_independence", [](auto& o) { o.beam_independence = 0; }},
      {"agreement_distance", [](auto& o) { o.agreement_distance = 0; }},
      {"min_agreement", [](auto& o) { o.min_agreement = 1.1; }},
      {"max_spread", [](auto& o) { o.max_spread = 0; }},
      {"max_yaw_spread", [](auto& o) { o.max_yaw_spread = 0; }}};
  for (const auto& [name, spoil] : spoiled) {
    MclOptions options;
    spoil(options);
    EXPECT_EQ(badArgumentOf([&] { options.validate(); }).rfind(name, 0), 0u) << name;
  }
}

TEST(DistrustShortStretches, LeavesOnlyLongOnes)
{
  const auto stretches = [](const std::string& text) {
    Estimates estimates(text.size());
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == 'x')
        estimates[i].doubt = MclDoubt::kFewWalls;
    distrustShortStretches(estimates, 3);
    std::string marked;
    for (const auto& estimate : estimates)
      marked += estimate.trusted()                          ? '.'
                : estimate.doubt == MclDoubt::kShortStretch ? 's'
                                                            : 'x';
    return marked;
  };
  EXPECT_EQ(stretches("..x...x.x"), "ssx...xsx");
  EXPECT_EQ(stretches(".."), "..") << "the whole way";
  EXPECT_EQ(stretches("x..."), "x...");
  EXPECT_EQ(stretches(""), "");
}

TEST(PlanarMotion, IsThatInTheLevelledFrame)
{
  // A robot climbs 10 deg and sees itself drive straight on by 2 m.
  const Eigen::Matrix3d R = rotationFromEuler({0, -10 * M_PI / 180, 0});
  Eigen::Isometry3d ahead = Eigen::Isometry3d::Identity();
  ahead.translation() << 2, 0, 0;
  ahead.linear() = rotationFromEuler({0, 0, 0.1});
  const Eigen::Vector3d motion =
      planarMotion(ahead, R, rotationFromEuler({0, -10 * M_PI / 180, 0}));
  EXPECT_NEAR(motion.x(), 2 * std::cos(10 * M_PI / 180), 1e-12);
  EXPECT_NEAR(motion.y(), 0, 1e-12);
  EXPECT_NEAR(motion.z(), 0.1, 2e-3);
}
