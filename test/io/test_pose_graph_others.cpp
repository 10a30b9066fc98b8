// SPDX-License-Identifier: BSD-3-Clause
// Rows of g2o beside those of poses and links in space.
#include "io_test.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/pose_graph_io.h>

using pcl6d::PoseGraphFile;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {

class GraphOfOthers : public testing::Test {
protected:
  PoseGraphFile
  read(const std::string& rows, bool skip_unknown = false)
  {
    writeText(file_, rows);
    pcl6d::PoseGraphReaderOptions options;
    options.skip_unknown = skip_unknown;
    return pcl6d::readPoseGraphFile(file_, options);
  }
  TempFolder folder_;
  const std::filesystem::path file_ = folder_ / "a.g2o";
};

const std::string kPlane = "VERTEX_SE2 4 0 0 0\nVERTEX_SE2 9 1 2 0.5\n"
                           "EDGE_SE2 4 9 1 2 0.5 10 1 2 20 3 40\n";
} // namespace

TEST_F(GraphOfOthers, PlanarPosesAndLinksLieInThePlane)
{
  const auto graph = read(kPlane).graph;
  ASSERT_EQ(graph.poses.size(), 2U);
  EXPECT_TRUE(graph.poses[1].isApprox(pcl6d::planarPose(1, 2, 0.5), 1e-15));
  ASSERT_EQ(graph.links.size(), 1U);
  EXPECT_TRUE(graph.links[0].T_from_to.isApprox(pcl6d::planarPose(1, 2, 0.5), 1e-15));
  const auto& information = graph.links[0].information;
  EXPECT_EQ(information(0, 0), 10);
  EXPECT_EQ(information(0, 1), 1);
  EXPECT_EQ(information(0, 5), 2);
  EXPECT_EQ(information(1, 1), 20);
  EXPECT_EQ(information(5, 1), 3);
  EXPECT_EQ(information(5, 5), 40);
  EXPECT_EQ(information(2, 2), 15);
  EXPECT_EQ(information(3, 3), 40);
  EXPECT_EQ(information(2, 5), 0);
}

TEST_F(GraphOfOthers, FixedPosesAreKept)
{
  const auto file = read(kPlane + "FIX 9\n");
  EXPECT_EQ(file.constraints.fixed, (std::vector<std::size_t>{1}));
  pcl6d::writePoseGraph(
      folder_ / "b.g2o", file.graph, pcl6d::PoseGraphFormat::kG2o, file.constraints);
  const auto back = pcl6d::readPoseGraphFile(folder_ / "b.g2o");
  EXPECT_EQ(back.constraints.fixed, file.constraints.fixed);
  EXPECT_EQ(back.graph.ids, (std::vector<std::size_t>{4, 9}));
  pcl6d::GraphConstraints beyond;
  beyond.fixed = {2};
  EXPECT_THROW(pcl6d::writePoseGraph(
                   folder_ / "c.g2o", file.graph, pcl6d::PoseGraphFormat::kG2o, beyond),
               pcl6d::BadArgument);
}

TEST_F(GraphOfOthers, WhatCannotBeUsedIsCountedAndLeftOut)
{
  const std::string others =
      "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\nVERTEX_XY 20 1 2\n"
      "EDGE_SE2_XY 4 20 1 2 1 0 1\nVERTEX_XY 21 1 2\nSOMETHING else\n";
  const auto file = read(kPlane + others, true);
  EXPECT_EQ(file.skipped,
            (std::vector<std::string>{
                "2 lines VERTEX_XY", "1 line EDGE_SE2_XY", "1 line SOMETHING"}));
  EXPECT_EQ(file.graph.poses.size(), 2U);
  EXPECT_THROW(read(kPlane + others), pcl6d::IoFailed);
  EXPECT_TRUE(read(kPlane + "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n").skipped.empty());
}

TEST_F(GraphOfOthers, PlanarRowsThatAreBrokenAreNamed)
{
  pcl6d::test::expectIoFailed(file_,
                              "line 1: expected 4 numbers after VERTEX_SE2, got 3",
                              [&] { read("VERTEX_SE2 0 1 2\n"); });
  EXPECT_THROW(read("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\n"
                    "EDGE_SE2 0 1 0 0 0 -1 0 0 1 0 1\n"),
               pcl6d::IoFailed);
}
