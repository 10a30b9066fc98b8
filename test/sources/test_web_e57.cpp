// SPDX-License-Identifier: BSD-3-Clause
// An independent reader of E57 (web-e57 of npm, Rust compiled to WebAssembly) reads what is
// written, with equal coordinates.
#include "support/temp_folder.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/text.h>
#include <pcl6d/sources/e57_poses.h>
#include <pcl6d/sources/e57_writer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace {

using namespace pcl6d::test;
using pcl::PCLPointField;

/** Loads the package, which is made for bundlers, and prints x y z r g b of all points. */
constexpr const char* kReader = R"(
import { readFileSync } from 'fs';
import * as reader from './node_modules/web-e57/e57_bg.js';
const code = readFileSync('./node_modules/web-e57/e57_bg.wasm');
const module = await WebAssembly.instantiate(code, { './e57_bg.js': reader });
reader.__wbg_set_wasm(module.instance.exports);
process.stdout.write(reader.convertE57(new Uint8Array(readFileSync(process.argv[2])), 'XYZ'));
)";

bool
runs(const std::string& command)
{
  return std::system(("(" + command + ") > /dev/null 2>&1").c_str()) == 0;
}

pcl6d::E57Station
stationOf(unsigned seed)
{
  std::mt19937 random(seed);
  pcl6d::E57Station station;
  station.name = "station " + std::to_string(seed);
  auto& cloud = station.scan.cloud;
  cloud.width = 5000;
  cloud.height = 1;
  for (const char* const axis : {"x", "y", "z"}) {
    std::vector<double> values;
    for (int i = 0; i < 5000; ++i)
      values.push_back(static_cast<double>(random()) / 4294967296.0 * 80 - 40);
    pcl6d::addField(cloud,
                    axis,
                    seed == 0 ? PCLPointField::FLOAT32 : PCLPointField::FLOAT64,
                    values);
  }
  pcl6d::addField(
      cloud, "intensity", PCLPointField::FLOAT32, std::vector<double>(5000, 0.5));
  std::vector<double> colours;
  for (int i = 0; i < 5000; ++i)
    colours.push_back(static_cast<double>(random() & 0xFFFFFF));
  pcl6d::addField(cloud, "rgb", PCLPointField::UINT32, colours);
  station.pose = pcl6d::poseFromEuler({100.0 * seed, -3, 0.5}, {0.1, 0.2, 1.5});
  return station;
}

class WebE57 : public testing::Test {
protected:
  void
  SetUp() override
  {
    if (!runs("command -v node") || !runs("command -v npm"))
      GTEST_SKIP() << "no node or npm: apt-get install nodejs npm";
    writeText(folder_ / "reader.mjs", kReader);
    if (!runs("cd '" + folder_.path().string() +
              "' && timeout 120 npm install --no-audit --no-fund web-e57@1.2.0"))
      GTEST_SKIP() << "npm does not reach its registry";
  }

  std::vector<std::vector<double>>
  rowsOf(const std::string& file) const
  {
    EXPECT_TRUE(runs("cd '" + folder_.path().string() + "' && node reader.mjs " + file +
                     " > rows.txt 2> log"))
        << readText(folder_ / "log");
    std::vector<std::vector<double>> rows;
    const std::string text = readText(folder_ / "rows.txt");
    pcl6d::text::Lines lines(text);
    while (lines.next())
      if (!pcl6d::text::isBlank(lines.line())) {
        rows.emplace_back();
        pcl6d::text::readRow("rows.txt", lines, rows.back());
      }
    return rows;
  }

  TempFolder folder_;
};

void
expectPoints(const std::vector<std::vector<double>>& rows,
             std::size_t first,
             const pcl6d::E57Station& station,
             const Eigen::Isometry3d& pose)
{
  const auto& cloud = station.scan.cloud;
  std::vector<std::vector<double>> p;
  for (const char* const axis : {"x", "y", "z"})
    p.push_back(pcl6d::fieldValues(cloud, axis)->values);
  const auto colours = pcl6d::fieldValues(cloud, "rgb")->values;
  constexpr double kRounding = 1e-12; // [m] of a product of 200 m in double
  for (std::size_t i = 0; i < cloud.width; ++i) {
    const Eigen::Vector3d expected = pose * Eigen::Vector3d(p[0][i], p[1][i], p[2][i]);
    const auto& row = rows[first + i];
    ASSERT_EQ(row.size(), 6U);
    ASSERT_LT((expected - Eigen::Vector3d(row[0], row[1], row[2])).norm(), kRounding);
    ASSERT_EQ(row[3] * 65536 + row[4] * 256 + row[5], colours[i]);
  }
}

TEST_F(WebE57, ReadsWhatIsWrittenAndThePosesThatArePutIn)
{
  std::vector<pcl6d::E57Station> stations = {stationOf(0), stationOf(1)};
  pcl6d::writeE57(folder_ / "a.e57", 2, [&](std::size_t i) { return stations[i]; });
  auto rows = rowsOf("a.e57");
  ASSERT_EQ(rows.size(), 10000U);
  for (std::size_t i = 0; i < 2; ++i)
    expectPoints(rows, 5000 * i, stations[i], *stations[i].pose);
  const Eigen::Isometry3d other = pcl6d::poseFromEuler({-7, 1.0 / 3, 2}, {0.3, 0, -2});
  pcl6d::writeE57Poses(folder_ / "a.e57", folder_ / "b.e57", {std::nullopt, other});
  rows = rowsOf("b.e57");
  ASSERT_EQ(rows.size(), 10000U);
  expectPoints(rows, 0, stations[0], *stations[0].pose);
  expectPoints(rows, 5000, stations[1], other);
}

} // namespace
