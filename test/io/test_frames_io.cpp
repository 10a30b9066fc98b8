// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/poses.h"

#include <pcl6d/io/frames_io.h>

using pcl6d::Frame;
using pcl6d::FrameKind;
using pcl6d::readFrames;
using pcl6d::writeFrames;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

TEST(Frames, RoundTripKeepsPosesAndKinds)
{
  const TempFolder folder;
  pcl6d::Random random(1);
  std::vector<Frame> written;
  for (const FrameKind kind : {FrameKind::kInvalid,
                               FrameKind::kIcp,
                               FrameKind::kInactive,
                               FrameKind::kLum,
                               FrameKind::kElch})
    written.push_back({pcl6d::test::randomPose(random, 1e3, 2.0), kind});
  writeFrames(folder / "scan000.frames", written);
  const auto read = readFrames(folder / "scan000.frames");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].kind, written[i].kind);
    const auto error =
        pcl6d::distanceBetween(read[i].T_world_scan, written[i].T_world_scan);
    EXPECT_LT(error.translation, 1e-12); // two roundings of 1e3 m: times and by 100
    EXPECT_LT(error.rotation, 1e-14);
  }
}

TEST(Frames, AreColumnsOfALeftHandedMatrixInCentimetres)
{
  const TempFolder folder;
  Frame frame;
  // 3 m forward, 1 m left, 2 m up; turned a quarter to the left.
  frame.T_world_scan = pcl6d::poseFromEuler({3, 1, 2}, {0, 0, M_PI / 2});
  frame.T_world_scan.linear() = frame.T_world_scan.linear().array().round(); // no 6e-17
  frame.kind = FrameKind::kLum;
  writeFrames(folder / "scan000.frames", {frame});
  // The scan's right is the world's forward, its forward the world's left: -right.
  EXPECT_EQ(pcl6d::test::readText(folder / "scan000.frames"),
            "0 0 1 0 0 1 0 0 -1 0 0 0 -100 200 300 1 3\n");
}

TEST(Frames, ADecimalCommaElsewhereChangesNothing)
{
  const TempFolder folder;
  const pcl6d::test::DecimalComma locale;
  Frame frame;
  frame.T_world_scan.translation().x() = 12345.625;
  writeFrames(folder / "f", {frame});
  EXPECT_EQ(readFrames(folder / "f").at(0).T_world_scan.translation().x(), 12345.625);
}

TEST(Frames, BrokenFilesAreNamedWithLineValueAndRule)
{
  const TempFolder folder;
  const auto path = folder / "scan000.frames";
  const auto expectMessage = [&](const std::string& content,
                                 const std::string& message) {
    writeText(path, content);
    expectIoFailed(path, message, [&] { readFrames(path); });
  };
  const std::string identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ";
  expectMessage(identity + "\n", "line 1: expected 17 numbers, got 16");
  expectMessage(identity + "1\n" + identity + "x\n", "line 2: 'x' is not a number");
  expectMessage(identity + "5\n", "line 1: unknown kind of frame 5, must be 0 to 4");
  expectMessage(identity + "1.5\n",
                "line 1: unknown kind of frame 1.5, must be 0 to 4");
  expectMessage("2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1\n",
                "line 1: not a rigid motion (largest entry of |R^T R - I| is 3)");
  expectMessage("1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1 1\n",
                "line 1: not a rigid motion (the last row must be 0 0 0 1)");
  expectIoFailed(folder / "missing", "No such file or directory", [&] {
    readFrames(folder / "missing");
  });
}
