// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --plugin: parts that the program does not have itself.
#include "apps/slam6d/plugin_run.h"

#include <pcl6d/slam6d/plugins.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::isDone;
using pcl6d::test::pluginFile;
using pcl6d::test::PluginRun;
using pcl6d::test::PluginWords;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::textScans;
using pcl6d::test::writeText;

const std::string kGood = pluginFile("good");
} // namespace

/** Parts that do what the suite's do come to the same bits. */
TEST(Slam6dPlugins, PartsAreUsedUnderTheirWords)
{
  struct Twin {
    PluginWords own, plugin;
  };
  const std::vector<Twin> twins = {
      {{"--metric", "point", "--minimiser", "svd"}, {"--minimiser", "test-svd"}},
      {{"--metric", "plane", "--plane-minimiser", "linear"},
       {"--plane-minimiser", "test-linear"}},
      {{"--voxel", "0.4", "--search", "brute-force"}, {"--search", "test-brute"}}};
  for (const Twin& twin : twins) {
    SCOPED_TRACE(twin.plugin[1]);
    PluginWords words = twin.own;
    const PluginRun own(words);
    ASSERT_TRUE(own.isDone()) << own.outcome.err;
    words.insert(words.end() - 2, {"--plugin", kGood});
    words.back() = twin.plugin[1];
    const PluginRun run(words);
    ASSERT_TRUE(run.isDone()) << run.outcome.err;
    EXPECT_EQ(run.poses, own.poses);
    EXPECT_EQ(run.option("plugin"), kGood);
    EXPECT_EQ(run.option(twin.plugin[0].c_str() + 2), twin.plugin[1]);
    EXPECT_NE(run.outcome.err.find("parts for the tests"), std::string::npos)
        << run.outcome.err;
    EXPECT_EQ(own.option("plugin"), "none");
  }
}

TEST(Slam6dPlugins, AReaderReadsItsFiles)
{
  const PluginRun text({});
  const PluginRun triples({"--plugin", kGood, "--format", "test-triples"},
                          textScans(".triples", "triples\n"));
  ASSERT_TRUE(triples.isDone()) << triples.outcome.err;
  EXPECT_EQ(triples.poses, text.poses);
  EXPECT_EQ(triples.option("format"), "test-triples");
  for (const auto& scan : triples.summary.at("scans"))
    EXPECT_EQ(scan.at("dropped"), 1) << "the NaN that the reader adds";
}

TEST(Slam6dPlugins, AFilterShapesWhatIsRegisteredAndWritten)
{
  const PluginRun all({}), low({"--plugin", kGood, "--filter", "test-low"});
  ASSERT_TRUE(low.isDone()) << low.outcome.err;
  EXPECT_NE(low.poses, all.poses);
  std::size_t kept = 0, before = 0;
  for (const char* const name : {"out/scans/scan000.pcd", "out/scans/scan003.pcd"}) {
    const auto points = pcl6d::readScan(low.folder / name).points;
    kept += points.size();
    before += pcl6d::readScan(all.folder / name).points.size();
    for (const auto& p : points)
      ASSERT_LE(p.z(), 0.5f);
  }
  EXPECT_GT(kept, 0u);
  EXPECT_LT(kept, before);
  EXPECT_EQ(low.option("filter"), "test-low");
}

TEST(Slam6dPlugins, ThreadsDoNotChangeABit)
{
  const PluginWords words = {"--plugin",
                             kGood,
                             "--metric",
                             "point",
                             "--minimiser",
                             "test-svd",
                             "--search",
                             "test-brute",
                             "--voxel",
                             "0.4",
                             "--filter",
                             "test-low",
                             "--threads"};
  PluginWords one = words, three = words;
  one.push_back("1");
  three.push_back("3");
  const PluginRun first(one), second(three);
  ASSERT_TRUE(first.isDone()) << first.outcome.err;
  EXPECT_EQ(first.poses, second.poses);
}

TEST(Slam6dPlugins, ComeFromTheConfigAndMayBeGivenTwice)
{
  const TempFolder folder;
  const std::string config = folder / "run.cfg";
  writeText(config, "plugin = " + kGood + "\nmetric = point\nminimiser = test-svd\n");
  const PluginRun run({"--config", config, "--plugin", kGood});
  ASSERT_TRUE(run.isDone()) << run.outcome.err;
  EXPECT_EQ(run.option("minimiser"), "test-svd");
  EXPECT_EQ(run.option("plugin"), kGood);
}

TEST(Slam6dPlugins, AreAskedForAgainWhenARunGoesOn)
{
  const TempFolder folder;
  const std::string plugin = folder / "own.so", out = folder / "out";
  fs::copy(kGood, plugin);
  const PluginWords words = {"--last", "2", "--no-picture", "--plugin", plugin};
  PluginWords first = {textScans(".xyz").string(), "-o", out, "--search", "test-brute"};
  first.insert(first.end(), words.begin(), words.end());
  first.insert(first.end(), {"--voxel", "0.4"});
  const auto begun = pcl6d::test::runProgram("pcl_slam6d", first);
  ASSERT_TRUE(isDone(begun)) << begun.err;
  const PluginWords alone = {textScans(".xyz").string(), "--continue", out};
  pcl6d::test::expectError(pcl6d::test::runProgram("pcl_slam6d", alone),
                           "pcl_slam6d",
                           2,
                           {out + "/summary.json", "--plugin " + plugin});
  PluginWords on = alone;
  on.insert(on.end(), {"--plugin", plugin});
  const auto gone_on = pcl6d::test::runProgram("pcl_slam6d", on);
  ASSERT_TRUE(isDone(gone_on)) << gone_on.err;
  const auto summary = nlohmann::json::parse(readText(folder / "out/summary.json"));
  EXPECT_EQ(summary.at("scans").size(), 4u);
  EXPECT_EQ(summary.at("options").at("search").at("value"), "test-brute");
  EXPECT_EQ(summary.at("options").at("plugin").at("value"), plugin);
}

/** In a program of one's own. */
TEST(Plugins, AreKnownByNameAndBytes)
{
  const TempFolder folder;
  const fs::path copy = folder / "copy.so";
  fs::copy(kGood, copy);
  pcl6d::Plugins first, second;
  first.load(kGood);
  first.load(PCL6D_PLUGIN_DIR "/./libpcl6d_test_good.so"); // the same
  ASSERT_EQ(first.loaded().size(), 1u);
  EXPECT_EQ(first.loaded()[0].file, fs::canonical(kGood));
  EXPECT_EQ(first.loaded()[0].name, "parts for the tests");
  EXPECT_EQ(first.loaded()[0].adds,
            "minimiser test-svd, plane minimiser test-linear, search test-brute, "
            "filter test-low, reader test-triples");
  EXPECT_EQ(first.minimisers().names(), std::vector<std::string>{"test-svd"});
  EXPECT_NE(first.formats().find("test-triples"), nullptr);
  EXPECT_EQ(first.filters().find("test-svd"), nullptr) << "it is no filter";
  second.load(copy);
  EXPECT_EQ(second.loaded()[0].fingerprint, first.loaded()[0].fingerprint);
  const fs::path changed = folder / "changed.so"; // the copy itself is in use
  writeText(changed, readText(kGood) + "changed");
  pcl6d::Plugins third;
  third.load(changed);
  EXPECT_NE(third.loaded()[0].fingerprint, first.loaded()[0].fingerprint);
}
