// SPDX-License-Identifier: BSD-3-Clause
// The table that binds the options of a program to its variables.
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/options/option_words.h"
#include "common/printable.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>

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
  std::optional<double> height;
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
  table.addAuto("height", &s.height).help("[m] of anything");
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
  EXPECT_EQ(parsed({"a", "--height", "nan"}).title,
            "--height = nan, but must be a number");
  EXPECT_EQ(parsed({"a", "--height", "-inf"}).height, -kNoBound);
  EXPECT_EQ(parsed({"a", "--colour", "x"}).title,
            "--colour = x, but must be red or blue");
  EXPECT_EQ(parsed({}).title, "SCAN is missing");
  EXPECT_EQ(
      parsed({"a", "b"}).title,
      "too many arguments; expected SCAN, and everything else with the name of its "
      "option");
}

TEST(OptionTable, EmptyTextsNameNothing)
{
  EXPECT_EQ(parsed({""}).title, "SCAN is empty");
  EXPECT_EQ(parsed({"a.pcd", "--config", ""}).title, "--config is empty");
  EXPECT_EQ(parsed({"a.pcd", "--title", ""}).title, "--title is empty");
  EXPECT_EQ(parsed({"a.pcd", "--poses", ""}).title, "--poses is empty");
  EXPECT_EQ(parsed({"a.pcd", "-m", "chair", "", "table"}).title, "--model is empty");
  const pcl6d::test::TempFolder folder;
  const std::string file = folder / "some.cfg";
  pcl6d::test::writeText(file, "count = 2\nposes =\n");
  EXPECT_EQ(parsed({"a.pcd", "--config", file}).title,
            file + ": line 2: --poses is empty");
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

TEST(OptionTable, AMistypedOptionIsAnsweredWithTheOneMeant)
{
  EXPECT_EQ(parsed({"a", "--cuont", "3"}).title,
            "unrecognised option '--cuont'; did you mean --count?");
  EXPECT_EQ(parsed({"a", "--color", "red"}).title,
            "unrecognised option '--color'; did you mean --colour?");
  EXPECT_EQ(parsed({"a", "--elephant"}).title, "unrecognised option '--elephant'");
  EXPECT_EQ(nearestWord("", {"a", "b"}), "");
  EXPECT_EQ(nearestWord("--voxel", {}), "");
  EXPECT_EQ(nearestWord("ab", {"ac"}), "") << "more than one letter in three";
  EXPECT_EQ(nearestWord("abc", {"xbd", "abd", "xbc"}), "abd") << "the first of equals";
  EXPECT_EQ(nearestWord("abcdef", {"xbcdef", "abcdefg"}), "xbcdef");
}

TEST(OptionTable, AValueThatCannotBeReadIsAnsweredWithWhatTheOptionTakes)
{
  EXPECT_EQ(
      parsed({"a", "--count", "many"}).title,
      "the argument ('many') for option '--count' is invalid; it takes: how many");
}

TEST(OptionTable, ErrorsOfAConfigFileNameFileAndLine)
{
  const pcl6d::test::TempFolder folder;
  const std::string file = (folder / "a.cfg").string();
  const auto errorOf = [&](const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
    const std::string message = parsed({"a", "--config", file}).title;
    EXPECT_EQ(message.rfind(file + ": ", 0), 0u) << message;
    return message.substr(std::min(message.size(), file.size() + 2));
  };
  EXPECT_EQ(errorOf("# how many\n\ncount = 10\n"),
            "line 3: --count = 10, but must be 1 to 9");
  EXPECT_EQ(errorOf("colour = x"), "line 1: --colour = x, but must be red or blue");
  EXPECT_EQ(errorOf("\r\ncuont = 3\r\n"), "line 2: unrecognised option 'cuont'");
  EXPECT_EQ(errorOf("count = 2\ntitle = b\ncount = 3\n"),
            "line 3: option 'count' is given in line 1 already");
  EXPECT_NE(errorOf("count = 2\nnonsense\n").find("line 2: "), std::string::npos);
  EXPECT_NE(errorOf("count = many\n").find("line 1: the argument ('many') for option"),
            std::string::npos);
  EXPECT_EQ(errorOf("[more]\ntitle = c\n").find("line "), 0u)
      << "there are no sections";
  EXPECT_EQ(parsed({"a", "--config", file + ".none"}).title,
            file + ".none: No such file or directory (config file)");
  EXPECT_EQ(parsed({"a", "--config", folder.path().string()}).title,
            folder.path().string() + ": Is a directory (config file)");
}

TEST(OptionTable, TextsThatBoostTakesForItsPlaceholdersAreToldAsTheyAre)
{
  for (const char* text : {"%value%", "%option%", "%canonical_option%", "%%prefix%%"})
    for (const std::string& wrong :
         {std::string("--count=") + text, std::string("--") + text}) {
      Settings s;
      try {
        tableOf(s).parse({"a.pcd", wrong});
        ADD_FAILURE() << wrong;
      } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find(text), std::string::npos) << e.what();
      }
    }
  const pcl6d::test::TempFolder folder;
  const std::string file = (folder / "options.txt").string();
  std::ofstream(file) << "range %canonical_option% = auto\n";
  const std::string words = parsed({"a.pcd", "--config", file}).title;
  EXPECT_NE(words.find("line 1"), std::string::npos) << words;
  EXPECT_NE(words.find("range %canonical_option%"), std::string::npos) << words;
}

TEST(OptionTable, TheCommandLineHidesWhatIsWrongInTheConfigFile)
{
  const pcl6d::test::TempFolder folder;
  std::ofstream(folder / "a.cfg") << "count = 10\nmodel = chair\nmodel = table\n";
  const Settings s =
      parsed({"a", "--config", (folder / "a.cfg").string(), "--count", "6"});
  EXPECT_EQ(s.count, 6);
  EXPECT_EQ(s.models, (std::vector<std::string>{"chair", "table"}));
}

/** \return the settings after a run brought options, or the message as the title */
Settings
brought(const std::vector<std::pair<std::string, std::string>>& options,
        const Arguments& more = {})
{
  Settings s;
  std::string run;
  OptionTable table = tableOf(s);
  table.add("continue", &run);
  table.bringOptions("continue", [&](const std::string& value) {
    return BroughtOptions{value + "/summary.json", options};
  });
  Arguments arguments = {"a", "--continue", "run"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  try {
    table.parse(arguments);
  } catch (const pcl6d::IoFailed& e) {
    s.title = e.what();
  }
  return s;
}

TEST(OptionTable, ABroughtValueIsOneWhateverItHolds)
{
  const Settings s =
      brought({{"title", "a\ncount = 9\n[x]\n# y"}, {"no-labels", "yes"}});
  EXPECT_EQ(s.title, "a\ncount = 9\n[x]\n# y");
  EXPECT_EQ(s.count, 3);
  EXPECT_FALSE(s.labels);
  EXPECT_EQ(brought({{"count", "4"}}, {"--count", "5"}).count, 5);
}

TEST(OptionTable, BroughtValuesObeyTheRules)
{
  EXPECT_EQ(brought({{"count", "10"}}).title,
            "run/summary.json: option 'count': --count = 10, but must be 1 to 9");
  EXPECT_NE(brought({{"count", "4\ntitle = x"}})
                .title.find("run/summary.json: option 'count': the argument"),
            std::string::npos);
  EXPECT_EQ(brought({{"config", "x"}}).title,
            "run/summary.json: option 'config': no option has this name");
}

TEST(OptionTable, NumbersAreReadWhateverTheLocale)
{
  for (const char* text : {"2,5", "0x10", "1e999", "", "2 5", "2.5x"}) {
    std::istringstream stream(text);
    AutoNumber number;
    std::string rest;
    EXPECT_FALSE(stream >> number && !(stream >> rest)) << text;
  }
}

TEST(CheckOption, RenamesFieldsWhateverTheLengthOfTheirValues)
{
  const std::string value(10'000'000, '7'); // a million took all of the stack once
  try {
    checkOption("robust", [&] {
      throw pcl6d::BadArgument("kernel = " + value + ", but must be huber");
    });
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 15), "--robust = 7777");
    EXPECT_NE(std::string(error.what()).find(", but must be huber"), std::string::npos);
  }
  try {
    checkOption("robust", [] { throw pcl6d::BadArgument("2 = 3, but is not"); });
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()), "2 = 3, but is not");
  }
}

TEST(RefuseInputs, FilesOfARunAreInputs)
{
  const pcl6d::test::TempFolder folder;
  const std::filesystem::path run = folder / "run";
  std::filesystem::create_directories(run / "scans");
  for (const char* const file : {"scans/scan000.pcd", "links.csv", "report.html"})
    std::ofstream(run / file) << "content";
  EXPECT_NO_THROW(refuseInputs(run / "links.csv", {run})) << "no run yet";
  std::ofstream(run / "summary.json") << "{}";
  for (const char* const file :
       {"summary.json", "scans/scan000.pcd", "links.csv", "scans/../summary.json"})
    EXPECT_THROW(refuseInputs(run / file, {run}), UsageError) << file;
  for (const char* const file : {"report.html", "new.json"})
    EXPECT_NO_THROW(refuseInputs(run / file, {run})) << file;
  EXPECT_NO_THROW(refuseInputs(folder / "summary.json", {run, "", "none"}));
}

TEST(RefuseSameOutput, SeesThroughLinksAndDots)
{
  const pcl6d::test::TempFolder folder;
  std::filesystem::create_directory(folder / "a");
  std::filesystem::create_directory_symlink(folder / "a", folder / "b");
  const std::string one = folder / "a/x.json", other = folder / "b/./x.json";
  EXPECT_THROW(refuseSameOutput("--json", one, "--output", other), UsageError);
  EXPECT_NO_THROW(refuseSameOutput("--json", one, "--output", folder / "x.json"));
  EXPECT_NO_THROW(refuseSameOutput("--json", "", "--output", ""));
}

TEST(Printable, ShowsControlCharactersAndWhatIsNoText)
{
  EXPECT_EQ(printable("s\xc3\xa4ule \xe2\x82\xac"), "s\xc3\xa4ule \xe2\x82\xac");
  EXPECT_EQ(printable("a\nb\x1b[2J\x7f"), "a\\nb\\x1b[2J\\x7f");
  EXPECT_EQ(printable("s\xe4ule"), "s\\xe4ule") << "Latin-1";
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "an escape of 8 bits";
  EXPECT_EQ(printable("cut \xe2\x82"), "cut \\xe2\\x82");
  EXPECT_EQ(printableLines("a\nb\r\n"), "a\nb\\x0d\n");
  const std::string line = printable("begin" + std::string(100000, 'x') + "end");
  EXPECT_LT(line.size(), 1020u);
  EXPECT_EQ(line.substr(0, 6), "beginx");
  EXPECT_EQ(line.substr(line.size() - 4), "xend");
  std::string euros;
  for (int i = 0; i < 1000; ++i)
    euros += "\xe2\x82\xac";
  EXPECT_EQ(printable(printable(euros)), printable(euros)) << "no half characters";
}
} // namespace
