// SPDX-License-Identifier: BSD-3-Clause
// How exactly the links of a verified map fix its poses.
#include "support/points.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/slam6d/pose_bounds.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using pcl6d::LinkCheck;
using pcl6d::LinkTrust;
using pcl6d::MapVerification;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::Twist;

namespace {
using Poses = std::vector<Eigen::Isometry3d>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** [deviations] radius that holds the errors along one line with 95 %. */
constexpr double kOfLine = 1.959964;

/** Of the approximation of radii. */
constexpr double kRadiusTol = 0.013;

Matrix6
diagonalBound(double metres, double radians)
{
  Twist deviations;
  deviations << metres, metres, metres, radians, radians, radians;
  return deviations.cwiseAbs2().asDiagonal();
}

LinkCheck
link(std::size_t from, std::size_t to, const Matrix6& covariance)
{
  LinkCheck check;
  check.from = from;
  check.to = to;
  check.trust = LinkTrust::kGood;
  check.covariance = covariance;
  return check;
}

MapVerification
mapOf(std::size_t count, const std::vector<LinkCheck>& links)
{
  MapVerification map;
  map.scans.resize(count);
  for (auto& scan : map.scans)
    scan.tied = true;
  map.links = links;
  return map;
}

Poses
line(std::size_t count)
{
  Poses poses;
  for (std::size_t i = 0; i < count; ++i)
    poses.push_back(poseFromEuler({2.0 * static_cast<double>(i), 0, 0}, {}));
  return poses;
}

MapVerification
bounded(const Poses& poses, MapVerification map, unsigned int threads = 1)
{
  pcl6d::boundPoses(poses, map, threads);
  return map;
}
} // namespace

TEST(PoseBounds, AreUnknownWhereLinksAreTooUnlikeForTheirSum)
{
  const auto map = bounded(line(3),
                           mapOf(3,
                                 {link(0, 1, diagonalBound(1e8, 1e8)),
                                  link(1, 2, diagonalBound(1e-12, 1e-12))}));
  EXPECT_EQ(map.scans[0].bound, 0);
  EXPECT_FALSE(map.scans[1].bound);
  EXPECT_FALSE(map.scans[2].bound);
  EXPECT_FALSE(map.scans[2].covariance);
}

TEST(PoseBounds, OfOneLinkAreThoseOfTheLink)
{
  Matrix6 covariance = diagonalBound(0.01, 0.001);
  covariance(1, 1) = 0.03 * 0.03;
  const auto map = bounded(line(2), mapOf(2, {link(0, 1, covariance)}));
  EXPECT_EQ(map.scans[0].bound, 0);
  EXPECT_TRUE(map.scans[0].covariance->isZero(0));
  ASSERT_TRUE(map.scans[1].covariance);
  EXPECT_TRUE(map.scans[1].covariance->isApprox(covariance, 1e-9));
}

// The first scan's frame is turned about z by 0.01 rad (1 sigma): 4 m away, that is 4 cm along y.
TEST(PoseBounds, ContainTheFramesOfTheScanAndOfTheFirst)
{
  const Matrix6 covariance = diagonalBound(0.01, 0.001);
  auto map = mapOf(2, {link(0, 1, covariance)});
  const Poses poses = {Eigen::Isometry3d::Identity(),
                       poseFromEuler({4, 0, 0}, {0, 0, M_PI / 2})};
  std::vector<Matrix6> frames(2, Matrix6::Zero());
  frames[0](5, 5) = 0.01 * 0.01;
  frames[1](2, 2) = 0.02 * 0.02;
  pcl6d::boundPoses(poses, map, 1, frames);
  Matrix6 expected = covariance;
  expected(0, 0) += 0.04 * 0.04; // the second scan looks along y
  expected(5, 5) += 0.01 * 0.01;
  expected(0, 5) = expected(5, 0) = expected(0, 5) + 0.04 * 0.01;
  expected(2, 2) += 0.02 * 0.02;
  ASSERT_TRUE(map.scans[1].covariance);
  EXPECT_TRUE(map.scans[1].covariance->isApprox(expected, 1e-9))
      << *map.scans[1].covariance;
  EXPECT_THROW(pcl6d::boundPoses(poses, map, 1, {Matrix6::Zero()}), pcl6d::BadArgument);
}

TEST(PoseBounds, AreTheRadiiOfSpheresThatHold95PercentOfTheErrors)
{
  Random random(11);
  constexpr int kSamples = 40000;
  for (const Eigen::Vector3d& deviations : {Eigen::Vector3d(1, 0.001, 0.001),
                                            Eigen::Vector3d(1, 1, 0.001),
                                            Eigen::Vector3d(1, 1, 1),
                                            Eigen::Vector3d(3, 2, 1)}) {
    Matrix6 covariance = diagonalBound(1, 0.01);
    covariance.topLeftCorner<3, 3>() = deviations.cwiseAbs2().asDiagonal();
    const double bound =
        *bounded(line(2), mapOf(2, {link(0, 1, covariance)})).scans[1].bound;
    int held = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector3d unit(random.normal(), random.normal(), random.normal());
      held += deviations.cwiseProduct(unit).norm() <= bound ? 1 : 0;
    }
    EXPECT_NEAR(held, 0.95 * kSamples, 0.005 * kSamples) << deviations.transpose();
  }
}

TEST(PoseBounds, GrowAlongAChainAsItsErrorsAdd)
{
  // Sums of independent errors; a turn of one scan shifts those behind by its arm.
  const double shift = 0.01, turn = 0.002;
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i + 1 < 4; ++i)
    links.push_back(link(i, i + 1, diagonalBound(shift, turn)));
  const auto map = bounded(line(4), mapOf(4, links));
  const double across = 3 * shift * shift + (2 * 2 + 4 * 4) * turn * turn;
  EXPECT_NEAR(map.scans[3].covariance->coeff(0, 0), 3 * shift * shift, 1e-9);
  EXPECT_NEAR(map.scans[3].covariance->coeff(1, 1), across, 1e-9);
}

TEST(PoseBounds, ShrinkWithTheFourthRootOfTheLinksAsTheseShareErrors)
{
  const auto one = bounded(line(2), mapOf(2, {link(0, 1, diagonalBound(0.02, 0.01))}));
  const auto two = bounded(line(2),
                           mapOf(2,
                                 {link(0, 1, diagonalBound(0.02, 0.01)),
                                  link(0, 1, diagonalBound(0.02, 0.01))}));
  EXPECT_NEAR(*two.scans[1].bound, *one.scans[1].bound / std::pow(2.0, 0.25), 1e-9);
}

TEST(PoseBounds, OfRefinedLinksDoNotShrinkWithTheLinksAsTheseShareAllErrors)
{
  LinkCheck refined = link(0, 1, diagonalBound(0.02, 0.01));
  refined.refined = true;
  const auto one = bounded(line(2), mapOf(2, {refined}));
  const auto two = bounded(line(2), mapOf(2, {refined, refined}));
  EXPECT_NEAR(*two.scans[1].bound, *one.scans[1].bound, 1e-9);
}

TEST(PoseBounds, OfRefinedLinksDoNotFollowALinkThatContradictsTheRest)
{
  const auto of = [](double error, bool is_refined) {
    std::vector<LinkCheck> links;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = i + 1; k < 6; ++k) {
        links.push_back(link(i, k, diagonalBound(0.01, 0.001)));
        links.back().refined = is_refined;
      }
    links[7].pull(1) = error;
    return *bounded(line(6), mapOf(6, links)).scans[5].bound;
  };
  EXPECT_LT(of(1, true), 1.5 * of(0, true));
  EXPECT_GT(of(1, false), 5 * of(0, false)) << "equal weights have no such rule";
}

TEST(PoseBounds, CountTheWayThatTheLinksAskFor)
{
  LinkCheck pulled = link(0, 1, diagonalBound(0.01, 0.001));
  pulled.pull(0) = 0.2;
  const auto map = bounded(line(2), mapOf(2, {pulled}));
  EXPECT_NEAR(
      *map.scans[1].bound / (kOfLine * std::sqrt(0.2 * 0.2 + 1e-4)), 1, kRadiusTol);
}

TEST(PoseBounds, GrowIfCyclesDoNotClose)
{
  const auto triangle = [](double error) {
    std::vector<LinkCheck> links = {link(0, 1, diagonalBound(0.01, 0.001)),
                                    link(1, 2, diagonalBound(0.01, 0.001)),
                                    link(0, 2, diagonalBound(0.01, 0.001))};
    links[2].pull(2) = error;
    return *bounded(line(3), mapOf(3, links)).scans[2].bound;
  };
  EXPECT_NEAR(triangle(0.005), triangle(0), 0.1 * triangle(0)) << "within its noise";
  EXPECT_GT(triangle(0.5), 10 * triangle(0));
}

TEST(PoseBounds, AreNoneForScansThatNothingJoins)
{
  std::vector<LinkCheck> links = {link(0, 1, diagonalBound(0.01, 0.001)),
                                  link(1, 2, diagonalBound(0.01, 0.001)),
                                  link(2, 3, diagonalBound(0.01, 0.001))};
  links[1].trust = LinkTrust::kWeak;
  const auto map = bounded(line(4), mapOf(4, links));
  EXPECT_TRUE(map.scans[1].bound);
  for (const std::size_t i : {2u, 3u}) {
    EXPECT_FALSE(map.scans[i].bound);
    EXPECT_FALSE(map.scans[i].covariance);
  }
}

TEST(PoseBounds, CountLinksWhoseSurfacesAskForAShift)
{
  // A loop of chain links that is open by half a metre, as the link across it says.
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i + 1 < 6; ++i)
    links.push_back(link(i, i + 1, diagonalBound(0.01, 0.001)));
  const double chain = *bounded(line(6), mapOf(6, links)).scans[5].bound;
  links.push_back(link(0, 5, diagonalBound(0.01, 0.001)));
  links.back().trust = LinkTrust::kWrong;
  links.back().pull(1) = links.back().shift = 0.5;
  EXPECT_EQ(*bounded(line(6), mapOf(6, links)).scans[5].bound, chain)
      << "it may be elsewhere";
  links.back().elsewhere = 0.001;
  EXPECT_GT(*bounded(line(6), mapOf(6, links)).scans[5].bound, 0.5);
}

TEST(PoseBounds, OfRefinedLinksFollowTheirOwnShift)
{
  // The surfaces with equal weights ask for a shift of 10 deviations, the refined ones for none.
  const auto of = [](bool is_refined, double sigmas) {
    std::vector<LinkCheck> links;
    for (std::size_t i = 0; i + 1 < 6; ++i) {
      links.push_back(link(i, i + 1, diagonalBound(0.01, 0.001)));
      links.back().refined = is_refined;
      links.back().shift = 0.3;
      links.back().deviation = 0.03;
      links.back().pull(1) = (i % 2 == 0 ? 1 : -1) * 0.01 * sigmas;
    }
    return *bounded(line(6), mapOf(6, links)).scans[5].bound;
  };
  EXPECT_NEAR(of(false, 0) / of(true, 0), 10, 1e-6);
  EXPECT_NEAR(of(true, 1), of(true, 0), 0.2 * of(true, 0)) << "within their covariance";
  EXPECT_GT(of(true, 10), 3 * of(true, 0));
}

TEST(PoseBounds, AreNoneIfTheFirstScanIsNotTied)
{
  MapVerification map = mapOf(2, {link(0, 1, diagonalBound(0.01, 0.001))});
  map.scans[0].tied = false;
  EXPECT_FALSE(bounded(line(2), map).scans[0].bound);
  EXPECT_FALSE(bounded(line(2), map).scans[1].bound);
}

TEST(PoseBounds, AreInTheUnitOfTheMap)
{
  const auto of = [](double scale) {
    Poses poses = line(3);
    for (auto& pose : poses)
      pose.translation() *= scale;
    std::vector<LinkCheck> links;
    for (std::size_t i = 0; i < 2; ++i)
      links.push_back(link(i, i + 1, diagonalBound(0.01 * scale, 0.002)));
    links[1].pull(1) = 0.03 * scale;
    return *bounded(poses, mapOf(3, links)).scans[2].bound / scale;
  };
  EXPECT_NEAR(of(100), of(1), 1e-6 * of(1));
  EXPECT_NEAR(of(0.01), of(1), 1e-6 * of(1));
}

TEST(PoseBounds, CoverTheErrorsOfLinksThatAreAsExactAsTheySay)
{
  // A map at its true poses, whose links are off by their covariances: the way from it to
  // their optimum is the error that a map at this optimum would have.
  Random random(3);
  const Matrix6 covariance = diagonalBound(0.02, 0.004);
  constexpr int kTrials = 1600;
  constexpr std::size_t kLast = 5;
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i < kLast; ++i)
    links.push_back(link(i, i + 1, covariance));
  const auto exact = bounded(line(kLast + 1), mapOf(kLast + 1, links)).scans[kLast];
  double sum = 0;
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    for (LinkCheck& check : links)
      for (int k = 0; k < 6; ++k)
        check.pull(k) = std::sqrt(covariance(k, k)) * random.normal();
    const auto off = bounded(line(kLast + 1), mapOf(kLast + 1, links)).scans[kLast];
    const Matrix6 way_sq = *off.covariance - *exact.covariance; // way way^T
    sum += (exact.covariance->inverse() * way_sq).trace();
    covered += way_sq.diagonal().head<3>().sum() <= *exact.bound * *exact.bound ? 1 : 0;
  }
  EXPECT_NEAR(sum / kTrials / 6, 1, 0.1) << "NEES / 6";
  EXPECT_GT(covered, 0.93 * kTrials);
}

TEST(PoseBounds, HaveTheSameBitsForAnyNumberOfThreads)
{
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i + 1 < 40; ++i) {
    links.push_back(link(i, i + 1, diagonalBound(0.01, 0.002)));
    links.back().pull(1) = 0.001 * static_cast<double>(i % 5);
    if (i >= 3)
      links.push_back(link(i - 3, i, diagonalBound(0.02, 0.002)));
  }
  const auto one = bounded(line(40), mapOf(40, links), 1);
  for (const unsigned int threads : {2u, 8u}) {
    const auto other = bounded(line(40), mapOf(40, links), threads);
    for (std::size_t i = 0; i < 40; ++i)
      EXPECT_EQ(*other.scans[i].covariance, *one.scans[i].covariance);
  }
}

TEST(PoseBounds, NeedAPoseForEachScan)
{
  MapVerification map = mapOf(2, {});
  EXPECT_NE(pcl6d::test::badArgumentOf([&] {
              pcl6d::boundPoses(line(3), map);
            }).find("one per scan"),
            std::string::npos);
  MapVerification none;
  pcl6d::boundPoses({}, none);
  EXPECT_TRUE(none.scans.empty());
}
