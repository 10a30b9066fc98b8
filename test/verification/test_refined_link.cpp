// SPDX-License-Identifier: BSD-3-Clause
// Links between sparse lines, measured with the weights of refined matches.
#include "fit_options.h"
#include "support/points.h"

#include <pcl6d/registration/twist.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/map_verifier.h>

#include <cmath>
#include <utility>

using pcl6d::IcpModel;
using pcl6d::LinkEvidence;
using pcl6d::MapVerification;
using pcl6d::MapVerifier;
using pcl6d::MapVerifierOptions;
using pcl6d::Normals;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::SurfaceFit;
using pcl6d::VerifiedScan;
using pcl6d::test::kRoomScans;
using pcl6d::test::kVoxel;
using pcl6d::test::namesOf;
using pcl6d::test::PillarRoom;
using pcl6d::test::roomPoses;
using pcl6d::test::VerifiedScans;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace {
/** A room of 8 x 8 x 3 m with noise, and patches over two surfaces: a share of the floor's points
 * lies higher in each scan, by heights of its own, with normals that claim to be floor. */
struct Hall {
  Points points;
  Normals normals;

  Hall(std::uint64_t seed, double share_of_wrong, double height)
  {
    Random random(seed);
    for (int i = 0; i < 9000; ++i) {
      const double a = random.uniform(-4, 4), b = random.uniform(-1, 2);
      switch (i % 6) {
      case 0:
        add({a, 4, b}, -Eigen::Vector3d::UnitY(), random);
        break;
      case 1:
        add({a, -4, b}, Eigen::Vector3d::UnitY(), random);
        break;
      case 2:
        add({4, a, b}, -Eigen::Vector3d::UnitX(), random);
        break;
      case 3:
        add({-4, a, b}, Eigen::Vector3d::UnitX(), random);
        break;
      default: {
        const double lift = random.uniform(0, 1) < share_of_wrong ? height : 0;
        add({a, random.uniform(-4, 4), -1 + lift}, Eigen::Vector3d::UnitZ(), random);
      }
      }
    }
  }

private:
  void
  add(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, Random& random)
  {
    points.push_back((place + 0.02 * random.normal() * normal).cast<float>());
    normals.push_back(normal.cast<float>());
  }
};

/** \return the evidence of two halls at their true pose, with its refined fit */
LinkEvidence
evidenceOf(const Hall& first, const Hall& second)
{
  const IcpModel surfaces_first(first.points, first.normals, {});
  const IcpModel surfaces_second(second.points, second.normals, {});
  const VerifiedScan scan_first(first.points, surfaces_first, kVoxel);
  const VerifiedScan scan_second(second.points, surfaces_second, kVoxel);
  LinkEvidence evidence =
      linkEvidence(scan_first, scan_second, Eigen::Isometry3d::Identity());
  refineEvidence(scan_first, scan_second, evidence);
  return evidence;
}

double
squareOf(const SurfaceFit& fit)
{
  return fit.step.dot(fit.pose_covariance.inverse() * fit.step) / 6;
}
} // namespace

TEST(RefinedLink, CovarianceIsThatOfSimulatedNoise)
{
  // Squared steps at the truth in the stated deviations: 1 on average if these are right.
  constexpr int kTrials = 60;
  double sum = 0, sum_equal = 0;
  Matrix6 steps = Matrix6::Zero(), stated = Matrix6::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto seed = static_cast<std::uint64_t>(2 * trial);
    const LinkEvidence evidence =
        evidenceOf(Hall(100 + seed, 0, 0), Hall(101 + seed, 0, 0));
    ASSERT_TRUE(evidence.refined);
    sum += squareOf(*evidence.refined) / kTrials;
    steps += evidence.refined->step * evidence.refined->step.transpose() / kTrials;
    stated += evidence.refined->pose_covariance / kTrials;
    sum_equal += squareOf(evidence.fit) / kTrials;
  }
  RecordProperty("nees", std::to_string(sum));
  RecordProperty("nees_of_equal_weights", std::to_string(sum_equal));
  EXPECT_GT(sum, 0.4);
  EXPECT_LT(sum, 2);
  for (int k = 0; k < 6; ++k) { // of 60 samples, a variance has a deviation of 18 %
    EXPECT_GT(stated(k, k), 0.6 * steps(k, k)) << k;
    EXPECT_LT(stated(k, k), 4 * steps(k, k)) << k;
  }
}

TEST(RefinedLink, IsRightWhereWrongNormalsPull)
{
  const LinkEvidence evidence = evidenceOf(Hall(1, 0.3, 0.12), Hall(2, 0, 0));
  ASSERT_TRUE(evidence.refined);
  EXPECT_GT(std::abs(evidence.fit.step(2)), 0.01) << "nothing pulls";
  EXPECT_LT(std::abs(evidence.refined->step(2)), 0.005);
  const auto deviation = [](const SurfaceFit& fit) {
    return std::sqrt(fit.pose_covariance(2, 2));
  };
  EXPECT_LT(deviation(*evidence.refined), deviation(evidence.fit));
}

TEST(RefinedLink, GrowsWithTheNoise)
{
  const LinkEvidence evidence = evidenceOf(Hall(3, 0, 0), Hall(4, 0, 0));
  Hall noisy(5, 0, 0);
  Random random(6);
  for (std::size_t i = 0; i < noisy.points.size(); ++i)
    noisy.points[i] += static_cast<float>(0.06 * random.normal()) * noisy.normals[i];
  const LinkEvidence of_noisy = evidenceOf(Hall(3, 0, 0), noisy);
  ASSERT_TRUE(evidence.refined && of_noisy.refined);
  const auto variance = [](const SurfaceFit& fit) {
    return fit.pose_covariance.diagonal().head(3).sum();
  };
  EXPECT_GT(variance(*of_noisy.refined), 2 * variance(*evidence.refined));
}

TEST(RefinedLink, IsNoneWhereAMotionIsOpen)
{
  Random random(7);
  Hall floor(8, 0, 0);
  for (std::size_t i = 0; i < floor.points.size(); ++i) {
    floor.points[i] =
        Eigen::Vector3d(random.uniform(-4, 4), random.uniform(-4, 4), -1).cast<float>();
    floor.normals[i] = Eigen::Vector3f::UnitZ();
  }
  EXPECT_FALSE(evidenceOf(floor, floor).refined);
}

TEST(RefinedLink, ChangesNoVerdict)
{
  Random random(11);
  VerifiedScans scans;
  for (const auto& pose : roomPoses())
    scans.add(PillarRoom().scan(pose, random, 0.04));
  MapVerifierOptions options;
  const auto verified = [&](bool are_refined) {
    options.refined = are_refined;
    return MapVerifier(scans.all(), namesOf(kRoomScans), options).verify(roomPoses());
  };
  const MapVerification equal = verified(false), refined = verified(true);
  EXPECT_EQ(refined.trust, equal.trust);
  ASSERT_EQ(refined.links.size(), equal.links.size());
  for (std::size_t k = 0; k < refined.links.size(); ++k) {
    EXPECT_FALSE(equal.links[k].refined);
    EXPECT_TRUE(refined.links[k].refined);
    EXPECT_EQ(refined.links[k].trust, equal.links[k].trust);
    EXPECT_EQ(refined.links[k].probability_wrong, equal.links[k].probability_wrong);
    EXPECT_EQ(refined.links[k].shift, equal.links[k].shift);
    EXPECT_EQ(refined.links[k].deviation, equal.links[k].deviation);
    EXPECT_NE(refined.links[k].pull, equal.links[k].pull);
  }
}

TEST(RefinedLink, IsTakenOverWhereTheMapComesNearerToRest)
{
  Random random(11);
  VerifiedScans scans;
  for (const auto& pose : roomPoses())
    scans.add(PillarRoom().scan(pose, random, 0.04));
  pcl6d::LinkMemory memory;
  MapVerifierOptions options;
  options.refined = true;
  options.memory = &memory;
  const auto verified = [&](const auto& poses) {
    return MapVerifier(scans.all(), namesOf(kRoomScans), options).verify(poses);
  };
  auto off = roomPoses();
  for (std::size_t i = 1; i < off.size(); ++i)
    off[i].translation().x() += 0.02 * (i % 2 == 0 ? 1 : -1);
  const MapVerification before = verified(off), after = verified(roomPoses());
  ASSERT_EQ(after.links.size(), before.links.size());
  std::size_t taken_over = 0;
  for (std::size_t k = 0; k < after.links.size(); ++k) {
    ASSERT_TRUE(before.links[k].refined && after.links[k].refined);
    const auto [from, to] = std::pair(after.links[k].from, after.links[k].to);
    ASSERT_EQ(before.links[k].to, to);
    const Eigen::Isometry3d then =
        off[from].inverse() * off[to] * pcl6d::motionFromTwist(before.links[k].pull);
    const Eigen::Isometry3d now = roomPoses()[from].inverse() * roomPoses()[to] *
                                  pcl6d::motionFromTwist(after.links[k].pull);
    if ((then.matrix() - now.matrix()).cwiseAbs().maxCoeff() > 1e-9)
      continue; // rest lies farther from the new pose
    ++taken_over;
    EXPECT_NEAR(after.links[k].covariance.trace() / before.links[k].covariance.trace(),
                1,
                0.05);
  }
  EXPECT_GT(2 * taken_over, after.links.size());
}
