// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"

#include <pcl6d/io/scan_fields.h>

using pcl6d::BadArgument;
using pcl6d::fieldValues;
using pcl6d::Points;
using pcl6d::storeCoordinates;
using pcl6d::test::makeRichCloud;
using pcl6d::test::messageOf;
using pcl6d::test::valueOf;

TEST(ScanFields, ValuesOfAllTypesBecomeNumbers)
{
  const auto cloud = makeRichCloud(3);
  const auto time = fieldValues(cloud, "time");
  ASSERT_TRUE(time);
  EXPECT_EQ(time->name, "time");
  EXPECT_FALSE(time->is_integer);
  ASSERT_EQ(time->values.size(), 3u);
  EXPECT_EQ(time->values[2], 1317384506.40528 + 0.1 * 2); // all bits of a double
  const auto label = fieldValues(cloud, "label");
  ASSERT_TRUE(label);
  EXPECT_TRUE(label->is_integer);
  EXPECT_EQ(label->values, (std::vector<double>{4000000000, 4000000001, 4000000002}));
  EXPECT_EQ(fieldValues(cloud, "tilt")->values,
            (std::vector<double>{-300, -301, -302}));
  EXPECT_EQ(fieldValues(cloud, "ring")->values, (std::vector<double>{200, 201, 202}));
  EXPECT_FALSE(fieldValues(cloud, "t"));
  EXPECT_TRUE(fieldValues(makeRichCloud(0), "time")->values.empty());
}

TEST(ScanFields, CoordinatesAreReplacedAndNothingElse)
{
  auto cloud = makeRichCloud(3);
  const auto before = cloud;
  const Points points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  storeCoordinates(points, cloud);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(valueOf<float>(cloud, i, "x"), points[i].x());
    EXPECT_EQ(valueOf<float>(cloud, i, "y"), points[i].y());
    EXPECT_EQ(valueOf<float>(cloud, i, "z"), points[i].z());
    EXPECT_TRUE(std::equal(cloud.data.begin() + 56 * i + 12,
                           cloud.data.begin() + 56 * (i + 1),
                           before.data.begin() + 56 * i + 12));
  }
}

TEST(ScanFields, AFieldIsAppendedToEveryPoint)
{
  auto cloud = makeRichCloud(3);
  pcl6d::addField(cloud, "t", pcl::PCLPointField::FLOAT32, {0, 0.1, 0.25});
  EXPECT_EQ(cloud.point_step, 60u);
  EXPECT_EQ(cloud.row_step, 180u);
  EXPECT_EQ(cloud.data.size(), 180u);
  EXPECT_EQ(valueOf<float>(cloud, 1, "t"), 0.1f);
  EXPECT_EQ(fieldValues(cloud, "t")->values, (std::vector<double>{0, 0.1f, 0.25}));
  auto expected = makeRichCloud(3);
  cloud.fields.pop_back();
  pcl6d::test::expectSameFields(cloud, expected);
  const auto add = [&](const std::string& name, std::size_t count) {
    pcl6d::addField(
        expected, name, pcl::PCLPointField::FLOAT32, std::vector<double>(count, 0));
  };
  EXPECT_THROW(add("time", 3), BadArgument);
  EXPECT_THROW(add("t", 2), BadArgument);
}

TEST(ScanFields, RefusesCloudsThatDoNotFit)
{
  auto cloud = makeRichCloud(3);
  EXPECT_THROW(storeCoordinates(Points(2), cloud), BadArgument);
  auto without_z = cloud;
  without_z.fields[2].name = "zed";
  EXPECT_EQ(messageOf<BadArgument>([&] { storeCoordinates(Points(3), without_z); }),
            "field = z, but must be in the cloud");
  auto of_integers = cloud;
  of_integers.fields[0].datatype = pcl::PCLPointField::INT32;
  EXPECT_THROW(storeCoordinates(Points(3), of_integers), BadArgument);
  auto beyond = cloud;
  beyond.fields[9].offset = 55; // two bytes of 56
  EXPECT_THROW(fieldValues(beyond, "tilt"), BadArgument);
  cloud.data.resize(100);
  EXPECT_THROW(fieldValues(cloud, "time"), BadArgument);
}
