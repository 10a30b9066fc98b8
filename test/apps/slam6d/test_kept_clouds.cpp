// SPDX-License-Identifier: BSD-3-Clause
// Clouds between reading and writing: in memory as far as the budget goes, read again beyond.
#include "slam6d/input/kept_clouds.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <fstream>

namespace {
using pcl6d::app::KeptClouds;
using pcl6d::app::RunScans;

void
writeXyz(const std::filesystem::path& file, int points)
{
  std::ofstream out(file);
  for (int i = 0; i < points; ++i)
    out << i << " 2 0.5\n";
}

/** Three scans of 10, 20 and 30 points. */
class KeptCloudsTest : public testing::Test {
protected:
  KeptCloudsTest()
  {
    for (int i = 0; i < 3; ++i)
      writeXyz(path_ / ("scan00" + std::to_string(i) + ".xyz"), 10 * (i + 1));
  }

  /** \return the sizes in bytes of the clouds that are read, with so much memory for them */
  std::vector<std::size_t>
  keepAll(KeptClouds& clouds, RunScans& scans)
  {
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < 3; ++i) {
      pcl::PCLPointCloud2 cloud = scans.read(i).cloud;
      sizes.push_back(cloud.data.size());
      clouds.add(std::move(cloud));
    }
    return sizes;
  }

  void
  removeFile(int i)
  {
    std::filesystem::remove(path_ / ("scan00" + std::to_string(i) + ".xyz"));
  }

  pcl6d::test::TempFolder path_;
};
} // namespace

TEST_F(KeptCloudsTest, AreTheSameWithAnyBudget)
{
  const pcl6d::ScanFolder folder(path_.path());
  RunScans scans(folder);
  for (const std::size_t budget :
       {std::size_t{0}, std::size_t{200}, std::size_t{1000000}}) {
    KeptClouds clouds(scans, budget);
    keepAll(clouds, scans);
    ASSERT_EQ(clouds.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(clouds.take(i).data, scans.read(i).cloud.data) << budget;
  }
}

TEST_F(KeptCloudsTest, ThoseWithinTheBudgetNeedNoFile)
{
  const pcl6d::ScanFolder folder(path_.path());
  RunScans scans(folder);
  pcl::PCLPointCloud2 first = scans.read(0).cloud;
  KeptClouds clouds(scans, first.data.size());
  const auto sizes = keepAll(clouds, scans);
  ASSERT_EQ(sizes[0], first.data.size());
  removeFile(0);
  removeFile(1);
  EXPECT_EQ(clouds.take(0).data, first.data);
  EXPECT_THROW(clouds.take(1), pcl6d::IoFailed);
}

TEST_F(KeptCloudsTest, NameAFileThatHasChangedMeanwhile)
{
  const pcl6d::ScanFolder folder(path_.path());
  RunScans scans(folder);
  KeptClouds clouds(scans, 0);
  keepAll(clouds, scans);
  std::ofstream(path_ / "scan002.xyz", std::ios::in) << "0 3 0.5"; // as many points
  try {
    clouds.take(2);
    FAIL() << "a changed file was taken";
  } catch (const pcl6d::IoFailed& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("scan002.xyz: was changed after the first reading"),
              std::string::npos)
        << message;
  }
}
