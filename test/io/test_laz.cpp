// SPDX-License-Identifier: BSD-3-Clause
#include "las_samples.h"
#include "scan/las/laz_reader.h"
#include "support/folders.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/io/text.h>

#include <cstdlib>

namespace fs = std::filesystem;
using namespace pcl6d;
using namespace pcl6d::test;

namespace {

constexpr int kCompressed[] = {0, 1, 2, 3, 6, 7, 8};

/** \return the records of a LAZ file */
std::vector<std::string>
recordsOf(const fs::path& path)
{
  io::FileInput input(path);
  const io::LasHeader header = io::readLasHeader(input);
  std::vector<std::uint8_t> data;
  input.appendRest(data);
  io::LazReader reader(path, header, data);
  std::vector<std::uint8_t> record(header.record_size);
  std::vector<std::string> records;
  for (std::uint64_t i = 0; i < header.count; ++i) {
    reader.next(record.data());
    records.emplace_back(record.begin(), record.end());
  }
  return records;
}

void
expectEqualRecords(const std::vector<std::string>& found,
                   const std::vector<std::string>& wanted)
{
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    ASSERT_EQ(found[i], wanted[i]) << "point " << i;
}

/** \return the command that runs a script with laz-perf, an independent reader; its folder
 * node_modules is PCL6D_NODE_MODULES, or node finds it */
std::string
nodeWith(const std::string& script)
{
  const char* const modules = std::getenv("PCL6D_NODE_MODULES");
  return (modules ? "NODE_PATH='" + std::string(modules) + "' " : std::string()) +
         "node " + script;
}

bool
hasLazPerf()
{
  return std::system(
             (nodeWith("-e \"require.resolve('laz-perf')\"") + " > /dev/null 2>&1")
                 .c_str()) == 0;
}

/** Expects that laz-perf finds these records in a file. */
void
expectLazPerfFinds(const fs::path& file, const std::vector<std::string>& wanted)
{
  const std::string script = std::string(PCL6D_SOURCE_DIR) + "/test/io/laz_perf.js";
  ASSERT_EQ(std::system(nodeWith("'" + script + "' '" + file.string() + "'").c_str()),
            0);
  const std::string found = text::readFile(file.string() + ".records");
  std::string all;
  for (const auto& record : wanted)
    all += record;
  EXPECT_EQ(found.size(), all.size());
  EXPECT_TRUE(found == all);
}

} // namespace

TEST(Laz, LazPerfReadsTheSamePoints)
{
  if (!hasLazPerf())
    GTEST_SKIP() << "no node with laz-perf (npm install laz-perf; PCL6D_NODE_MODULES)";
  const TempFolder folder;
  for (const int format : kCompressed) {
    SCOPED_TRACE(format);
    const LasSample sample = lasSample(format, 4000, 0, 4); // channels of the scanner
    const fs::path file = folder / ("format" + std::to_string(format) + ".laz");
    writeText(file, lazBytes(sample, 1500));
    expectLazPerfFinds(file, sample.records);
  }
}

TEST(Laz, LazPerfReadsWhatTheWriterWrites)
{
  if (!hasLazPerf())
    GTEST_SKIP() << "no node with laz-perf (npm install laz-perf; PCL6D_NODE_MODULES)";
  const TempFolder folder;
  for (const int format : {6, 7}) {
    const LasSample sample = lasSample(format, 60000);
    writeText(folder / "in.las", lasBytes(sample));
    const ScanCloud scan = readScanCloud(folder / "in.las");
    const fs::path file = folder / ("out" + std::to_string(format) + ".laz");
    writeScan(file, scan.cloud);
    expectLazPerfFinds(file, recordsOf(file));
  }
}

TEST(Laz, ComesBackToTheBitInEveryFormat)
{
  const TempFolder folder;
  for (const int format : kCompressed)
    for (const std::size_t bytes : {0, 3})
      for (const std::uint32_t chunk : {1U, 700U, 50000U}) {
        SCOPED_TRACE("format " + std::to_string(format) + ", further bytes " +
                     std::to_string(bytes) + ", chunks of " + std::to_string(chunk));
        const LasSample sample = lasSample(format, chunk == 1 ? 20 : 5000, bytes);
        replaceText(folder / "a.laz", lazBytes(sample, chunk));
        expectEqualRecords(recordsOf(folder / "a.laz"), sample.records);
      }
}

TEST(Laz, TableOfChunksMayStandAtTheEndOrBeMissing)
{
  const TempFolder folder;
  for (const int format : kCompressed)
    for (const auto table : {ChunkTable::kAtTheEnd, ChunkTable::kMissing}) {
      SCOPED_TRACE(format);
      const LasSample sample = lasSample(format, 3000);
      replaceText(folder / "a.laz", lazBytes(sample, 1000, table));
      expectEqualRecords(recordsOf(folder / "a.laz"), sample.records);
    }
}

TEST(Laz, ChannelsOfAScannerAreToldApartInBothVersions)
{
  const TempFolder folder;
  for (const int format : {6, 7, 8})
    for (const bool right : {false, true}) {
      SCOPED_TRACE(format);
      const LasSample sample = lasSample(format, 5000, 2, 4);
      replaceText(folder / "a.laz", lazBytes(sample, 50000, ChunkTable::kTold, right));
      expectEqualRecords(recordsOf(folder / "a.laz"), sample.records);
    }
}

TEST(Laz, IsSmallerThanLasByFar)
{
  LasSample sample;
  sample.format = 6;
  for (int i = 0; i < 20000; ++i) { // a wall, measured line by line
    std::string record(30, '\0');
    put(record, 0, std::int32_t{5000});
    put(record, 4, i % 200 * 50 + i * 7919 % 5);
    put(record, 8, i / 200 * 50 + i * 104729 % 5);
    record[14] = 0x11;
    sample.records.push_back(record);
  }
  EXPECT_LT(lazBytes(sample).size() * 6, lasBytes(sample).size());
}
