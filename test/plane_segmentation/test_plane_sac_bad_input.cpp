// SPDX-License-Identifier: BSD-3-Clause
#include "sac_clouds.h"

#include <pcl6d/common/error.h>
#include <pcl6d/plane_segmentation/pcl/plane_sac_segmentation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {
using namespace pcl6d;
using namespace pcl6d::test;
using Point = pcl::PointXYZ;
using NormalCloud = pcl::PointCloud<pcl::Normal>;
} // namespace

TEST(PlaneSacBadInput, TellsWhatIsWrong)
{
  const auto cloud = sacCloud(table());
  const auto refuse = [&](const char* words, auto change) {
    PlaneSACSegmentation<Point> segmentation;
    choose(segmentation, pcl::SACMODEL_PLANE);
    segmentation.setInputCloud(cloud);
    change(segmentation);
    try {
      segmented(segmentation);
      ADD_FAILURE() << words << " was not refused";
    } catch (const BadArgument& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos)
          << error.what();
    }
  };
  refuse("input cloud", [](auto& s) { s.setInputCloud(nullptr); });
  refuse("model type", [](auto& s) { s.setModelType(-1); });
  refuse("model type", [](auto& s) { s.setModelType(pcl::SACMODEL_LINE); });
  refuse("model type", [](auto& s) { s.setModelType(pcl::SACMODEL_NORMAL_PLANE); });
  refuse("method type", [](auto& s) { s.setMethodType(7); });
  refuse("distance threshold", [](auto& s) { s.setDistanceThreshold(0); });
  refuse("distance threshold", [](auto& s) { s.setDistanceThreshold(std::nan("")); });
  refuse("iterations", [](auto& s) { s.setMaxIterations(-2); });
  refuse("probability", [](auto& s) { s.setProbability(2); });
  refuse("eps angle", [](auto& s) { s.setEpsAngle(-1); });
  refuse("axis", [](auto& s) {
    s.setModelType(pcl::SACMODEL_PARALLEL_PLANE);
    s.setEpsAngle(0.1); // and no axis
  });
  refuse("search for samples", [](auto& s) { s.setSamplesMaxDist(0.1, nullptr); });
  refuse("index", [](auto& s) {
    s.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 1, 2, 1 << 20}));
  });
  refuse("index", [](auto& s) {
    s.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 1, 2, -1}));
  });
}

TEST(PlaneSacBadInput, TellsWhatIsWrongWithNormals)
{
  const auto cloud = sacCloud(table());
  PlaneSACSegmentationFromNormals<Point, pcl::Normal> segmentation;
  choose(segmentation, pcl::SACMODEL_NORMAL_PARALLEL_PLANE);
  segmentation.setInputCloud(cloud);
  EXPECT_THROW(segmented(segmentation), BadArgument); // none
  const auto normals = pcl::make_shared<NormalCloud>();
  segmentation.setInputNormals(normals);
  EXPECT_THROW(segmented(segmentation), BadArgument); // too few
  normals->resize(cloud->size());                     // all zero: no point has one
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  EXPECT_TRUE(segmented(segmentation).inliers.indices.empty());
  pcl::console::setVerbosityLevel(pcl::console::L_INFO);
  for (auto& n : *normals)
    n.normal_z = 1;
  EXPECT_GE(segmented(segmentation).inliers.indices.size(), 2900u);
  segmentation.setDistanceFromOrigin(1);
  EXPECT_THROW(segmented(segmentation), BadArgument);
  segmentation.setDistanceFromOrigin(0);
  segmentation.setNormalDistanceWeight(1.5);
  EXPECT_THROW(segmented(segmentation), BadArgument);
}
