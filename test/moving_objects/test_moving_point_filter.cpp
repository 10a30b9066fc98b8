// SPDX-License-Identifier: BSD-3-Clause
#include "moving_room.h"
#include "support/clouds.h"
#include "support/points.h"

#include <pcl6d/moving_objects/pcl/moving_point_filter.h>

namespace pcl6d {
namespace {

using namespace test;

constexpr std::size_t kScans = 4, kScan = 2;

const std::vector<TrueScan>&
scene()
{
  static const std::vector<TrueScan> scans = [] {
    MovingRoom room;
    room.step = 0.03;
    auto made = scansOf(room, kScans, [](std::size_t i) {
      return std::vector<Body>{walker(-3.5 + 1.2 * static_cast<double>(i), 2.2)};
    });
    made[kScan].points[7].x() = kNan;
    return made;
  }();
  return scans;
}

template <typename PointT>
class MovingPointFilters : public testing::Test {
protected:
  MovingPointFilters()
  {
    for (const TrueScan& scan : scene()) {
      clouds_.push_back(toCloud<PointT>(scan.points));
      filter_.addScan(clouds_.back(), scan.T_world_scan);
    }
  }
  pcl::Indices
  kept()
  {
    pcl::Indices indices;
    filter_.filter(indices);
    return indices;
  }
  /** \return those of which the core tells the same, without NaN */
  pcl::Indices
  expected(bool moving)
  {
    const auto motion = motionOf(scene())[kScan];
    pcl::Indices indices;
    for (std::size_t i = 0; i < motion.size(); ++i)
      if (scene()[kScan].points[i].allFinite() &&
          (motion[i] == PointMotion::kDynamic) == moving)
        indices.push_back(static_cast<pcl::index_t>(i));
    return indices;
  }

  std::vector<typename pcl::PointCloud<PointT>::Ptr> clouds_;
  MovingPointFilter<PointT> filter_{true};
};

using PointTypes = testing::Types<pcl::PointXYZ,
                                  pcl::PointXYZI,
                                  pcl::PointXYZRGB,
                                  pcl::PointNormal,
                                  pcl::PointXYZINormal>;
TYPED_TEST_SUITE(MovingPointFilters, PointTypes);

TYPED_TEST(MovingPointFilters, KeepWhatStandsOrMoves)
{
  this->filter_.setInputScan(kScan);
  EXPECT_EQ(this->kept(), this->expected(false));
  this->filter_.setNegative(true);
  EXPECT_EQ(this->kept(), this->expected(true));
  EXPECT_GT(this->kept().size(), 50u);
}

using MovingPointFilterTest = MovingPointFilters<pcl::PointXYZI>;

TEST_F(MovingPointFilterTest, KnowsTheCloudsThatWereAdded)
{
  filter_.setInputScan(0);
  filter_.setInputCloud(clouds_[kScan]);
  EXPECT_EQ(kept(), expected(false));
}

TEST_F(MovingPointFilterTest, TellsTheMotionOfAScan)
{
  EXPECT_EQ(filter_.motion(kScan), motionOf(scene())[kScan]);
  EXPECT_EQ(filter_.size(), kScans);
  EXPECT_FALSE(filter_.isBlind());
}

TEST_F(MovingPointFilterTest, FiltersCloudsWithTheirFieldsAsAPclFilter)
{
  for (std::size_t i = 0; i < clouds_[kScan]->size(); ++i)
    (*clouds_[kScan])[i].intensity = static_cast<float>(i);
  filter_.setInputScan(kScan);
  pcl::Filter<pcl::PointXYZI>& filter = filter_;
  pcl::PointCloud<pcl::PointXYZI> output;
  filter.filter(output);
  const pcl::Indices expected = this->expected(false);
  ASSERT_EQ(output.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    ASSERT_EQ(output[k].intensity, static_cast<float>(expected[k]));
}

TEST_F(MovingPointFilterTest, KeepsCloudsOrganized)
{
  filter_.setInputScan(kScan);
  filter_.setKeepOrganized(true);
  pcl::PointCloud<pcl::PointXYZI> output;
  filter_.filter(output);
  const auto motion = filter_.motion(kScan);
  ASSERT_EQ(output.size(), motion.size());
  for (std::size_t i = 0; i < motion.size(); ++i)
    ASSERT_EQ(std::isnan(output[i].x), motion[i] == PointMotion::kDynamic || i == 7);
}

TEST_F(MovingPointFilterTest, LooksAtAllPointsButPassesTheChosen)
{
  filter_.setInputScan(kScan);
  pcl::Indices chosen;
  for (std::size_t i = 0; i < clouds_[kScan]->size(); i += 3)
    chosen.push_back(static_cast<pcl::index_t>(i));
  filter_.setIndices(pcl::make_shared<pcl::Indices>(chosen));
  pcl::Indices among;
  for (const auto index : expected(false))
    if (index % 3 == 0)
      among.push_back(index);
  EXPECT_EQ(kept(), among);
  EXPECT_EQ(filter_.getRemovedIndices()->size(), chosen.size() - among.size());
  filter_.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{-1}));
  EXPECT_NE(badArgumentOf([&] { kept(); }).find("index = -1"), std::string::npos);
}

TEST_F(MovingPointFilterTest, FiltersOtherPointsOfAScan)
{
  const auto part = toCloud<pcl::PointXYZI>(
      Points(scene()[kScan].points.begin(), scene()[kScan].points.end() - 5));
  EXPECT_NE(badArgumentOf([&] {
              filter_.setInputCloud(part);
              kept();
            }).find("input cloud = another"),
            std::string::npos);
  filter_.setInputScan(kScan, part);
  EXPECT_GT(kept().size(), part->size() / 2);
  EXPECT_LT(kept().size(), part->size());
}

TEST_F(MovingPointFilterTest, TakesTheScannerToBeAtTheSensorsOrigin)
{
  const Eigen::Vector3f origin(2, -1, 0.5);
  MovingPointFilter<pcl::PointXYZI> by_cloud, by_setter, wrong;
  by_setter.setOrigin(origin);
  wrong.setOrigin(Eigen::Vector3f(0, 0, 0));
  for (const TrueScan& scan : scene()) {
    Points points = scan.points;
    for (Eigen::Vector3f& p : points)
      p += origin;
    const auto cloud = toCloud<pcl::PointXYZI>(points);
    Eigen::Isometry3d T = scan.T_world_scan;
    T.translate(-origin.cast<double>());
    by_setter.addScan(cloud, T);
    cloud->sensor_origin_.head<3>() = origin;
    by_cloud.addScan(cloud, T);
    wrong.addScan(cloud, T);
  }
  EXPECT_EQ(by_setter.motion(kScan), by_cloud.motion(kScan));
  const auto shifted = by_cloud.motion(kScan), plain = filter_.motion(kScan);
  std::size_t other = 0;
  for (std::size_t i = 0; i < plain.size(); ++i)
    other += plain[i] != shifted[i] ? 1 : 0;
  EXPECT_LT(other, plain.size() / 1000) << "rounded to 1e-7 m";
  EXPECT_NE(wrong.motion(kScan), shifted) << "rays from elsewhere say other things";
}

TEST_F(MovingPointFilterTest, PassesTheVoxelAndTheThreadsOn)
{
  MovingPointFilter<pcl::PointXYZI> filter;
  EXPECT_NE(badArgumentOf([&] { filter.setVoxel(-1); }).find("voxel = -1"),
            std::string::npos);
  filter.setVoxel(0.3);
  filter.setNumberOfThreads(1);
  for (const auto& scan : scene())
    filter.addScan(toCloud<pcl::PointXYZI>(scan.points), scan.T_world_scan);
  EXPECT_EQ(filter.motion(kScan), motionOf(scene(), {}, 0.3)[kScan]);
}

TEST_F(MovingPointFilterTest, RefusesWhatBreaksARule)
{
  EXPECT_NE(badArgumentOf([&] {
              filter_.addScan(nullptr, Eigen::Isometry3d::Identity());
            }).find("cloud of the scan = null"),
            std::string::npos);
  Eigen::Isometry3d bent = Eigen::Isometry3d::Identity();
  bent.linear() *= 2;
  EXPECT_NE(badArgumentOf([&] { filter_.addScan(clouds_[0], bent); }), "");
  EXPECT_EQ(filter_.size(), kScans);
  EXPECT_EQ(badArgumentOf([&] { filter_.setInputScan(kScans); }),
            "scan = 4, but must be one of 4");
  EXPECT_EQ(badArgumentOf([&] { (void)filter_.motion(kScans); }),
            "scan = 4, but must be one of 4");
  EXPECT_NE(badArgumentOf([&] { filter_.setInputScan(0, nullptr); }).find("null"),
            std::string::npos);
}

TEST(MovingPointFilter, WithoutAnInputKeepsNothing)
{
  MovingPointFilter<pcl::PointXYZ> filter;
  pcl::Indices indices;
  filter.filter(indices);
  EXPECT_TRUE(indices.empty());
}

TEST(MovingPointFilter, KeepsAllOfTheOnlyScan)
{
  MovingPointFilter<pcl::PointXYZ> filter;
  const auto cloud = toCloud<pcl::PointXYZ>(scene()[0].points);
  filter.addScan(cloud, Eigen::Isometry3d::Identity());
  filter.setInputScan(0);
  pcl::Indices indices;
  filter.filter(indices);
  EXPECT_EQ(indices.size(), cloud->size());
}

} // namespace
} // namespace pcl6d
