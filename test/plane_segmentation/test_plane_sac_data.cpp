// SPDX-License-Identifier: BSD-3-Clause
// PlaneSACSegmentation beside pcl::SACSegmentation on recorded clouds.
#include "support/data_folder.h"

#include <pcl6d/plane_segmentation/pcl/plane_sac_segmentation.h>

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <string>

namespace {
using namespace pcl6d;
using Point = pcl::PointXYZ;

struct Recorded {
  std::string folder, file;
};

class RecordedPlanes : public testing::TestWithParam<Recorded> {
protected:
  pcl::PointCloud<Point>::Ptr cloud_ = pcl::make_shared<pcl::PointCloud<Point>>();
};

template <typename Segmentation>
pcl::ModelCoefficients
planeIn(const pcl::PointCloud<Point>::ConstPtr& cloud,
        double threshold,
        bool optimize,
        std::size_t& inliers)
{
  Segmentation segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(threshold);
  segmentation.setOptimizeCoefficients(optimize);
  segmentation.setInputCloud(cloud);
  pcl::PointIndices found;
  pcl::ModelCoefficients plane;
  segmentation.segment(found, plane);
  inliers = found.indices.size();
  return plane;
}
} // namespace

TEST_P(RecordedPlanes, HaveAtLeastAsManyInliersAsPcls)
{
  PCL6D_DATA_OR_SKIP(folder, GetParam().folder);
  ASSERT_EQ(pcl::io::loadPCDFile((folder / GetParam().file).string(), *cloud_), 0);
  for (const double threshold : {0.01, 0.02, 0.05})
    for (const bool optimize : {true, false}) {
      SCOPED_TRACE(std::to_string(threshold) + (optimize ? " optimized" : ""));
      std::size_t ours = 0, theirs = 0;
      planeIn<PlaneSACSegmentation<Point>>(cloud_, threshold, optimize, ours);
      planeIn<pcl::SACSegmentation<Point>>(cloud_, threshold, optimize, theirs);
      EXPECT_GE(ours, theirs);
    }
}

INSTANTIATE_TEST_SUITE_P(Clouds,
                         RecordedPlanes,
                         testing::Values(Recorded{"pcl", "bun0.pcd"},
                                         Recorded{"pcl", "bun4.pcd"},
                                         Recorded{"pcl", "sac_plane_test.pcd"},
                                         Recorded{"pcl", "milk_color.pcd"},
                                         Recorded{"objects",
                                                  "milk_cartoon_all_small_clorox.pcd"},
                                         Recorded{"rooms", "room_scan1.pcd"},
                                         Recorded{"handheld", "scan000.pcd"}),
                         [](const auto& tested) {
                           return tested.param.folder + std::to_string(tested.index);
                         });

TEST(RecordedPlane, IsThatOfPclsTestOfPlaneModels)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  auto cloud = pcl::make_shared<pcl::PointCloud<Point>>();
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "sac_plane_test.pcd").string(), *cloud), 0);
  std::size_t inliers = 0;
  const auto plane =
      planeIn<PlaneSACSegmentation<Point>>(cloud, 0.02, true, inliers).values;
  ASSERT_EQ(plane.size(), 4u);
  EXPECT_GT(inliers, 2000u);
  // What that test expects, and its tolerance.
  constexpr float kExpected[] = {-0.8964f, -0.5868f, -1.208f};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(plane[i] / plane[3], kExpected[i], 1e-2f);
}
