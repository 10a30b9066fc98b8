// SPDX-License-Identifier: BSD-3-Clause
// Plug-ins that cannot be used, and parts that fail at work: one clear line each.
#include "apps/slam6d/plugin_run.h"
#include "support/folders.h"

#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/plugins.h>

namespace {
using pcl6d::test::expectError;
using pcl6d::test::pluginFile;
using pcl6d::test::PluginRun;
using pcl6d::test::PluginWords;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

void
expectRefused(const PluginWords& words, const PluginWords& message)
{
  SCOPED_TRACE(message.back());
  const PluginRun run(words);
  expectError(run.outcome, "pcl_slam6d", 2, message);
  EXPECT_FALSE(std::filesystem::exists(run.folder / "out"));
}

void
expectFileRefused(const std::string& file, PluginWords message)
{
  message.insert(message.begin(), {"--plugin", file});
  expectRefused({"--plugin", file}, message);
}
} // namespace

TEST(Slam6dBadPlugins, FilesThatAreNone)
{
  const TempFolder folder;
  writeText(folder / "text.so", std::string(2000, 'x'));
  writeText(folder / "empty.so", "");
  expectFileRefused(folder / "missing.so", {"No such file"});
  expectFileRefused(folder.path(), {"is no file"});
  expectFileRefused(folder / "text.so", {"cannot be loaded", "invalid ELF header"});
  expectFileRefused(folder / "empty.so", {"cannot be loaded", "too short"});
  expectFileRefused("nowhere.so", {"No such file"}); // not searched for
  expectFileRefused(folder / "a:b.so", {"path without ':'"});
  expectFileRefused(PCL6D_BIN_DIR "/pcl_slam6d", {"cannot be loaded"});
}

TEST(Slam6dBadPlugins, LibrariesThatAreNone)
{
  expectFileRefused(pluginFile("plain"), {"no symbol pcl6d_plugin"});
  expectFileRefused(
      pluginFile("other_abi"),
      {"another program", "interface 999 (here 1)", "build the plug-in anew"});
  expectFileRefused(pluginFile("other_build"),
                    {"version of PCL 1.9.1 (here 1.",
                     "_GLIBCXX_USE_CXX11_ABI 0 (here 1)",
                     "alignment of Eigen",
                     "64 (here 16)",
                     "another compiler 1.0"});
}

TEST(Slam6dBadPlugins, DifferencesThatDoNotMatterAreNotTold)
{
  const PluginRun run({"--plugin", pluginFile("other_build")});
  EXPECT_EQ(run.outcome.err.find("version of Eigen"), std::string::npos)
      << run.outcome.err;
}

TEST(Slam6dBadPlugins, PartsThatCannotBeTakenIn)
{
  expectFileRefused(pluginFile("refused_1"), {"minimiser helix", "by a part of"});
  expectFileRefused(pluginFile("refused_3"), {"Two Words", "small letters"});
  expectFileRefused(pluginFile("refused_4"), {"adding parts: not today"});
  expectFileRefused(pluginFile("refused_5"), {"throws while adding parts"});
  expectFileRefused(pluginFile("refused_6"), {"function of a search"});
  expectFileRefused(pluginFile("refused_7"), {"extension of a reader = xyz"});
  expectFileRefused(pluginFile("refused_8"), {"throws while loading: boom"});
  expectRefused({"--plugin", pluginFile("good"), "--plugin", pluginFile("refused_2")},
                {"refused_2", "minimiser test-svd", "another plug-in"});
}

TEST(Slam6dBadPlugins, UnknownWordsListThoseOfPluginsAsWell)
{
  for (const auto& [option, words] :
       {std::pair("minimiser", "|quaternion-linear|test-svd"),
        std::pair("plane-minimiser", "linear|helix|test-linear"),
        std::pair("search", "|brute-force|flann|test-brute"),
        std::pair("filter", "|scanline-both|test-low"),
        std::pair("format", "pts, csv or txt, or test-triples")})
    expectRefused(
        {"--plugin", pluginFile("good"), std::string("--") + option, "unknown"},
        {std::string("--") + option, "unknown", words});
  expectRefused({"--minimiser", "test-svd"}, {"--minimiser", "quaternion-linear"});
}

TEST(Slam6dBadPlugins, PartsThatFailAtWork)
{
  struct Case {
    PluginWords words, message;
  };
  const std::string file = pluginFile("faulty");
  const std::vector<Case> cases = {
      {{"--metric", "point", "--minimiser", "throws"},
       {"minimiser throws of", "no motion today"}},
      {{"--metric", "point", "--minimiser", "throws-a-number"},
       {"minimiser throws-a-number of", "no std::exception"}},
      {{"--metric", "point", "--minimiser", "scales"}, {"no rigid motion"}},
      {{"--plane-minimiser", "nan"}, {"plane minimiser nan", "no rigid motion"}},
      {{"--search", "beyond"}, {"search beyond of", "found point"}},
      {{"--search", "empty"}, {"search empty of", "made no search"}},
      {{"--search", "throws"}, {"no tree today"}},
      {{"--filter", "hollow"}, {"scan000.xyz", "bytes of the cloud = 0"}},
      {{"--filter", "fieldless"}, {"scan000.xyz", "no field 'x'"}},
      {{"--filter", "throws"}, {"scan000.xyz", "filter throws of", "no points today"}},
      {{"--format", "hollow"}, {"scan000.xyz", "bytes of the cloud = 0"}},
      {{"--format", "throws"}, {"scan000.xyz", "reader throws of", "no file today"}}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.words.back());
    PluginWords words = {"--plugin", file};
    words.insert(words.end(), one.words.begin(), one.words.end());
    const PluginRun run(words);
    expectError(run.outcome, "pcl_slam6d", 1, one.message);
  }
}

/** All or nothing. */
TEST(Plugins, PartsOfARefusedPluginAreNotTakenIn)
{
  pcl6d::Plugins plugins;
  plugins.load(pluginFile("good"));
  for (const char* const name : {"refused_1", "refused_2", "refused_3", "refused_6"})
    EXPECT_THROW(plugins.load(pluginFile(name)), pcl6d::BadArgument);
  for (const char* const name : {"refused_4", "refused_5", "other_abi", "plain"})
    EXPECT_THROW(plugins.load(pluginFile(name)), pcl6d::IoFailed);
  EXPECT_EQ(plugins.loaded().size(), 1u);
  EXPECT_EQ(plugins.minimisers().names(), std::vector<std::string>{"test-svd"});
}
