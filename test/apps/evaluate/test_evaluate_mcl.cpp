// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate mcl as a user runs it.
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
constexpr const char* kName = "pcl_slam6d_evaluate";

/** Two groups of houses with a field between them where nothing stands. */
constexpr const char* kScene = R"({
  "name": "field", "scans": 48, "max_range": 30,
  "materials": {"brick": {"reflectance": 0.5, "label": "wall"}},
  "bodies": [
    {"type": "box", "centre": [60, 0, -0.5], "size": [300, 120, 1]},
    {"type": "box", "material": "brick", "centre": [8, 14, 3], "size": [24, 12, 6]},
    {"type": "box", "material": "brick", "centre": [4, -13, 3], "size": [14, 10, 6]},
    {"type": "box", "material": "brick", "centre": [-14, 0, 3], "size": [6, 10, 6]},
    {"type": "box", "material": "brick", "centre": [24, -15, 3], "size": [12, 10, 6]},
    {"type": "box", "material": "brick", "centre": [112, 14, 3], "size": [26, 10, 6]},
    {"type": "box", "material": "brick", "centre": [108, -13, 3], "size": [16, 10, 6]},
    {"type": "box", "material": "brick", "centre": [132, -14, 3], "size": [14, 12, 6]},
    {"type": "box", "material": "brick", "centre": [146, 6, 3], "size": [6, 24, 6]}],
  "waypoints": [[0, 0, 0], [60, 1, 0], [128, 0, 0]]
})";

/** The walls that were seen, from one end to the other, in the world of the poses. */
std::vector<std::array<double, 4>>
wallsOf(const std::string& planes_truth)
{
  std::vector<std::array<double, 4>> walls;
  const auto json = nlohmann::json::parse(planes_truth);
  for (const auto& plane : json["planes"]) {
    if (plane["label"] != "wall" || plane["inliers"] == 0)
      continue;
    std::array<double, 4> wall{};
    for (const auto& a : plane["hull"])
      for (const auto& b : plane["hull"])
        if (std::hypot(double(b[0]) - double(a[0]), double(b[1]) - double(a[1])) >
            std::hypot(wall[2] - wall[0], wall[3] - wall[1]))
          wall = {a[0], a[1], b[0], b[1]};
    walls.push_back(wall);
  }
  return walls;
}

/** The scans of the field, simulated once. */
struct Field : TempFolder {
  Field()
  {
    writeText(*this / "field.json", kScene);
    const Outcome outcome =
        runProgram("pcl_slam6d_simulate",
                   {*this / "field.json", "-o", *this / "scans", "--resolution", "2"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::ofstream plan(*this / "plan.csv");
    plan << "x1,y1,x2,y2\n";
    for (const auto& w : wallsOf(readText(*this / "scans/planes_truth.json")))
      plan << w[0] << ',' << w[1] << ',' << w[2] << ',' << w[3] << '\n';
  }
  std::string
  name(const std::string& file) const
  {
    return *this / file;
  }
};

const Field&
field()
{
  static const Field field;
  return field;
}

Outcome
mcl(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), {"mcl", field().name("scans")});
  return runProgram(kName, arguments);
}

void
expectRefused(const std::vector<std::string>& arguments,
              int code,
              const std::vector<std::string>& words)
{
  pcl6d::test::expectError(mcl(arguments), kName, code, words);
}

using Row = std::vector<std::string>;

std::vector<Row>
rowsOf(const std::string& csv)
{
  std::vector<Row> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream fields(line + ",");
    for (std::string value; std::getline(fields, value, ',');)
      rows.back().push_back(value);
  }
  return rows;
}

/** The field localised in the planes of the scene, once. */
const nlohmann::json&
localised()
{
  static const nlohmann::json json = [] {
    const auto outcome = mcl({"--map",
                              field().name("scans/planes_truth.json"),
                              "--reference",
                              field().name("scans/groundtruth.txt"),
                              "-o",
                              field().name("out")});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_NE(outcome.out.find("few walls"), std::string::npos) << outcome.out;
    return nlohmann::json::parse(readText(field() / "out/mcl.json"));
  }();
  return json;
}
} // namespace

TEST(EvaluateMcl, MarksTheFieldAndIsRightElsewhere)
{
  const auto& json = localised();
  EXPECT_EQ(json["scans"], 48);
  EXPECT_GT(json["trusted"], 30);
  EXPECT_LT(json["errors"]["trusted"]["position_2d"]["rms"], 0.1);
  EXPECT_LT(json["errors"]["trusted"]["yaw"]["rms"], 0.5 * M_PI / 180);
  // The houses are out of range, 30 m, from x = 60 to 69; less than 10 columns before.
  const bool has_middle = std::any_of(
      json["doubtful"].begin(), json["doubtful"].end(), [](const auto& interval) {
        return interval["first"] > 15 && interval["first"] < 25 &&
               interval["last"] >= 24 && interval["last"] < 32 &&
               interval["reason"] == "few walls";
      });
  EXPECT_TRUE(has_middle) << json["doubtful"];
}

TEST(EvaluateMcl, WritesPathsAndATable)
{
  const auto& json = localised();
  const auto rows = rowsOf(readText(field() / "out/mcl.csv"));
  ASSERT_EQ(rows.size(), 49u);
  EXPECT_EQ(rows[0][0], "scan");
  std::size_t trusted = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), rows[0].size());
    EXPECT_EQ(rows[i][0], std::to_string(i - 1));
    trusted += rows[i][10] == "1";
    EXPECT_EQ(rows[i][10] == "1", rows[i][11].empty()) << "a reason, or trusted";
    EXPECT_LT(std::stod(rows[i][4]), rows[i][10] == "1" ? 0.5 : 50);
  }
  EXPECT_EQ(json["trusted"], trusted);
  const auto lines = [](const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  };
  EXPECT_EQ(lines(readText(field() / "out/reference.kitti")), 48u);
  EXPECT_EQ(lines(readText(field() / "out/reference.tum")), trusted)
      << "nothing is invented where it is not trusted";
}

TEST(EvaluateMcl, TheReferenceServesToEvaluateATrajectory)
{
  const auto& json = localised();
  const std::string truth = field().name("scans/groundtruth.txt");
  const auto compared = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"trajectory", truth});
    const auto outcome = runProgram(kName, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string kitti = field().name("out/reference.kitti");
  const std::string csv = field().name("out/mcl.csv");
  const auto by_table =
      nlohmann::json::parse(compared({kitti, "--trusted", csv, "--json", "-"}));
  const auto by_tum = nlohmann::json::parse(
      compared({field().name("out/reference.tum"), "--json", "-"}));
  EXPECT_EQ(by_table["pairs"], json["trusted"]);
  EXPECT_EQ(by_table["untrusted"], 48 - json["trusted"].get<int>());
  EXPECT_EQ(by_tum["pairs"], json["trusted"]);
  EXPECT_DOUBLE_EQ(by_table["without_alignment"]["position_2d"]["rms"],
                   by_tum["without_alignment"]["position_2d"]["rms"]);
  EXPECT_NE(compared({kitti, "--trusted", csv}).find("doubtful reference"),
            std::string::npos);
}

TEST(EvaluateMcl, TrajectoryRefusesATableThatDoesNotFit)
{
  const std::string truth = field().name("scans/groundtruth.txt");
  const auto refused = [&](const std::string& table,
                           const std::vector<std::string>& words) {
    writeText(field() / "table.csv", table);
    pcl6d::test::expectError(
        runProgram(
            kName,
            {"trajectory", truth, truth, "--trusted", field().name("table.csv")}),
        kName,
        1,
        words);
  };
  refused("", {"table.csv", "empty"});
  refused("scan,x\n0,1\n", {"line 1", "'trusted'"});
  refused("scan,trusted\n", {"no row"});
  refused("scan,trusted\n0,1\n1\n", {"line 3", "2 fields", "got 1"});
  refused("scan,trusted\n0,yes\n", {"line 2", "'yes'", "0 or 1"});
  refused("scan,trusted\n0,1\n", {"1 poses", "48"});
}

TEST(EvaluateMcl, HasTheSameBytesForAnyNumberOfThreads)
{
  localised();
  mcl({"--map",
       field().name("scans/planes_truth.json"),
       "--threads",
       "3",
       "-o",
       field().name("three")});
  for (const char* file : {"mcl.csv", "reference.kitti", "reference.tum"})
    EXPECT_EQ(readText(field() / "three" / file), readText(field() / "out" / file))
        << file;
}

TEST(EvaluateMcl, StartsWhereItIsToldInNationalCoordinates)
{
  // The plan far away and turned by 90 deg: (x, y) becomes (X - y, Y + x).
  std::ostringstream plan;
  plan << std::setprecision(17);
  for (const auto& row : rowsOf(readText(field() / "plan.csv")))
    if (row[0] != "x1")
      for (int i = 0; i < 4; i += 2)
        plan << 434812.5 - std::stod(row[i + 1]) << ',' << 5792541 + std::stod(row[i])
             << (i == 0 ? ',' : '\n');
  writeText(field() / "far.csv", plan.str());
  const auto outcome = mcl({"--map",
                            field().name("far.csv"),
                            "--start",
                            "434812.5 5792541 90",
                            "--last",
                            "30",
                            "--reference",
                            field().name("scans/groundtruth.txt"),
                            "-o",
                            field().name("far")});
  ASSERT_EQ(outcome.exit_code, 3) << outcome.err;
  const auto json = nlohmann::json::parse(readText(field() / "far/mcl.json"));
  EXPECT_GT(json["trusted"], 15) << outcome.out << outcome.err;
  EXPECT_LT(json["errors"]["trusted"]["position_2d"]["rms"], 0.15);
  const auto rows = rowsOf(readText(field() / "far/mcl.csv"));
  std::istringstream truth(readText(field() / "scans/groundtruth.txt"));
  std::string line;
  for (int i = 0; i <= 10; ++i)
    std::getline(truth, line);
  std::istringstream values(line);
  double x = 0;
  for (int i = 0; i < 4; ++i)
    values >> x;
  EXPECT_GT(std::abs(x), 10);
  EXPECT_NEAR(std::stod(rows[11][2]) - 5792541, x, 0.5) << "ahead is north";
}

TEST(EvaluateMcl, RefusesAWrongCommandLine)
{
  const std::string map = field().name("plan.csv");
  expectRefused({}, 2, {"--map"});
  expectRefused({"--map", map, "--start", "here"}, 2, {"--start", "3 finite numbers"});
  expectRefused({"--map", map, "--map-slice", "2 1"}, 2, {"--map-slice HIGH = 1"});
  expectRefused({"--map", map, "--map-scale", "0"}, 2, {"--map-scale = 0"});
  expectRefused({"--map", map, "--particles", "0"}, 2, {"--particles = 0"});
  expectRefused({"--map", map, "--particles", "9", "--max-particles", "8"},
                2,
                {"--max-particles = 8"});
  expectRefused({"--map", map, "--level", "floor"}, 2, {"--level = floor"});
  expectRefused({"--map", map, "--hit-sigma", "-1"}, 2, {"--hit-sigma = -1"});
  expectRefused({"--map", map, "--threads", "-1"}, 2, {"--threads = -1"});
}

TEST(EvaluateMcl, NamesWhatIsWrongWithTheMap)
{
  const auto before = contentOf(field() / "scans");
  const auto refused = [&](const std::string& name,
                           const std::string& content,
                           const std::vector<std::string>& words) {
    writeText(field() / name, content);
    expectRefused({"--map", field().name(name), "-o", field().name("none")}, 1, words);
    EXPECT_FALSE(fs::exists(field() / "none"));
  };
  refused("no.csv", "x1,y1,x2,y2\n", {"no.csv", "no line segment"});
  refused("nan.csv", "0,0,nan,1\n", {"nan.csv", "line 1"});
  refused("no.json", R"({"schema_version": 1, "planes": []})", {"no.json", "wall"});
  refused("bad.json", "{", {"bad.json"});
  refused(
      "bad.svg", "<svg><path d='M0 0C1 1 2 2 3 3'/></svg>", {"bad.svg", "command C"});
  refused("no.xyz", "0 0 0\n", {"no.xyz", ".geojson"});
  refused(
      "flat.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n",
      {"flat.ply", "no upright surface", "--map-slice"});
  expectRefused({"--map", field().name("missing.csv")}, 1, {"missing.csv"});
  EXPECT_EQ(contentOf(field() / "scans"), before);
}

TEST(EvaluateMcl, NamesWhatIsWrongWithPosesAndReference)
{
  const std::string map = field().name("plan.csv");
  writeText(field() / "two.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 2 0 1 0 0 0 0 1 0\n");
  expectRefused({"--map", map, "--reference", field().name("two.txt")},
                1,
                {"two.txt", "2 poses", "48"});
  const TempFolder bare;
  fs::copy_file(field() / "scans/scan000.pcd", bare / "scan000.pcd");
  pcl6d::test::expectError(
      runProgram(kName, {"mcl", bare / "", "--map", map}), kName, 1, {"no poses"});
}
