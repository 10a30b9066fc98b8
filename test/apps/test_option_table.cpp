// SPDX-License-Identifier: BSD-3-Clause
// The table that binds the options of a program to its variables.
#include "common/app.h"
#include "common/option_table.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace {
using namespace pcl6d::app;
using Arguments = std::vector<std::string>;

enum class Colour { kRed, kBlue };

/** One option of each kind. */
struct Settings {
  int count = 3;
  unsigned int threads = 2;
  bool quiet = false;
  bool labels = true;
  std::optional<double> voxel;
  std::optional<int> last;
  Colour colour = Colour::kBlue;
  std::string title = "map";
  std::filesystem::path poses;
  std::vector<std::string> models;
  std::string scan;
};

OptionTable
tableOf(Settings& s)
{
  OptionTable table("usage: test SCAN\n");
  table.positional("SCAN", &s.scan);
  table.group("Input");
  table.add("count N", &s.count).within(1, 9, "1 to 9").help("how many");
  table.addAs<int>("threads", &s.threads).within(0, 4, ">= 0").help("at once");
  table.add("quiet", &s.quiet).help("no progress");
  table.add("no-labels", &s.labels).help("planes only");
  table.addAuto("voxel", &s.voxel, 0.01).above(0, "> 0").help("[cm] edge");
  table.add("last", &s.last).otherwise("end").help("index");
  table.add("colour", &s.colour, {{"red", Colour::kRed}, {"blue", Colour::kBlue}})
      .help("red|blue");
  table.add("title", &s.title).help("on top");
  table.add("poses FILE", &s.poses).help("a file");
  table.add("model,m MODEL", &s.models).composing().multitoken().help("shapes");
  return table;
}

/** \return the settings, or the message of the UsageError as the title */
Settings
parsed(const Arguments& arguments)
{
  Settings s;
  try {
    tableOf(s).parse(arguments);
  } catch (const UsageError& e) {
    s.title = e.what();
  }
  return s;
}

TEST(OptionTable, VariablesKeepTheirDefaultsUnlessGiven)
{
  const Settings s = parsed({"a.pcd"});
  EXPECT_EQ(s.scan, "a.pcd");
  EXPECT_EQ(s.count, 3);
  EXPECT_TRUE(s.labels);
  EXPECT_FALSE(s.quiet || s.voxel || s.last);
  EXPECT_EQ(s.colour, Colour::kBlue);
}

TEST(OptionTable, SetsVariablesOfEachKind)
{
  const Settings s = parsed({"a.pcd",
                             "--count",
                             "5",
                             "--threads=4",
                             "--quiet",
                             "--no-labels",
                             "--voxel",
                             "25",
                             "--last",
                             "7",
                             "--colour",
                             "red",
                             "--poses",
                             "my poses.txt",
                             "-m",
                             "chair",
                             "table"});
  EXPECT_EQ(s.count, 5);
  EXPECT_EQ(s.threads, 4U);
  EXPECT_TRUE(s.quiet);
  EXPECT_FALSE(s.labels);
  EXPECT_DOUBLE_EQ(s.voxel.value(), 0.25);
  EXPECT_EQ(s.last, 7);
  EXPECT_EQ(s.colour, Colour::kRed);
  EXPECT_EQ(s.poses, "my poses.txt");
  EXPECT_EQ(s.models, (std::vector<std::string>{"chair", "table"}));
  EXPECT_FALSE(parsed({"a.pcd", "--voxel", "auto"}).voxel);
}

TEST(OptionTable, ErrorsNameTheOptionItsValueAndTheRule)
{
  EXPECT_EQ(parsed({"a", "--count", "10"}).title, "--count = 10, but must be 1 to 9");
  EXPECT_EQ(parsed({"a", "--threads", "-1"}).title, "--threads = -1, but must be >= 0");
  EXPECT_EQ(parsed({"a", "--voxel", "nan"}).title, "--voxel = nan, but must be > 0");
  EXPECT_EQ(parsed({"a", "--colour", "x"}).title,
            "--colour = x, but must be red or blue");
  EXPECT_EQ(parsed({}).title, "SCAN is missing");
  EXPECT_EQ(
      parsed({"a", "b"}).title,
      "too many arguments; expected SCAN, and everything else with the name of its "
      "option");
  EXPECT_THROW(parsed({"a", "--count", "many"}), boost::program_options::error);
}

TEST(OptionTable, WordsAreAsGivenOrByDefault)
{
  Settings s;
  OptionTable table = tableOf(s);
  table.parse({"a", "--voxel", "2.50", "--no-labels"});
  std::string all;
  for (const auto& word : table.words({"voxel", "no-labels", "quiet", "last", "count"}))
    all += word.name + '=' + word.value + (word.given ? "! " : " ");
  EXPECT_EQ(all, "voxel=2.5! no-labels=yes! quiet=no last=end count=3 ");
  EXPECT_EQ(table.withoutEffect({{"voxel", false, "of folders"}, {"last", false, ""}}),
            "no effect in this run: --voxel (of folders)");
  EXPECT_THROW(table.needFolder("no_folder", {"last", "voxel"}), UsageError);
}

TEST(OptionTable, TheCommandLineWinsOverTheConfigFile)
{
  const pcl6d::test::TempFolder folder;
  std::ofstream(folder / "a.cfg") << "count = 4\ntitle = house\nno-labels = yes\n";
  const Settings s =
      parsed({"a", "--config", (folder / "a.cfg").string(), "--count", "6"});
  EXPECT_EQ(s.count, 6);
  EXPECT_EQ(s.title, "house");
  EXPECT_FALSE(s.labels);
}

TEST(OptionTable, HelpShowsOperandsAndDefaults)
{
  Settings s;
  testing::internal::CaptureStdout();
  EXPECT_FALSE(tableOf(s).parse({"--help"}));
  const std::string help = testing::internal::GetCapturedStdout();
  for (const char* line : {"usage: test SCAN\n\nInput:\n  --count N (=3)",
                           "\n  --quiet ",
                           "\n  --voxel arg (=auto) ",
                           "\n  --last arg ",
                           "\n  --colour arg (=blue) ",
                           "\n  --poses FILE ",
                           "\n  -m, --model MODEL ",
                           "\n\nGeneral options:\n  --config FILE "})
    EXPECT_NE(help.find(line), std::string::npos) << line << "\nin\n" << help;
}
} // namespace
