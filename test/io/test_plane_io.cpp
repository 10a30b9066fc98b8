// SPDX-License-Identifier: BSD-3-Clause
#include "../support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/plane_io.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace {
using pcl6d::Plane;
using pcl6d::test::TempFolder;

std::vector<Plane>
twoPlanes()
{
  Plane floor;
  floor.offset = 1.0 / 3;
  floor.label = "floor";
  floor.hull = {{0, 0, 0.25}, {0.1, 0, 0.25}, {0, 2, 0.25}};
  floor.area = 0.1;
  floor.inliers = 12345;
  floor.rms = 0.0123456789012345678;
  Plane stairs;
  stairs.normal = Eigen::Vector3d(1, 2, 3).normalized();
  stairs.label = "stairs, \"own\" word";
  return {floor, stairs};
}

std::string
messageOf(const std::filesystem::path& path)
{
  try {
    pcl6d::readPlanes(path);
  } catch (const pcl6d::IoFailed& error) {
    return error.what();
  }
  return "";
}
} // namespace

TEST(PlaneIo, ReadsBackEveryBitOfWhatItWrote)
{
  const TempFolder folder;
  pcl6d::writePlanes(folder.path() / "planes.json", twoPlanes(), {0.5, "a program"});
  const auto planes = pcl6d::readPlanes(folder.path() / "planes.json");
  const auto wanted = twoPlanes();
  ASSERT_EQ(planes.size(), wanted.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    EXPECT_EQ(planes[i].normal, wanted[i].normal);
    EXPECT_EQ(planes[i].offset, wanted[i].offset);
    EXPECT_EQ(planes[i].label, wanted[i].label);
    EXPECT_EQ(planes[i].hull, wanted[i].hull);
    EXPECT_EQ(planes[i].area, wanted[i].area);
    EXPECT_EQ(planes[i].inliers, wanted[i].inliers);
    EXPECT_EQ(planes[i].rms, wanted[i].rms);
  }
}

TEST(PlaneIo, WritesTheOriginOnlyIfGiven)
{
  const TempFolder folder;
  const auto textOf = [&](const pcl6d::PlaneOrigin& origin) {
    pcl6d::writePlanes(folder.path() / "planes.json", {}, origin);
    std::ostringstream text;
    text << std::ifstream(folder.path() / "planes.json").rdbuf();
    return text.str();
  };
  EXPECT_NE(textOf({0.25, ""}).find("\"seconds\": 0.25"), std::string::npos);
  EXPECT_NE(textOf({{}, "me"}).find("\"generator\": \"me\""), std::string::npos);
  EXPECT_EQ(textOf({}).find("seconds"), std::string::npos);
  EXPECT_EQ(textOf({}).find("generator"), std::string::npos);
}

TEST(PlaneIo, NamesThePlaneAndTheFieldThatIsWrong)
{
  const TempFolder folder;
  const auto path = folder.path() / "planes.json";
  const auto messageFor = [&](const std::string& text) {
    std::ofstream(path) << text;
    return messageOf(path);
  };
  EXPECT_NE(messageFor("{").find("line 1: not the syntax of JSON"), std::string::npos);
  EXPECT_NE(messageFor("{}").find("'planes'"), std::string::npos);
  pcl6d::writePlanes(path, twoPlanes());
  std::ostringstream good;
  good << std::ifstream(path).rdbuf();
  std::string text = good.str();
  text.replace(text.find("\"area\": 0.0"), 6, "\"aera\"");
  EXPECT_NE(messageFor(text).find("/planes/1: key 'area' is missing"),
            std::string::npos);
  EXPECT_NE(messageFor(R"({"planes": [{"normal": [0, 0]}]})")
                .find("/planes/0/normal: expected 3 numbers, got 2"),
            std::string::npos);
  text = good.str();
  text.replace(text.find("1.0"), 3, "2.0");
  EXPECT_NE(messageFor(text).find("/planes/0/normal: has length 2"), std::string::npos);
  EXPECT_NE(messageOf(folder.path() / "none.json").find("none.json"),
            std::string::npos);
}
