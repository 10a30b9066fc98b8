// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/bits.h"
#include "support/poses.h"

#include <pcl6d/io/pose_graph_io.h>

using pcl6d::PoseGraph;
using pcl6d::PoseLink;
using pcl6d::readPoseGraph;
using pcl6d::writePoseGraphG2o;
using pcl6d::writePoseGraphToro;
using pcl6d::test::kRotationTolerance;
using pcl6d::test::kUnitInformation;
using pcl6d::test::replaceText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace {
// A rotation goes through its quaternion or angles and back: a few ulp.

Matrix6
randomInformation(pcl6d::Random& random)
{
  const Matrix6 A = Matrix6::NullaryExpr([&] { return random.normal(); });
  const Matrix6 information = A * A.transpose();
  return 0.5 * (information + information.transpose());
}

PoseGraph
makeGraph()
{
  pcl6d::Random random(3);
  PoseGraph graph;
  for (std::size_t i = 0; i < 12; ++i) {
    graph.poses.push_back(pcl6d::test::randomPose(random, 50, random.uniform(0, M_PI)));
    graph.ids.push_back(1000 - 7 * i);
    graph.links.push_back({i,
                           (i * 5 + 3) % 12,
                           pcl6d::test::randomPose(random, 5, random.uniform(0, 3)),
                           randomInformation(random)});
  }
  return graph;
}

void
expectSameGraph(const PoseGraph& a, const PoseGraph& b)
{
  ASSERT_EQ(a.poses.size(), b.poses.size());
  ASSERT_EQ(a.links.size(), b.links.size());
  EXPECT_EQ(a.ids, b.ids);
  const auto expectSamePose = [](const auto& p, const auto& q) {
    EXPECT_EQ(p.translation(), q.translation()); // all digits
    EXPECT_LT(pcl6d::distanceBetween(p, q).rotation, kRotationTolerance);
  };
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    expectSamePose(a.poses[i], b.poses[i]);
  for (std::size_t k = 0; k < a.links.size(); ++k) {
    EXPECT_EQ(a.links[k].from, b.links[k].from);
    EXPECT_EQ(a.links[k].to, b.links[k].to);
    expectSamePose(a.links[k].T_from_to, b.links[k].T_from_to);
    EXPECT_TRUE(pcl6d::test::sameBits(a.links[k].information, b.links[k].information));
  }
}

PoseGraph
readText(const TempFolder& folder, const std::string& content)
{
  replaceText(folder / "graph", content);
  return readPoseGraph(folder / "graph");
}
} // namespace

TEST(PoseGraphIo, G2oComesBackAsItWas)
{
  const TempFolder folder;
  const PoseGraph graph = makeGraph();
  writePoseGraphG2o(folder / "graph.g2o", graph);
  expectSameGraph(graph, readPoseGraph(folder / "graph.g2o"));
}

TEST(PoseGraphIo, ToroComesBackAsItWas)
{
  const TempFolder folder;
  const PoseGraph graph = makeGraph();
  writePoseGraphToro(folder / "graph.txt", graph);
  expectSameGraph(graph, readPoseGraph(folder / "graph.txt"));
}

TEST(PoseGraphIo, TheExtensionTellsTheFormatUnlessItIsGiven)
{
  using pcl6d::PoseGraphFormat;
  const TempFolder folder;
  const PoseGraph graph = makeGraph();
  const auto firstWord = [&](const char* name, PoseGraphFormat format) {
    pcl6d::writePoseGraph(folder / name, graph, format);
    const std::string text = pcl6d::test::readText(folder / name);
    return text.substr(0, text.find(' '));
  };
  for (const char* const name : {"a.graph", "a.TORO"})
    EXPECT_EQ(firstWord(name, PoseGraphFormat::kAuto), "VERTEX3") << name;
  for (const char* const name : {"a.g2o", "a.txt", "a"})
    EXPECT_EQ(firstWord(name, PoseGraphFormat::kAuto), "VERTEX_SE3:QUAT") << name;
  EXPECT_EQ(firstWord("b.g2o", PoseGraphFormat::kToro), "VERTEX3");
  EXPECT_EQ(firstWord("b.graph", PoseGraphFormat::kG2o), "VERTEX_SE3:QUAT");
  for (const char* const name : {"auto", "g2o", "toro"})
    EXPECT_EQ(toString(pcl6d::poseGraphFormatFromName(name)), name);
  EXPECT_THROW(pcl6d::poseGraphFormatFromName("dot"), pcl6d::BadArgument);
}

TEST(PoseGraphIo, ADecimalCommaElsewhereChangesNothing)
{
  const TempFolder folder;
  const PoseGraph graph = makeGraph();
  writePoseGraphG2o(folder / "point", graph);
  const pcl6d::test::DecimalComma locale;
  writePoseGraphG2o(folder / "comma", graph);
  EXPECT_EQ(pcl6d::test::readText(folder / "point"),
            pcl6d::test::readText(folder / "comma"));
  expectSameGraph(graph, readPoseGraph(folder / "comma"));
}

TEST(PoseGraphIo, InformationIsThatOfTheRotationVector)
{
  const TempFolder folder;
  const std::string triangle = " 1 0.1 0.2 0.3 0.4 0.5 2 0.6 0.7 0.8 0.9 3 0.11 0.12 "
                               "0.13 4 0.14 0.15 5 0.16 6\n";
  const PoseGraph g2o =
      readText(folder,
               "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n"
               "EDGE_SE3:QUAT 0 1 1 2 3 0 0 0.70710678118654752 0.70710678118654752" +
                   triangle);
  const PoseGraph toro =
      readText(folder,
               "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 0 0 0 0 0 0\nEDGE3 0 1 1 2 3 0 0 "
               "1.57079632679489662" +
                   triangle);
  EXPECT_TRUE(
      g2o.links[0].T_from_to.isApprox(toro.links[0].T_from_to, kRotationTolerance));
  EXPECT_TRUE(g2o.links[0].T_from_to.isApprox(
      pcl6d::poseFromEuler({1, 2, 3}, {0, 0, M_PI / 2}), kRotationTolerance));
  const Matrix6& file = toro.links[0].information;
  EXPECT_EQ(file, file.transpose());
  EXPECT_EQ(file(0, 5), 0.5);
  EXPECT_EQ(file(1, 3), 0.7);
  EXPECT_EQ(file(5, 5), 6);
  // e_file = S e with S = diag(1, 1, 1, 1/2, 1/2, 1/2).
  Matrix6 S = Matrix6::Identity();
  S.bottomRightCorner<3, 3>() *= 0.5;
  EXPECT_EQ(g2o.links[0].information, S * file * S);
}

TEST(PoseGraphIo, VerticesMayStandInAnyOrderBehindTheirLinks)
{
  const TempFolder folder;
  const PoseGraph graph =
      readText(folder,
               "# a graph\n\nEDGE_SE3:QUAT 7 3 1 0 0 0 0 0 1" + kUnitInformation +
                   "VERTEX_SE3:QUAT 7 1 0 0 0 0 0 1\r\nFIX 3 7\n"
                   "VERTEX_SE3:QUAT 3 2 0 0 0 0 0 1");
  EXPECT_EQ(graph.ids, (std::vector<std::size_t>{7, 3}));
  EXPECT_EQ(graph.links.at(0).from, 0u);
  EXPECT_EQ(graph.links.at(0).to, 1u);
  EXPECT_EQ(graph.poses[1].translation().x(), 2);
  const PoseGraph alone = readText(folder, "VERTEX3 0 1 2 3 0 0 0\n");
  EXPECT_EQ(alone.poses.size(), 1u);
  EXPECT_TRUE(alone.ids.empty()) << "0, 1, ... need no names";
}

TEST(PoseGraphIo, WithoutVerticesTheChainGivesThePoses)
{
  const TempFolder folder;
  const PoseGraph graph =
      readText(folder,
               "EDGE3 1 2 0 2 0 0 0 0" + kUnitInformation + "EDGE3 0 2 9 9 9 0 0 0" +
                   kUnitInformation + "EDGE3 0 1 1 0 0 0 0 1.5707963267948966" +
                   kUnitInformation);
  ASSERT_EQ(graph.poses.size(), 3u);
  EXPECT_TRUE(graph.poses[0].isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(graph.poses[1].translation().isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_LT((graph.poses[2].translation() - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-15);
}

TEST(PoseGraphIo, WithoutVerticesAndChainATreeGivesThePoses)
{
  const TempFolder folder;
  const PoseGraph graph =
      readText(folder,
               "EDGE3 30 10 1 0 0 0 0 1.5707963267948966" + kUnitInformation +
                   "EDGE3 30 20 0 5 0 0 0 0" + kUnitInformation +
                   "EDGE3 50 60 0 0 7 0 0 0" + kUnitInformation);
  EXPECT_EQ(graph.ids, (std::vector<std::size_t>{10, 20, 30, 50, 60}));
  ASSERT_EQ(graph.poses.size(), 5u);
  for (const auto& link : graph.links)
    EXPECT_TRUE((graph.poses[link.from].inverse() * graph.poses[link.to])
                    .isApprox(link.T_from_to, 1e-15));
  EXPECT_TRUE(graph.poses[0].isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(graph.poses[3].isApprox(Eigen::Isometry3d::Identity()));
}

TEST(PoseGraphIo, InformationMayBeSingular)
{
  const TempFolder folder;
  const std::string links =
      "EDGE3 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 "
      "0 0\n" // none at all
      "EDGE3 0 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 "
      "0 1\n"; // x + y alone
  EXPECT_EQ(readText(folder, links).links.size(), 2u);
}
