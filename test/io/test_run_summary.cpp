// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/poses.h"

#include <pcl6d/io/run_summary.h>

using pcl6d::readRunSummary;
using pcl6d::RunSummary;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;

namespace {
RunSummary
makeSummary()
{
  pcl6d::Random random(1);
  RunSummary summary;
  summary.generator = "pcl_slam6d";
  summary.version = "1.2.3";
  summary.world_offset = {691234, -5336789, 100};
  summary.options = {{"min-range", "0.25", "derived", "a tenth"},
                     {"voxel", "0.1", "given", ""}};
  for (const char* const file : {"scan000.pcd", "scan ü1.pcd"}) {
    RunSummary::ScanEntry scan;
    scan.file = file;
    scan.T_world_scan = pcl6d::test::randomPose(random, 1e6, 2);
    summary.scans.push_back(scan);
  }
  summary.complete = false;
  return summary;
}
} // namespace

TEST(RunSummary, IsReadAsItWasWritten)
{
  const TempFolder folder;
  const RunSummary written = makeSummary();
  writeRunSummary(folder / "summary.json", written);
  const RunSummary read = readRunSummary(folder / "summary.json");
  EXPECT_EQ(read.generator, written.generator);
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.world_offset, written.world_offset);
  EXPECT_FALSE(read.complete);
  EXPECT_TRUE(read.trusted);
  ASSERT_EQ(read.options.size(), 2u);
  EXPECT_EQ(read.options[0].name, "min-range");
  EXPECT_EQ(read.options[0].value, "0.25");
  EXPECT_EQ(read.options[0].source, "derived");
  EXPECT_EQ(read.options[0].why, "a tenth");
  ASSERT_EQ(read.scans.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.scans[i].file, written.scans[i].file);
    EXPECT_EQ(read.scans[i].T_world_scan.matrix(),
              written.scans[i].T_world_scan.matrix()); // all digits
  }
}

TEST(RunSummary, BrokenFilesAreNamedWithThePlace)
{
  const TempFolder folder;
  const auto path = folder / "summary.json";
  writeRunSummary(path, makeSummary());
  const std::string good = pcl6d::test::readText(path);
  const auto expect = [&](const std::string& old_text,
                          const std::string& new_text,
                          const std::string& message) {
    std::string content = good;
    content.replace(content.find(old_text), old_text.size(), new_text);
    pcl6d::test::writeText(path, content);
    const std::string found =
        pcl6d::test::messageOf<pcl6d::IoFailed>([&] { readRunSummary(path); });
    EXPECT_EQ(found.rfind(path.string() + ": ", 0), 0u) << found;
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  expect("schema_version\": 1", "schema_version\": 2", "schema_version = 2");
  expect("generator", "author", "'generator' not found");
  expect("691234.0,", "", "world_offset: expected 3 numbers, got 2");
  expect("691234.0", "\"far\"", "must be number");
  expect("\"version\":", "\"version\"", "line 4, column");
  expect("\"file\"", "\"name\"", "'file' not found");
  EXPECT_THROW(readRunSummary(folder / "none"), pcl6d::IoFailed);
}
