// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/poses.h"

#include <pcl6d/io/pose_graph_io.h>

#include <Eigen/Eigenvalues>

using pcl6d::PoseGraph;
using pcl6d::readPoseGraph;
using pcl6d::writePoseGraphG2o;
using pcl6d::writePoseGraphToro;
using pcl6d::test::expectIoFailed;
using pcl6d::test::kUnitInformation;
using pcl6d::test::messageOf;
using pcl6d::test::replaceText;
using pcl6d::test::TempFolder;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace {
const std::string kTwo = "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 0 0 0 0 0 0\n";
const std::string kEdge = "EDGE3 0 1 0 0 0 0 0 0";

void
expectMessage(const std::string& content, const std::string& message)
{
  const TempFolder folder;
  const auto path = folder / "graph.g2o";
  replaceText(path, content);
  expectIoFailed(path, message, [&] { readPoseGraph(path); });
}

/** A chain of three poses with unit information. */
PoseGraph
chain()
{
  PoseGraph graph;
  pcl6d::Random random(3);
  for (std::size_t i = 0; i < 3; ++i)
    graph.poses.push_back(pcl6d::test::randomPose(random, 5, 1));
  for (std::size_t i = 0; i < 2; ++i)
    graph.links.push_back(
        {i, i + 1, graph.poses[i].inverse() * graph.poses[i + 1], Matrix6::Identity()});
  return graph;
}
} // namespace

TEST(PoseGraphErrors, NameTheLineAndItsWords)
{
  expectMessage("", "holds no pose");
  expectMessage("# nothing\n\n", "holds no pose");
  expectMessage(
      "VERTEX_SIM3 0 0 0 0\n",
      "line 1: 'VERTEX_SIM3' starts no line of a 3D pose graph; known are "
      "VERTEX_SE3:QUAT, EDGE_SE3:QUAT, VERTEX_SE2, EDGE_SE2, FIX (g2o), VERTEX3, "
      "EDGE3 (TORO)");
  expectMessage(kTwo + "VERTEX_XY 7 0 0\n",
                "line 3: 'VERTEX_XY' is not a pose, link or constraint; --skip-unknown "
                "leaves unknown lines out");
  expectMessage("PARAMS_SE3OFFSET 0 1\n",
                "line 1: expected 8 numbers after PARAMS_SE3OFFSET, got 2");
  expectMessage("VERTEX3 0 0 0 0 0 0\n",
                "line 1: expected 7 numbers after VERTEX3, got 6");
  expectMessage("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1 5\n",
                "line 1: expected 8 numbers after VERTEX_SE3:QUAT, got 9");
  expectMessage(kTwo + kEdge + " 1 0\n",
                "line 3: expected 29 numbers after EDGE3, got 10");
  expectMessage("VERTEX3 0 0 0 x 0 0 0\n", "line 1: 'x' is not a number");
  const TempFolder folder;
  expectIoFailed(folder / "missing", "No such file or directory", [&] {
    readPoseGraph(folder / "missing");
  });
}

TEST(PoseGraphErrors, NameVerticesThatAreNone)
{
  expectMessage("VERTEX3 -1 0 0 0 0 0 0\n", "line 1: '-1' is not a vertex id");
  expectMessage("VERTEX3 1.5 0 0 0 0 0 0\n", "line 1: '1.5' is not a vertex id");
  expectMessage(kTwo + "VERTEX3 1 0 0 0 0 0 0\n", "line 3: vertex 1 is given twice");
  expectMessage(kTwo + "EDGE3 0 2 0 0 0 0 0 0" + kUnitInformation,
                "line 3: there is no vertex 2");
  expectMessage(kTwo + "EDGE3 1 1 0 0 0 0 0 0" + kUnitInformation,
                "line 3: a link from vertex 1 to itself");
  expectMessage(kTwo + "FIX 4\n", "line 3: there is no vertex 4");
  expectMessage(kTwo + "FIX\n", "line 3: expected a vertex id after FIX");
}

TEST(PoseGraphErrors, NameMotionsThatAreNone)
{
  expectMessage("VERTEX3 0 0 0 nan 0 0 0\n",
                "line 1: not a rigid motion (a number is not finite)");
  expectMessage("VERTEX3 0 0 0 0 0 1e300 0\n",
                "line 1: not a rigid motion (a number is not finite)");
  expectMessage("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n",
                "line 1: not a rigid motion (the quaternion has norm 0, but must have "
                "1)");
}

TEST(PoseGraphErrors, NameInformationThatIsNone)
{
  const std::string indefinite =
      "line 3: the information matrix is not positive semidefinite";
  expectMessage(kTwo + kEdge + " -1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n",
                indefinite);
  expectMessage(kTwo + kEdge + " 1 2 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n",
                indefinite);
  expectMessage(kTwo + kEdge + " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 inf 0 0 1 0 1\n",
                "line 3: the information matrix is not finite");
}

TEST(PoseGraphErrors, NameChainsThatLeaveAllPlaces)
{
  const std::string far = " 9e8 0 0 0 0 0" + kUnitInformation;
  expectMessage("EDGE3 0 1" + far + "EDGE3 1 2" + far,
                "the links to vertex 2 add up to a position 1e9 m or farther from the "
                "origin");
  expectMessage("EDGE3 10 20" + far + "EDGE3 20 30" + far,
                "the links to vertex 30 add up to a position 1e9 m or farther from the "
                "origin");
}

TEST(PoseGraphErrors, DigitsLostInInformationAreRepaired)
{
  const TempFolder folder;
  replaceText(folder / "graph",
              kTwo + kEdge + " 1 1.0000001 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
  const Matrix6 I = readPoseGraph(folder / "graph").links[0].information;
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(I);
  EXPECT_GT(solver.eigenvalues()(0), -1e-15);
  EXPECT_NEAR(I(0, 1), 1, 1e-6);
}

TEST(PoseGraphErrors, GraphsThatAreNoneAreTheCallersMistake)
{
  const TempFolder folder;
  const auto messageOfWriting = [&](const auto& spoil) {
    PoseGraph graph = chain();
    spoil(graph);
    for (const auto write : {&writePoseGraphToro, &writePoseGraphG2o})
      EXPECT_THROW(write(folder / "graph", graph), pcl6d::BadArgument);
    return messageOf<pcl6d::BadArgument>(
        [&] { writePoseGraphG2o(folder / "graph", graph); });
  };
  EXPECT_EQ(messageOfWriting([](auto& g) { g = PoseGraph(); }),
            "a pose graph needs a pose");
  EXPECT_EQ(messageOfWriting([](auto& g) {
              g.ids = {1, 2};
            }),
            "a pose graph needs an id per pose, but has 2 ids and 3 poses");
  EXPECT_EQ(messageOfWriting([](auto& g) {
              g.ids = {7, 5, 7};
            }),
            "id 7 is given twice");
  EXPECT_EQ(messageOfWriting([](auto& g) { g.poses[1].linear() *= 3; }),
            "pose 1 is no rigid motion");
  EXPECT_EQ(messageOfWriting([](auto& g) { g.poses[2](0, 3) = INFINITY; }),
            "pose 2 is no rigid motion");
  EXPECT_EQ(messageOfWriting([](auto& g) { g.links[1].to = 3; }),
            "link 1 joins poses 1 and 3, but there are only 3 poses");
  EXPECT_EQ(messageOfWriting([](auto& g) { g.links[1].to = 1; }),
            "link 1 joins pose 1 with itself");
  EXPECT_EQ(messageOfWriting([](auto& g) { g.links[0].T_from_to(0, 3) = NAN; }),
            "link 0 measures no rigid motion");
  EXPECT_EQ(messageOfWriting([](auto& g) { g.links[0].information *= -1; }),
            "link 0 has information that is not positive semidefinite");
  EXPECT_EQ(messageOfWriting([](auto& g) { g.links[0].information(2, 3) = NAN; }),
            "link 0 has information that is not finite");
  EXPECT_TRUE(pcl6d::test::namesIn(folder.path()).empty());
}
