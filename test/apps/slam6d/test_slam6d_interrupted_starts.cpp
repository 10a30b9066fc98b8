// SPDX-License-Identifier: BSD-3-Clause
// Signals while a run looks for its start: each start ends with the documented exit code.
#include "apps/support/drive_folder.h"
#include "support/signalled_program.h"

#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;
using namespace pcl6d::test;

/** A start and the stage in which the signal comes. */
struct SignalledStart {
  const char* start;
  const char* stage;
  int signal;
  bool is_written; ///< a partial run
};

class InterruptedStart : public testing::TestWithParam<SignalledStart> {};

std::string
nameOfStart(const testing::TestParamInfo<SignalledStart>& info)
{
  std::string name = info.param.start;
  name += info.param.stage;
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name + (info.param.signal == SIGINT ? "Int" : "Term");
}
} // namespace

TEST_P(InterruptedStart, EndsWithCode130)
{
  const SignalledStart& now = GetParam();
  const TempFolder folder;
  DriveFolder scans(folder / "in");
  const int count = std::string(now.stage) == "tracking" ? 64 : 12;
  for (int i = 0; i < count; ++i)
    scans.add(simulatedDrive(), i, pcl6d::scanName(i) + ".pcd");
  const fs::path out = folder / "out";
  const std::string err = folder / "err";
  const int code = signalledAt(
      now.stage,
      now.signal,
      "pcl_slam6d",
      {scans.path().string(), "-o", out.string(), "--start", now.start, "--no-picture"},
      err);
  EXPECT_EQ(code, 130) << readText(err);
  if (now.is_written) {
    const auto summary = nlohmann::json::parse(readText(out / "summary.json"));
    EXPECT_FALSE(summary["verdict"]["complete"]);
    EXPECT_FALSE(summary["verdict"]["reliable"]);
  }
  else {
    EXPECT_FALSE(fs::exists(out));
    EXPECT_NE(readText(err).find("nothing is written"), std::string::npos)
        << readText(err);
  }
  std::size_t hidden = 0; // no staging folder is left
  for (const auto& entry : fs::directory_iterator(folder.path()))
    hidden += entry.path().filename().string().front() == '.' ? 1 : 0;
  EXPECT_EQ(hidden, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    OfEachKind,
    InterruptedStart,
    testing::Values(SignalledStart{"auto", "matching", SIGINT, true},
                    SignalledStart{"overlap", "preparing", SIGINT, true},
                    SignalledStart{"auto", "tracking", SIGTERM, false},
                    SignalledStart{"sequence", "tracking", SIGINT, false},
                    SignalledStart{"any-order", "comparing", SIGINT, true},
                    SignalledStart{"any-order", "comparing", SIGTERM, true},
                    SignalledStart{"poses", "matching", SIGTERM, true},
                    SignalledStart{"overlap", "matching", SIGTERM, true},
                    SignalledStart{"features", "matching", SIGINT, true}),
    nameOfStart);
