// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_render picture as a user runs it, on a small run that is made here.
#include "apps/support/program_names.h"
#include "apps/support/room_run.h"
#include "support/folders.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <set>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::kRender;
using pcl6d::test::Outcome;
using pcl6d::test::room;
using pcl6d::test::roomCloud;
using pcl6d::test::sizeOfPng;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

Outcome
picture(const fs::path& run, std::vector<std::string> more)
{
  more.insert(more.begin(), {"picture", run.string()});
  return pcl6d::test::runProgram(kRender, more);
}

void
expectError(const Outcome& outcome, int code, const std::vector<std::string>& words)
{
  pcl6d::test::expectError(outcome, kRender, code, words);
}

constexpr const char* kAllViews[] = {"top",
                                     "perspective",
                                     "before-after",
                                     "graph",
                                     "covariance",
                                     "slice",
                                     "panorama",
                                     "convergence",
                                     "planes",
                                     "objects"};
} // namespace

TEST(RenderPicture, DrawsAllViewsOfARunByDefault)
{
  const Outcome outcome =
      picture(room().run(), {"-o", room().out("all"), "--points", "20000"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::set<std::string> pictures; // all must differ
  for (const std::string name : kAllViews) {
    const fs::path file = fs::path(room().out("all")) / (name + ".png");
    EXPECT_GE(sizeOfPng(file).first, 1600u) << file;
    EXPECT_NE(outcome.out.find(file.string()), std::string::npos);
    pictures.insert(pcl6d::test::readText(file));
  }
  EXPECT_EQ(pictures.size(), std::size(kAllViews));
}

TEST(RenderPicture, TakesEveryColourSizeAndBackground)
{
  std::set<std::string> pictures;
  for (const std::string colour :
       {"height", "scan", "reflectance", "residual", "label", "plain"}) {
    const std::string file = room().out(colour + ".png");
    const Outcome outcome = picture(
        room().run(),
        {"-o", file, "--view", "perspective", "--colour", colour, "--size", "320x240"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(sizeOfPng(file), std::pair(320u, 240u));
    pictures.insert(pcl6d::test::readText(file));
  }
  EXPECT_EQ(pictures.size(), 6u);
  const std::string file = room().out("clear.png");
  EXPECT_EQ(picture(room().run(),
                    {"-o",
                     file,
                     "--view",
                     "top",
                     "--transparent",
                     "--colour-map",
                     "magma",
                     "--background",
                     "light"})
                .exit_code,
            0);
  EXPECT_EQ(pcl6d::test::readText(file)[25], 6) << "PNG with alpha";
}

TEST(RenderPicture, TakesTitlesOfAnyBytesAndAnglesThatAreNumbers)
{
  const std::string file = room().out("title.png");
  const std::vector<std::string> call = {
      "-o", file, "--view", "perspective", "--size", "300x300"};
  const auto with = [&](const std::string& option, const std::string& value) {
    auto words = call;
    words.insert(words.end(), {option, value});
    return picture(room().run(), words);
  };
  // As in the name of a folder in Latin-1; VTK draws nothing of it but complains.
  const Outcome outcome = with("--title", "B\xfcro \xff\xfe");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* const angle : {"nan", "inf"})
    for (const char* const option : {"--azimuth", "--height"})
      expectError(with(option, angle), 2, {option, "finite"});
}

TEST(RenderPicture, WritesIntoTheRunUnlessToldOtherwise)
{
  EXPECT_EQ(picture(room().run(), {"--view", "graph,covariance", "--size", "300x300"})
                .exit_code,
            0);
  EXPECT_TRUE(fs::exists(room().run() / "pictures/graph.png"));
  EXPECT_TRUE(fs::exists(room().run() / "pictures/covariance.png"));
}

TEST(RenderPicture, DrawsWhatIsThereAndSaysWhatIsMissing)
{
  const TempFolder folder;
  fs::copy(room().run(), folder / "run", fs::copy_options::recursive);
  for (const char* const name : {"summary.json", "map.pcd", "scans", "planes.json"})
    fs::remove_all(folder / "run" / name);
  const Outcome outcome = picture(folder / "run", {"-o", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("lacks summary.json, scans, map.pcd"), std::string::npos)
      << outcome.err;
  EXPECT_TRUE(fs::exists(folder / "out/top.png"));
  EXPECT_TRUE(fs::exists(folder / "out/graph.png"));
  EXPECT_FALSE(fs::exists(folder / "out/perspective.png"));
  expectError(picture(folder / "run", {"-o", folder / "a.png", "--view", "planes"}),
              1,
              {"view planes", "planes.json is missing"});
  EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(RenderPicture, JoinsTheScansWhereTheMapIsMissing)
{
  const TempFolder folder;
  fs::copy(room().run(), folder / "run", fs::copy_options::recursive);
  fs::remove(folder / "run/map.pcd");
  const Outcome outcome =
      picture(folder / "run",
              {"-o", folder / "a.png", "--view", "perspective", "--colour", "scan"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder / "a.png"));
}

TEST(RenderPicture, RefusesABrokenOrEmptyRun)
{
  const TempFolder folder;
  expectError(picture(folder / "gone", {}), 1, {"gone", "no such folder"});
  expectError(picture(folder.path(), {}), 1, {"holds no run"});
  fs::copy(room().run(), folder / "run", fs::copy_options::recursive);
  const auto top = [&] {
    return picture(folder / "run", {"-o", folder / "a.png", "--view", "perspective"});
  };
  writeText(folder / "run/map.pcd", "rubbish");
  expectError(top(), 1, {"map.pcd"});
  pcl::PCLPointCloud2 nothing = roomCloud({});
  pcl6d::writePcd(folder / "run/map.pcd", nothing);
  expectError(top(), 1, {"no points"});
  std::string text = pcl6d::test::readText(folder / "run/summary.json");
  const auto place = text.find("\"T_world_scan\": [");
  text.replace(text.find("1.0", place), 3, "null");
  writeText(folder / "run/summary.json", text);
  expectError(top(), 1, {"summary.json", "null"});
}

TEST(RenderPicture, DrawsEvenASinglePoint)
{
  const TempFolder folder;
  fs::copy(room().run(), folder / "run", fs::copy_options::recursive);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.push_back({1, 1, 0});
  pcl::PCLPointCloud2 one;
  pcl::toPCLPointCloud2(cloud, one);
  pcl6d::addField(one, "scan", pcl::PCLPointField::UINT32, {0});
  pcl6d::writePcd(folder / "run/map.pcd", one);
  const Outcome outcome =
      picture(folder / "run", {"-o", folder / "out", "--view", "top,perspective"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(RenderPicture, RefusesAnOutputThatCannotBeWritten)
{
  const TempFolder folder;
  writeText(folder / "file", "");
  const auto to = [&](const std::string& output) {
    return picture(room().run(),
                   {"-o", output, "--view", "graph", "--size", "300x300"});
  };
  expectError(to(folder / "file/below"), 1, {"below"});
  expectError(to(folder / "file/a.png"), 1, {"a.png"});
  expectError(to(folder / "none/a.png"), 1, {"a.png"});
}

TEST(RenderPicture, RefusesWordsAndNumbersThatMakeNoSense)
{
  const auto refuses = [](const std::vector<std::string>& arguments,
                          const std::vector<std::string>& words) {
    expectError(picture(room().run(), arguments), 2, words);
  };
  refuses({"--view", "sideways"}, {"--view = sideways", "top, perspective"});
  refuses({"--colour", "taste"}, {"--colour = taste", "height, scan"});
  refuses({"--colour-map", "jet"}, {"--colour-map = jet", "viridis"});
  refuses({"--background", "pink"}, {"--background = pink", "dark, light"});
  for (const std::string size : {"0x0", "100x100000", "1920", "axb", "-5x300"})
    refuses({"--size", size}, {"--size"});
  refuses({"--points", "0"}, {"--points"});
  refuses({"--thickness", "-1"}, {"--thickness"});
  refuses({"--viewpoint", "9"}, {"--viewpoint = 9"});
  refuses({"--elevation", "120"}, {"--elevation"});
  refuses({"-o", "a.png"}, {"one file", "views"});
  expectError(
      picture(room().run(), {"--view", "panorama", "--scan", "77", "-o", "a.png"}),
      1,
      {"no scan 77"});
  const auto job = [](const std::vector<std::string>& arguments) {
    return pcl6d::test::runProgram(kRender, arguments);
  };
  expectError(job({"paint"}), 2, {"'paint'", "picture"});
  EXPECT_NE(job({"--help"}).out.find("picture"), std::string::npos);
}

TEST(RenderPicture, NeedsNoDisplayAndTellsWhenXvfbIsMissing)
{
  namespace bp = boost::process;
  const TempFolder folder;
  const auto start = [&](const std::string& name, bp::environment environment) {
    return bp::child(PCL6D_BIN_DIR "/" + std::string(kRender),
                     bp::args({"picture",
                               room().run().string(),
                               "--view",
                               "graph",
                               "-o",
                               (folder / (name + ".png")).string()}),
                     environment,
                     bp::std_out > bp::null,
                     bp::std_err > (folder / (name + ".err")).string());
  };
  bp::environment nowhere = boost::this_process::environment();
  nowhere["DISPLAY"] = ":9999";
  bp::environment unset = boost::this_process::environment();
  unset.erase("DISPLAY");
  bp::child first = start("nowhere", nowhere),
            second = start("unset", unset); // at once
  first.wait();
  second.wait();
  EXPECT_EQ(first.exit_code(), 0);
  EXPECT_EQ(second.exit_code(), 0);
  EXPECT_EQ(pcl6d::test::readText(folder / "nowhere.png"),
            pcl6d::test::readText(folder / "unset.png"));
  bp::environment bare = boost::this_process::environment();
  bare["PATH"] = folder.path().string();
  bp::child third = start("bare", bare);
  third.wait();
  EXPECT_EQ(third.exit_code(), 1);
  const std::string message = pcl6d::test::readText(folder / "bare.err");
  EXPECT_NE(message.find("install the package xvfb"), std::string::npos) << message;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
}
