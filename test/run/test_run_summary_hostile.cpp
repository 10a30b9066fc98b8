// SPDX-License-Identifier: BSD-3-Clause
// A summary.json may come from anybody.
#include "io/io_test.h"

#include <pcl6d/run/run_summary.h>

#include <nlohmann/json.hpp>

#include <functional>

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using pcl6d::IoFailed;
using pcl6d::readRunSummary;
using pcl6d::RunResult;
using pcl6d::test::messageOf;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
/** A run of two scans as pcl_slam6d writes it, and what becomes of it when it is changed. */
class HostileSummary : public testing::Test {
protected:
  void
  SetUp() override
  {
    run_.generator = "pcl_slam6d";
    for (int i = 0; i < 2; ++i) {
      pcl6d::ScanResult scan;
      scan.file = "scan00" + std::to_string(i) + ".pcd";
      scan.index = i;
      scan.covariance = Eigen::Matrix<double, 6, 6>::Identity() * 1e-4;
      run_.scans.push_back(scan);
    }
    run_.options = {{"voxel", "0.1", "given", ""}};
    run_.verification.emplace().scans.resize(2);
    run_.moved.emplace();
    run_.files["scans/scan000.pcd"] = {123, 0x0a1b2c3d};
  }

  RunResult
  reread() const
  {
    pcl6d::writeRunSummary(file(), run_);
    return readRunSummary(file());
  }

  /** \return the error without the file's name */
  std::string
  errorAfter(const std::function<void(Json&)>& change) const
  {
    pcl6d::writeRunSummary(file(), run_);
    Json json = Json::parse(readText(file()));
    change(json);
    writeText(file(), json.dump());
    const std::string error = messageOf<IoFailed>([&] { readRunSummary(file()); });
    const std::string prefix = file().string() + ": ";
    EXPECT_EQ(error.find(prefix), 0u) << error;
    return error.substr(std::min(prefix.size(), error.size()));
  }

  void
  expectRefused(const std::string& pointer, const Json& value, const std::string& part)
  {
    const std::string error =
        errorAfter([&](Json& json) { json[Json::json_pointer(pointer)] = value; });
    const std::string place =
        error.substr(0, error.find(": ")); // of it, or what holds it
    EXPECT_EQ(pointer.find(place), 0u) << error;
    EXPECT_NE(error.find(part), std::string::npos) << error;
  }

  fs::path
  file() const
  {
    return folder_ / "summary.json";
  }

  RunResult run_;

private:
  TempFolder folder_;
};
} // namespace

TEST_F(HostileSummary, TheFilesOfTheRunComeBack)
{
  const RunResult back = reread();
  EXPECT_EQ(back.files, run_.files);
  EXPECT_NE(readText(file()).find("\"crc32\": \"0a1b2c3d\""), std::string::npos);
  run_.files.clear();
  EXPECT_TRUE(reread().files.empty()) << "as in runs of older versions";
}

TEST_F(HostileSummary, FilesAreChecked)
{
  expectRefused("/files", 3, "is no object");
  for (const char* path :
       {"../x", "/etc/passwd", "a//b", "a/../b", ".", "", "a\x1b[2J"})
    EXPECT_NE(errorAfter([&](Json& json) {
                json["files"] = {{path, {{"bytes", 1}, {"crc32", "00000000"}}}};
              }).find("must be under the path of a file in the run's folder"),
              std::string::npos)
        << path;
  const auto refused = [&](const char* key, const Json& value, const char* part) {
    const std::string error = errorAfter(
        [&](Json& json) { json["files"]["scans/scan000.pcd"][key] = value; });
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  refused("bytes", -1, "is not a whole number >= 0");
  refused("bytes", "1", "is not a whole number >= 0");
  for (const char* sum : {"", "123", "0a1b2c3g", "0x1b2c3d", "-a1b2c3d", "0a1b2c3d4"})
    refused("crc32", sum, "eight hexadecimal digits");
  refused("other", 1, "unknown key 'other'");
}

TEST_F(HostileSummary, PosesAreRigidAndNear)
{
  expectRefused("/scans/1/T_world_scan/0", 1.001, "must be a rigid motion");
  expectRefused("/scans/1/T_world_scan/0", -1, "must be a rigid motion");
  expectRefused("/scans/1/T_world_scan/12", 0.5, "must be a rigid motion");
  expectRefused("/scans/1/initial_pose/0", 0, "must be a rigid motion");
  EXPECT_NE(errorAfter([](Json& json) {
              json["scans"][0]["T_world_scan"][3] = 1e100;
            }).find("/scans/0/T_world_scan: "),
            std::string::npos);
  EXPECT_NE(errorAfter([](Json& json) {
              json["scans"][0]["T_world_scan"][3] = 1e9;
            }).find("must be a position within 1e9 m"),
            std::string::npos);
  expectRefused("/world_offset", Json::array({0, 0, 1e100}), "below 1e9");
  expectRefused("/world_offset", Json::array({0, 0}), "expected 3 numbers, got 2");
  expectRefused("/input_offset/offset", Json::array({0, 0, 1e100}), "below 1e9");
  expectRefused("/input_offset/poses", "sun", "file");
}

TEST_F(HostileSummary, CovariancesAreSymmetricAndPositive)
{
  const auto errorOf = [&](int row, int column, double value) {
    return errorAfter(
        [&](Json& json) { json["scans"][1]["covariance"][row][column] = value; });
  };
  EXPECT_NE(errorOf(0, 1, 1e-5).find("must be symmetric"), std::string::npos);
  EXPECT_NE(errorOf(2, 2, -1e-4).find("no variance may be negative"),
            std::string::npos);
  expectRefused("/scans/0/covariance", Json::array({1, 2}), "six rows of six numbers");
  expectRefused("/scans/0/covariance/5", Json::array({1, 2}), "must be six numbers");
  run_.scans[1].covariance->setZero(); // of the fixed scan
  EXPECT_TRUE(reread().scans[1].covariance->isZero());
}

TEST_F(HostileSummary, EachIndexIsThereOnce)
{
  expectRefused("/scans/1/index", 0, "there are two scans 0");
  expectRefused("/scans/1/index", -1, "must be >= 0");
  expectRefused("/scans/1/index", 1.5, "is not a whole number");
  expectRefused("/scans/1/index", 1e300, "is not a whole number");
  expectRefused("/scans/1/iterations", -1, "must be >= 0");
  expectRefused("/scans/1/points", -1, "is not a whole number >= 0");
  expectRefused("/scans/1/rms", "x", "is not a number");
}

TEST_F(HostileSummary, NamesOfFilesStayInTheirFolder)
{
  for (const char* name : {"../scan.pcd", "/etc/passwd", "..", ".", "", "a/b.pcd"})
    expectRefused("/scans/0/file", name, "the name of a file, without a folder");
  expectRefused("/scans/0/file", "\x1b[2J.pcd", "control characters");
  expectRefused("/scans/0/file", std::string("a\0b", 3), "control characters");
  EXPECT_NE(errorAfter([](Json& json) {
              json["scans"][0]["file_bytes"] = "2e2e";
            }).find("the name of a file"),
            std::string::npos);
  for (const char* hex : {"2", "2g", "+1", "", "61 2"})
    EXPECT_NE(errorAfter([&](Json& json) {
                json["scans"][0]["file_bytes"] = hex;
              }).find("must"),
              std::string::npos)
        << hex;
}

TEST_F(HostileSummary, NamesThatJsonCannotHoldComeBack)
{
  run_.scans[0].file = "s\xe4ule.pcd"; // Latin-1
  run_.scans[1].file = "a\nb\x1b.pcd";
  run_.floating = {"s\xe4ule.pcd"};
  const RunResult back = reread();
  EXPECT_EQ(back.scans[0].file, run_.scans[0].file);
  EXPECT_EQ(back.scans[1].file, run_.scans[1].file);
  EXPECT_EQ(back.floating, run_.floating);
  run_.scans[0].file = "s\xc3\xa4ule 100%25.pcd"; // UTF-8 stays as it is
  EXPECT_EQ(reread().scans[0].file, run_.scans[0].file);
}

TEST_F(HostileSummary, EachPlaceHasItsType)
{
  expectRefused("/scans", 1, "is no array");
  expectRefused("/scans/0", "x", "is no object");
  expectRefused("/scans/0/state", "lost", "no state of a scan is called 'lost'");
  expectRefused("/options", Json::array(), "is no object");
  expectRefused("/options/voxel", 0.1, "is no object");
  expectRefused("/options/voxel/value", 0.1, "is not a text");
  expectRefused("/verdict/reliable", "yes", "must be true or false");
  expectRefused("/warnings/0", 1, "is not a text");
  expectRefused("/totals/map_points", -1, "is not a whole number >= 0");
  expectRefused("/verification/verdict", "best", "best");
  expectRefused("/verification/background", 2, "must be in [0, 1]");
  expectRefused("/verification/scans", Json::array(), "must be one check per scan");
  expectRefused("/graph/links_used", "x", "is not a whole number >= 0");
  expectRefused("/schema_version", "1", "is not a whole number");
  writeText(file(), "[]");
  const std::string error = messageOf<IoFailed>([&] { readRunSummary(file()); });
  EXPECT_NE(error.find("[] is no object {...}"), std::string::npos) << error;
}
