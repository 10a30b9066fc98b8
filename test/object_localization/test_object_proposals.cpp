// SPDX-License-Identifier: BSD-3-Clause
#include "proposal_scenes.h"
#include "support/points.h"

#include <pcl6d/common/portable_math.h>

#include <gtest/gtest.h>

#include <set>

namespace {
using namespace pcl6d;
using pcl6d::test::badArgumentOf;
using pcl6d::test::coverOf;
using pcl6d::test::material;
using pcl6d::test::ObjectCover;
using pcl6d::test::proposalsIn;
using pcl6d::test::scanRoom;
using pcl6d::test::scanTable;
using pcl6d::test::ThingScan;

constexpr double kPiece = 0.05; // [m] cells of largestPiece()

std::vector<ObjectCover>
coverOfAll(const ThingScan& scan, const std::vector<ObjectProposal>& proposals)
{
  return coverOf(scan.points, scan.object_of, proposals, 50, kPiece);
}

/** A box on a table, one that stands on another, and a bowl, apart from each other. */
TriangleScene
tableThings()
{
  TriangleScene scene;
  addBox(scene, Box{{-0.1, 0.3, 0.08}, {0.12, 0.08, 0.16}, 0.4}, material(1));
  addBox(scene, Box{{0.05, -0.25, 0.04}, {0.22, 0.22, 0.08}, 0.2}, material(2));
  addBox(scene, Box{{0.07, -0.25, 0.15}, {0.08, 0.1, 0.14}, 0.5}, material(3));
  return scene;
}

/** A low table with a box on it, a bin, and a cupboard at the wall. */
TriangleScene
roomThings()
{
  TriangleScene scene;
  addBox(scene, {1.2, -0.8, 0.38}, {2.0, 0.6, 0.42}, material(1));
  for (const double x : {1.2, 1.92})
    for (const double y : {-0.8, 0.52})
      addBox(scene, {x, y, 0}, {x + 0.08, y + 0.08, 0.38}, material(1));
  addBox(scene, {1.4, -0.4, 0.42}, {1.7, 0.1, 0.8}, material(2));
  addBox(scene, {-1.7, 0.6, 0}, {-1.3, 1, 0.9}, material(3));
  addBox(scene, {-0.6, -2.48, 0}, {0.6, -2.05, 1.6}, material(4));
  return scene;
}

const ThingScan&
tableScan()
{
  static const ThingScan scan = scanTable(tableThings());
  return scan;
}

const ThingScan&
roomScan()
{
  static const ThingScan scan = scanRoom(roomThings());
  return scan;
}
} // namespace

TEST(ObjectProposals, CoverWhatStandsOnATableSeenByATiltedCamera)
{
  const ThingScan& scan = tableScan();
  const auto proposals = proposalsIn(scan.points);
  const auto covers = coverOfAll(scan, proposals);
  ASSERT_EQ(covers.size(), 3u);
  for (const auto& cover : covers)
    EXPECT_GT(cover.iou, 0.85) << "object " << cover.id;
  EXPECT_GT(covers[0].whole_iou, 0.85) << "the one that stands alone";
  EXPECT_EQ(proposals.size(), 4u) << "a box, a stack, its two parts";
}

TEST(ObjectProposals, GiveEachThingAnUprightBoxOnItsSupport)
{
  TriangleScene scene;
  addBox(scene, Box{{0.05, 0, 0.1}, {0.3, 0.2, 0.2}, 0.5}, material(1));
  const ThingScan scan = scanTable(scene);
  const auto proposals = proposalsIn(scan.points);
  ASSERT_EQ(proposals.size(), 1u);
  const Eigen::Isometry3d T_world_box =
      test::lookFrom({-0.8, 0.1, 0.6}, Eigen::Vector3d::Zero()) *
      proposals[0].T_scene_box;
  constexpr double kTolerance = 0.012; // [m] three spacings of pixels, with the noise
  EXPECT_LT((proposals[0].size - Eigen::Vector3d(0.3, 0.2, 0.2)).norm(), kTolerance);
  EXPECT_LT((T_world_box.translation() - Eigen::Vector3d(0.05, 0, 0)).norm(),
            kTolerance);
  EXPECT_GT(T_world_box.linear().col(2).z(), 0.9999);
  const SinCos yaw = portableSinCos(0.5);
  EXPECT_GT(
      std::abs(T_world_box.linear().col(0).dot(Eigen::Vector3d(yaw.cos, yaw.sin, 0))),
      0.999);
  EXPECT_NEAR(T_world_box.linear().determinant(), 1, 1e-9);
}

TEST(ObjectProposals, DoNotDependOnTheFrameOfTheCamera)
{
  const ThingScan& scan = tableScan();
  const Eigen::Matrix3d turn = test::lookFrom({1, 2, 3}, {0.3, 5, -2}).linear();
  ThingScan turned = scan;
  for (auto& p : turned.points)
    p = turn.cast<float>() * p;
  for (const auto& cover : coverOfAll(turned, proposalsIn(turned.points)))
    EXPECT_GT(cover.iou, 0.85) << "object " << cover.id;
}

TEST(ObjectProposals, JoinTheInsideOfABowlWithItsOutside)
{
  TriangleScene scene;
  Surface clay = material(1);
  clay.is_solid = false;
  TriangleMesh wall; // of 9 cm radius and height, open at the top
  constexpr int kSides = 48;
  for (int i = 0; i < kSides; ++i) {
    const SinCos way = portableSinCos(2 * M_PI * i / kSides);
    for (const double radius : {0.09, 0.085})
      for (const double height : {0.0, 0.09})
        wall.vertices.emplace_back(radius * way.cos, radius * way.sin, height);
  }
  const auto at = [&](int side, std::uint32_t k) {
    return 4 * static_cast<std::uint32_t>(side % kSides) + k;
  };
  for (int i = 0; i < kSides; ++i)
    for (const auto& [a, b] : {std::pair{0U, 1U}, {2U, 3U}, {1U, 3U}}) {
      wall.triangles.push_back({at(i, a), at(i + 1, a), at(i, b)});
      wall.triangles.push_back({at(i + 1, a), at(i + 1, b), at(i, b)});
    }
  addMesh(scene, wall, Eigen::Isometry3d::Identity(), clay);
  const ThingScan scan = scanTable(scene);
  const auto covers = coverOfAll(scan, proposalsIn(scan.points));
  ASSERT_EQ(covers.size(), 1u);
  EXPECT_GT(covers[0].whole_iou, 0.85);
}

TEST(ObjectProposals, CoverFurnitureAndWhatLiesOnItAndNoWalls)
{
  const ThingScan& scan = roomScan();
  const auto proposals = proposalsIn(scan.points);
  const auto covers = coverOfAll(scan, proposals);
  ASSERT_EQ(covers.size(), 4u);
  for (const auto& cover : covers)
    EXPECT_GT(cover.iou, cover.id == 1 ? 0.7 : 0.85) << "object " << cover.id;
  for (const auto& proposal : proposals) {
    std::size_t of_objects = 0;
    for (const auto i : proposal.points)
      of_objects += scan.object_of[i] != 0;
    EXPECT_GT(of_objects, proposal.points.size() * 9 / 10)
        << "at " << proposal.T_scene_box.translation().transpose();
  }
}

TEST(ObjectProposals, TellPartsFromWholes)
{
  const auto proposals = proposalsIn(roomScan().points);
  std::size_t parts = 0;
  for (std::size_t k = 0; k < proposals.size(); ++k) {
    EXPECT_TRUE(std::is_sorted(proposals[k].points.begin(), proposals[k].points.end()));
    if (!proposals[k].part_of)
      continue;
    ++parts;
    ASSERT_LT(*proposals[k].part_of, k);
    const auto& whole = proposals[*proposals[k].part_of];
    EXPECT_FALSE(whole.part_of);
    EXPECT_TRUE(std::includes(whole.points.begin(),
                              whole.points.end(),
                              proposals[k].points.begin(),
                              proposals[k].points.end()));
    EXPECT_LT(proposals[k].points.size(), whole.points.size());
  }
  EXPECT_GE(parts, 2u) << "the table, and what lies on it";
  ProposalOptions wholes;
  wholes.parts = false;
  for (const auto& proposal : proposalsIn(roomScan().points, wholes))
    EXPECT_FALSE(proposal.part_of);
}

TEST(ObjectProposals, SayWhatEndsAtTheBorderOfTheView)
{
  TriangleScene scene;
  addBox(scene, Box{{-0.2, 0, 0.05}, {0.1, 0.1, 0.1}}, material(1));
  addBox(scene, {-0.45, -0.05, 0}, {-0.38, 0.3, 0.1}, material(2)); // half in view
  const ThingScan scan = scanTable(scene);
  const auto proposals = proposalsIn(scan.points);
  std::set<std::uint32_t> cut, uncut;
  for (const auto& proposal : proposals)
    (proposal.touches_border ? cut : uncut).insert(scan.object_of[proposal.points[0]]);
  EXPECT_EQ(cut.count(2), 1u);
  EXPECT_EQ(uncut, (std::set<std::uint32_t>{1}));
}

TEST(ObjectProposals, AreTheSameForAnyNumberOfThreads)
{
  const ThingScan& scan = roomScan();
  ProposalOptions one, three;
  one.num_threads = 1;
  three.num_threads = 3;
  const auto a = proposalsIn(scan.points, one), b = proposalsIn(scan.points, three);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].points, b[k].points);
    EXPECT_EQ(a[k].T_scene_box.matrix(), b[k].T_scene_box.matrix());
    EXPECT_EQ(a[k].size, b[k].size);
    EXPECT_EQ(a[k].part_of, b[k].part_of);
  }
}

TEST(ObjectProposals, AreNoneWithoutASupport)
{
  EXPECT_TRUE(proposalsIn({}).empty());
  EXPECT_TRUE(proposalsIn({{1, 0, 0}, {1, 1, 0}}).empty());
  Points line;
  for (int i = 0; i < 500; ++i)
    line.emplace_back(1.F, 0.01F * static_cast<float>(i), 0.F);
  EXPECT_TRUE(proposalsIn(line).empty());
  EXPECT_TRUE(proposalsIn(scanTable({}).points).empty()) << "an empty table";
  ProposalOptions sideways;
  sideways.up = Eigen::Vector3d::UnitY();
  EXPECT_TRUE(proposalsIn(tableScan().points, sideways).empty());
}

TEST(ObjectProposals, LeaveOutPointsThatAreNotFinite)
{
  const ThingScan& scan = tableScan();
  Points with_nan;
  for (const auto& p : scan.points) {
    with_nan.push_back(p);
    with_nan.emplace_back(test::kNan, 0.F, 0.F);
  }
  const auto expected = proposalsIn(scan.points), found = proposalsIn(with_nan);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    std::vector<std::uint32_t> places;
    for (const auto i : expected[k].points)
      places.push_back(2 * i);
    EXPECT_EQ(found[k].points, places);
  }
}

TEST(ObjectProposals, RefuseBadOptions)
{
  const auto message = [](auto change) {
    ProposalOptions options;
    change(options);
    return badArgumentOf([&] { proposalsIn({}, options); });
  };
  using Options = ProposalOptions&;
  EXPECT_EQ(message([](Options o) { o.gap = 0.5; }).rfind("gap = 0.5", 0), 0u);
  EXPECT_EQ(message([](Options o) { o.min_points = 2; }).rfind("min_points = 2", 0),
            0u);
  EXPECT_EQ(message([](Options o) { o.crease = 1; }).rfind("crease = 1", 0), 0u);
  EXPECT_EQ(message([](Options o) { o.overhang = -1; }).rfind("overhang = -1", 0), 0u);
  EXPECT_EQ(message([](Options o) { o.max_tilt = 2; }).rfind("max_tilt = 2", 0), 0u);
  EXPECT_EQ(message([](Options o) { o.contact = NAN; }).rfind("contact = nan", 0), 0u);
  EXPECT_EQ(
      message([](Options o) { o.up = Eigen::Vector3d::Zero(); }).rfind("up = ", 0), 0u);
}
