// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_render animation, on a run whose scans are three plates beside each other.
#include "support/folders.h"
#include "support/run_program.h"

#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/visualization/map_view.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <boost/process.hpp>
#include <gtest/gtest.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <csignal>
#include <limits>
#include <set>
#include <thread>

namespace {
namespace fs = std::filesystem;
using namespace pcl6d;
using pcl6d::test::expectError;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;

constexpr std::size_t kPlates = 3;

/** Points of 2 x 2 m of the ground. */
Points
plate()
{
  Points points;
  for (int x = -50; x <= 50; ++x)
    for (int y = -50; y <= 50; ++y)
      points.emplace_back(
          0.02F * static_cast<float>(x), 0.02F * static_cast<float>(y), 0);
  return points;
}

Eigen::Isometry3d
at(double x, double y, double yaw = 0)
{
  Eigen::Isometry3d pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  pose.translation() << x, y, 0;
  return pose;
}

/** Where plate i comes to lie; it starts 1 m off and is moved in three rounds. */
Eigen::Isometry3d
finalPose(std::size_t i)
{
  return at(3.0 * static_cast<double>(i), 0);
}

std::vector<Frame>
historyOf(std::size_t i)
{
  const double x = 3.0 * static_cast<double>(i), off = i == 0 ? 0 : 1;
  return {{at(x, off, off), FrameKind::kInvalid},
          {at(x, 0.5 * off, 0.2 * off), FrameKind::kIcp},
          {at(x, 0.2 * off), FrameKind::kLum},
          {finalPose(i), FrameKind::kLum}};
}

void
writeRun(const fs::path& run)
{
  fs::create_directories(run / "scans");
  fs::create_directories(run / "frames");
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const auto& p : plate())
    cloud.emplace_back(p.x(), p.y(), p.z());
  pcl::PointCloud<pcl::PointXYZ> map;
  pcl::PCLPointCloud2 message;
  Trajectory trajectory;
  for (std::size_t i = 0; i < kPlates; ++i) {
    const std::string name = "scan00" + std::to_string(i);
    pcl::toPCLPointCloud2(cloud, message);
    writePcd(run / "scans" / (name + ".pcd"), message, finalPose(i));
    writeFrames(run / "frames" / (name + ".frames"), historyOf(i));
    trajectory.poses.push_back(finalPose(i));
    for (const auto& p : plate()) {
      const Eigen::Vector3d world = finalPose(i) * p.cast<double>();
      map.emplace_back(world.x(), world.y(), world.z());
    }
  }
  pcl::toPCLPointCloud2(map, message);
  writePcd(run / "map.pcd", message);
  writeTrajectoryKitti(run / "trajectory.kitti", trajectory);
}

Outcome
animate(const fs::path& run,
        const std::string& kind,
        const fs::path& out,
        std::vector<std::string> more = {})
{
  more.insert(more.begin(),
              {"animation",
               run.string(),
               "--kind",
               kind,
               "-o",
               out.string(),
               "--size",
               "640x360",
               "--quiet"});
  return pcl6d::test::runProgram("pcl_slam6d_render", more);
}

void
expectDone(const Outcome& outcome)
{
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

cv::Mat
frame(const fs::path& folder, std::size_t number)
{
  std::string name = std::to_string(number);
  name = "frame" + std::string(5 - name.size(), '0') + name + ".png";
  return cv::imread((folder / name).string());
}

/** \return how many pixels show each plate: turbo's colours of its two ends and middle,
 * whatever their brightness */
std::array<int, kPlates>
platePixels(const cv::Mat& picture)
{
  std::array<int, kPlates> count{};
  for (int row = 40; row < 300; ++row) // between title and colour bar
    for (int column = 0; column < picture.cols; ++column) {
      const auto bgr = picture.at<cv::Vec3b>(row, column);
      const int b = bgr[0], g = bgr[1], r = bgr[2];
      const bool is_path = std::min({r, g, b}) > 150;
      count[1] += !is_path && g > 100 && g > r && g > b + 40;
      count[2] += !is_path && r > 60 && r > 3 * g;
      count[0] += !is_path && b > 35 && b > r + 5 && b > 2 * g;
    }
  return count;
}

class RenderAnimation : public testing::Test {
protected:
  void
  SetUp() override
  {
    writeRun(run_);
  }

  TempFolder folder_;
  const fs::path run_ = folder_ / "run";
  const fs::path out_ = folder_ / "out";
};
} // namespace

TEST_F(RenderAnimation, GrowthShowsOneScanMoreInEachFrame)
{
  const Outcome outcome = animate(run_, "growth", out_);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 frames"), std::string::npos) << outcome.out;
  EXPECT_FALSE(fs::exists(out_ / "frame00000.png"));
  EXPECT_FALSE(fs::exists(out_ / "frame00004.png"));
  for (std::size_t k = 1; k <= kPlates; ++k) {
    const auto seen = platePixels(frame(out_, k));
    for (std::size_t i = 0; i < kPlates; ++i)
      if (i < k)
        EXPECT_GT(seen[i], 1000) << "plate " << i << " in frame " << k;
      else
        EXPECT_LT(seen[i], 20) << "plate " << i << " in frame " << k;
  }
}

TEST_F(RenderAnimation, RelaxationEndsWithThePictureOfTheFinalPoses)
{
  expectDone(animate(run_, "relaxation", out_, {"--steps", "2"}));
  // As given, then two frames for each of three states.
  EXPECT_TRUE(fs::exists(out_ / "frame00007.png"));
  EXPECT_FALSE(fs::exists(out_ / "frame00008.png"));
  MapViewOptions options;
  options.width = 640;
  options.height = 360;
  options.colour = PointColour::kScan;
  options.colour_range = {0, 2};
  options.cut.max_height = std::numeric_limits<double>::infinity();
  options.final_label = "path";
  options.title = "relaxation, round 2";
  MapViewScene scene;
  for (std::size_t i = 0; i < kPlates; ++i) {
    const Points moved = transformed(plate(), finalPose(i));
    scene.points.insert(scene.points.end(), moved.begin(), moved.end());
    scene.scans.insert(scene.scans.end(), moved.size(), static_cast<std::uint32_t>(i));
    scene.trajectory.poses.push_back(finalPose(i));
  }
  const Image expected = MapView(options).draw(scene).image;
  const cv::Mat last = frame(out_, 7);
  ASSERT_EQ(last.cols, expected.width);
  ASSERT_EQ(last.rows, expected.height);
  int different = 0;
  for (int row = 0; row < last.rows; ++row)
    for (int column = 0; column < last.cols; ++column) {
      const auto bgr = last.at<cv::Vec3b>(row, column);
      different += expected.at(column, row) != Colour{bgr[2], bgr[1], bgr[0]};
    }
  EXPECT_EQ(different, 0) << "pixels";
  EXPECT_GT(cv::norm(last, frame(out_, 1), cv::NORM_L1), 1e6)
      << "as given looks otherwise";
}

TEST_F(RenderAnimation, TurntableComesAroundAndTheMapIsAlwaysInSight)
{
  expectDone(animate(run_, "turntable", out_, {"--frames", "4"}));
  std::vector<cv::Mat> frames;
  for (std::size_t k = 1; k <= 4; ++k)
    frames.push_back(frame(out_, k));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_GT(cv::norm(frames[k], frames[(k + 1) % 4], cv::NORM_L1), 1e6) << k;
  EXPECT_FALSE(fs::exists(out_ / "frame00005.png"));
}

TEST_F(RenderAnimation, FlyThroughMovesInEachFrame)
{
  expectDone(animate(run_, "flythrough", out_, {"--frames", "6"}));
  for (std::size_t k = 1; k < 6; ++k)
    EXPECT_GT(cv::norm(frame(out_, k), frame(out_, k + 1), cv::NORM_L1), 1e5) << k;
}

TEST_F(RenderAnimation, WritesVideosThatShowTheFrames)
{
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  expectDone(animate(run_, "growth", out_));
  if (!fs::exists(out_ / "animation.mp4"))
    GTEST_SKIP() << "this OpenCV has no codec for .mp4";
  const fs::path alone = folder_ / "film.avi";
  expectDone(animate(run_, "growth", alone));
  for (const fs::path& path : {out_ / "animation.mp4", alone}) {
    cv::VideoCapture video(path.string());
    cv::Mat picture;
    std::size_t count = 0;
    while (video.read(picture)) {
      ++count;
      ASSERT_EQ(picture.size(), cv::Size(640, 360));
      // Codecs blur: mean difference per channel.
      EXPECT_LT(cv::norm(picture, frame(out_, count), cv::NORM_L1) / (640 * 360 * 3), 6)
          << path << ' ' << count;
    }
    EXPECT_EQ(count, kPlates) << path;
    EXPECT_DOUBLE_EQ(video.get(cv::CAP_PROP_FPS), 8);
  }
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    EXPECT_NE(entry.path().filename().string()[0], '.') << "a file was left behind";
}

TEST_F(RenderAnimation, TellsOfAFilmThatIsCut)
{
  // A limit on the size of files stands for a full disk; films are large enough that the X
  // server can start below it.
  for (const char* const kind : {".avi", ".mp4"}) {
    const fs::path whole = folder_ / (std::string("whole") + kind);
    const fs::path cut = folder_ / (std::string("cut") + kind);
    const Outcome usual = animate(run_, "turntable", whole, {"--frames", "20"});
    if (usual.err.find("no codec") != std::string::npos)
      continue;
    ASSERT_EQ(usual.exit_code, 0) << usual.err;
    const std::uintmax_t blocks = fs::file_size(whole) / 512;
    for (const std::uintmax_t limit : {blocks / 2, blocks - 1}) {
      const std::string error = folder_ / "error";
      const int code = boost::process::system(
          "/bin/sh",
          "-c",
          "ulimit -f " + std::to_string(limit) +
              " && exec " PCL6D_BIN_DIR "/pcl_slam6d_render animation '" +
              run_.string() +
              "' --kind turntable --frames 20 --size 640x360 --quiet -o '" +
              cut.string() + "' 2> '" + error + "'");
      EXPECT_EQ(code, 1) << kind;
      EXPECT_NE(readText(error).find("cannot be written"), std::string::npos)
          << kind << ": " << readText(error);
      EXPECT_FALSE(fs::exists(cut)) << kind;
    }
  }
}

TEST_F(RenderAnimation, WritesNothingThroughALinkThatAnotherUserMayPutThere)
{
  // The name was once made of the number of the process, which `exec` keeps.
  const fs::path film = folder_ / "film.avi", mine = folder_ / "mine";
  pcl6d::test::writeText(mine, "mine");
  const std::string command =
      "ln -s '" + mine.string() + "' '" + folder_.path().string() +
      "'/.pcl6d-writing-$$.avi && exec " PCL6D_BIN_DIR
      "/pcl_slam6d_render animation '" +
      run_.string() + "' --kind growth --size 640x360 --quiet -o '" + film.string() +
      "'";
  EXPECT_EQ(boost::process::system("/bin/sh", "-c", command), 0);
  EXPECT_EQ(readText(mine), "mine");
  EXPECT_TRUE(fs::exists(film));
}

TEST_F(RenderAnimation, SaysWhatTheRunLacks)
{
  fs::remove_all(run_ / "scans");
  expectError(animate(run_, "growth", out_),
              "pcl_slam6d_render",
              1,
              {run_, "scans/ is missing"});
  fs::remove_all(run_ / "frames");
  expectError(animate(run_, "relaxation", out_), "pcl_slam6d_render", 1, {"frames/"});
  EXPECT_EQ(animate(run_, "turntable", out_, {"--frames", "2"}).exit_code, 0)
      << "the map alone will do";
  fs::remove(run_ / "map.pcd");
  expectError(animate(run_, "turntable", folder_ / "b"),
              "pcl_slam6d_render",
              1,
              {"map.pcd is missing"});
  EXPECT_FALSE(fs::exists(folder_ / "b"));
}

TEST_F(RenderAnimation, RefusesWhatItCannotDo)
{
  const auto usage = [&](const std::vector<std::string>& more,
                         const std::string& words) {
    expectError(animate(run_, "growth", out_, more), "pcl_slam6d_render", 2, {words});
  };
  expectError(animate(run_, "dance", out_), "pcl_slam6d_render", 2, {"--kind = dance"});
  usage({"--frames", "0"}, "--frames = 0");
  usage({"--fps", "0"}, "--fps = 0");
  usage({"--steps", "0"}, "--steps = 0");
  usage({"--points", "0"}, "--points = 0");
  expectError(
      pcl6d::test::runProgram(
          "pcl_slam6d_render",
          {"animation", run_, "--kind", "growth", "-o", out_, "--size", "20x20"}),
      "pcl_slam6d_render",
      2,
      {"--size = 20"});
  expectError(
      pcl6d::test::runProgram(
          "pcl_slam6d_render",
          {"animation", run_, "--kind", "growth", "-o", out_, "--size", "641x360"}),
      "pcl_slam6d_render",
      2,
      {"even"});
  expectError(animate(run_, "growth", run_), "pcl_slam6d_render", 1, {"input folder"});
  expectError(
      animate(run_, "growth", run_ / "map.pcd" / "x"), "pcl_slam6d_render", 1, {});
  expectError(animate(run_, "growth", run_ / "map.pcd" / "x.mp4"),
              "pcl_slam6d_render",
              1,
              {"x.mp4"});
  fs::create_directory(out_);
  pcl6d::test::writeText(out_ / "mine.txt", "keep");
  expectError(animate(run_, "growth", out_), "pcl_slam6d_render", 1, {"not empty"});
  EXPECT_EQ(animate(run_, "growth", out_, {"--force"}).exit_code, 0);
  EXPECT_EQ(pcl6d::test::readText(out_ / "mine.txt"), "keep");
}
