// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_objects train as a user runs it.
#include "support/run_program.h"

#include <gtest/gtest.h>

namespace {
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::writeText;

constexpr const char* kName = "pcl_slam6d_objects";

/** A folder with a cupboard of 0.6 m x 0.5 m x 1.6 m and a scan of a flat. */
struct Train : testing::Test {
  Train()
  {
    writeText(name("box.obj"), cupboard(1));
    const auto made = pcl6d::test::runProgram(
        "pcl_slam6d_simulate", {"corridor", "-o", name("scans"), "--scans", "2"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
  }
  static std::string
  cupboard(double unit)
  {
    std::string text;
    for (int i = 0; i < 8; ++i)
      text += "v " + std::to_string(unit * (i & 1 ? 0.6 : 0)) + " " +
              std::to_string(unit * (i & 2 ? 0.5 : 0)) + " " +
              std::to_string(unit * (i & 4 ? 1.6 : 0)) + "\n";
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\n";
  }
  std::string
  name(const std::string& file) const
  {
    return folder / file;
  }
  Outcome
  train(const std::vector<std::string>& more,
        const std::string& model = "box.obj") const
  {
    std::vector<std::string> arguments = {"train", name(model)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return pcl6d::test::runProgram(kName, arguments);
  }
  std::vector<std::string>
  small(const std::string& output) const
  {
    return {"--background",
            name("scans"),
            "-o",
            name(output),
            "--positives",
            "60",
            "--negatives",
            "200",
            "--stages",
            "2",
            "--features-per-stage",
            "300",
            "--max-distance",
            "3",
            "--quiet"};
  }
  pcl6d::test::TempFolder folder;
};
} // namespace

TEST_F(Train, WritesACascadeAndGoesOnFromItsState)
{
  const Outcome outcome = train(small("a.xml"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("false-alarm"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n    2 "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("hit rate "), std::string::npos) << outcome.out;
  const std::string first = readText(name("a.xml"));
  EXPECT_NE(first.find("<objectSize>2</objectSize>"), std::string::npos);
  EXPECT_NE(readText(name("a.training/training.json")).find("\"hit_rate\""),
            std::string::npos);
  std::filesystem::remove(name("a.xml"));
  ASSERT_EQ(train(small("a.xml")).exit_code, 0); // nothing left to be trained
  EXPECT_EQ(readText(name("a.xml")), first);
  auto other = small("a.xml");
  other.insert(other.end(), {"--seed", "2"});
  pcl6d::test::expectError(
      train(other), kName, 1, {"training.json", "a training with different images"});
  other.insert(other.end(), {"--state", name("other")});
  EXPECT_EQ(train(other).exit_code, 0);
}

TEST_F(Train, NamesWhatIsWrong)
{
  const auto refused = [&](const std::vector<std::string>& more,
                           int code,
                           const std::vector<std::string>& words,
                           const std::string& model = "box.obj") {
    pcl6d::test::expectError(train(more, model), kName, code, words);
    EXPECT_FALSE(std::filesystem::exists(name("x.xml")));
  };
  const auto with = [&](const std::vector<std::string>& more) {
    auto all = small("x.xml");
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  writeText(name("mm.obj"), cupboard(1000));
  refused(small("x.xml"), 1, {"mm.obj", "millimetres", "0.001"}, "mm.obj");
  writeText(name("empty.obj"), "");
  refused(small("x.xml"), 1, {"empty.obj"}, "empty.obj");
  refused(small("x.xml"), 1, {"none.ply"}, "none.ply");
  refused({"-o", name("x.xml")}, 2, {"background"});
  refused({"-o", name("x.xml"), "--background", name("none")}, 1, {"none"});
  std::filesystem::create_directory(name("empty"));
  refused({"-o", name("x.xml"), "--background", name("empty")}, 1, {"empty"});
  refused(with({"--channel", "colour"}), 2, {"--channel = colour"});
  refused(with({"--scanner", "radar"}), 2, {"--scanner = radar"});
  refused(with({"--max-false-alarm", "1"}), 2, {"--max-false-alarm = 1"});
  refused(with({"--max-range", "1e10"}), 2, {"--max-range = 1e+10", "5000 times"});
  refused({"--background", name("scans"), "-o", name("x.xml"), "--positives", "16384"},
          2,
          {"--positives = 16384", "16383"});
  refused(with({"--min-distance", "4"}), 2, {"--max-distance = 3"});
  pcl6d::test::expectError(
      pcl6d::test::runProgram(kName, {"find"}), kName, 2, {"'find'", "train"});
  pcl6d::test::expectError(
      pcl6d::test::runProgram(kName, {"paint"}), kName, 2, {"train"});
  EXPECT_EQ(pcl6d::test::runProgram(kName, {"train", "--help"}).exit_code, 0);
}
