// SPDX-License-Identifier: BSD-3-Clause
// Suite files with mistakes: all are told before anything runs.
#include "apps/evaluate/suite_test.h"
#include "apps/support/bad_input.h"

#include <functional>

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using pcl6d::test::expectError;
using pcl6d::test::SuiteTest;
using pcl6d::test::writeText;

namespace {
class SuiteBadInput : public SuiteTest {
protected:
  void
  expectRefusedWith(const std::function<void(Json&)>& change,
                    const std::vector<std::string>& words)
  {
    Json suite = smallSuite();
    change(suite);
    auto all = words;
    all.push_back("small.json: ");
    expectRefused(suite.dump(), all);
  }
};
} // namespace

TEST_F(SuiteBadInput, NamesTheOptionThatPclSlam6dDoesNotKnow)
{
  expectRefusedWith([](Json& s) { s["methods"]["pairwise"]["metrc"] = "point"; },
                    {"/methods/pairwise/metrc: ", "unrecognised option"});
  expectRefusedWith([](Json& s) { s["defaults"]["relaxations"] = "none"; },
                    {"/defaults/relaxations: "});
  expectRefusedWith([](Json& s) { s["data"]["corridor"]["options"]["lst"] = 3; },
                    {"/data/corridor/options/lst: "});
}

TEST_F(SuiteBadInput, NamesTheValueThatAnOptionDoesNotTake)
{
  expectRefusedWith([](Json& s) { s["methods"]["metascan"]["metric"] = "pint"; },
                    {"/methods/metascan/metric: ", "--metric = pint", "point"});
  expectRefusedWith([](Json& s) { s["methods"]["metascan"]["voxel"] = -1; },
                    {"/methods/metascan/voxel: ", "--voxel = -1"});
  expectRefusedWith([](Json& s) { s["methods"]["metascan"]["iterations"] = "many"; },
                    {"/methods/metascan/iterations: ", "many"});
  expectRefusedWith([](Json& s) { s["methods"]["metascan"]["deskew"] = "perhaps"; },
                    {"/methods/metascan/deskew: ", "odometry, estimate"});
  expectRefusedWith(
      [](Json& s) {
        s["methods"]["metascan"]["voxel"] = {1, 2};
      },
      {"/methods/metascan/voxel: ", "expected a number"});
  expectRefusedWith([](Json& s) { s["methods"]["metascan"]["graph-in"] = "no.g2o"; },
                    {"/methods/metascan/graph-in: ", "no.g2o"});
  expectRefusedWith([](Json& s) { s["data"]["corridor"]["options"]["first"] = 99; },
                    {"/data/corridor", "99"});
}

TEST_F(SuiteBadInput, KeepsWhatIsItsOwnBusiness)
{
  for (const char* name : {"output", "config", "continue", "force", "help"})
    expectRefusedWith([&](Json& s) { s["methods"]["pairwise"][name] = "x"; },
                      {std::string("/methods/pairwise/") + name, "not for suites"});
}

TEST_F(SuiteBadInput, NamesFieldsThatAreNotKnownOrMissing)
{
  expectRefusedWith([](Json& s) { s["metods"] = Json::object(); },
                    {": /: ", "'metods'", "methods"});
  expectRefusedWith([](Json& s) { s["data"]["corridor"]["fodler"] = "x"; },
                    {"/data/corridor: ", "'fodler'"});
  expectRefusedWith([](Json& s) { s.erase("methods"); }, {"'methods' is missing"});
  expectRefusedWith([](Json& s) { s["methods"] = Json::object(); },
                    {"/methods: ", "at least one"});
  expectRefusedWith([](Json& s) { s["data"]["corridor"].erase("folder"); },
                    {"/data/corridor: ", "'simulate' or 'folder'"});
  expectRefusedWith([](Json& s) { s.erase("schema_version"); }, {"schema_version"});
  expectRefusedWith([](Json& s) { s["schema_version"] = 2; },
                    {"/schema_version: 2, but must be 1"});
  expectRefusedWith([](Json& s) { s["time_limit"] = -1; }, {"/time_limit: -1"});
  expectRefusedWith([](Json& s) { s["repetitions"] = 1.5; }, {"/repetitions: "});
  expectRefusedWith([](Json& s) { s["keep_scans"] = 1; }, {"/keep_scans: 1"});
  expectRefusedWith([](Json& s) { s["methods"] = 3; }, {"/methods: ", "object"});
}

TEST_F(SuiteBadInput, NamesMustBeGoodForFoldersAndThereOnce)
{
  expectRefused(R"({"schema_version": 1, "data": {}, "methods":
                    {"a": {"voxel": 1}, "a": {"voxel": 2}}})",
                {"/methods: ", "'a' is there twice"});
  expectRefused(R"({"schema_version": 1, "methods": {"a": {"voxel": 1, "voxel": 2}}})",
                {"/methods/a: ", "'voxel' is there twice"});
  for (const char* name : {"", "..", "a/b", "a|b"})
    expectRefusedWith([&](Json& s) { s["methods"][name] = Json::object(); },
                      {"/methods: ", "is no name"});
  expectRefusedWith([](Json& s) { s["methods"]["odometry"] = Json::object(); },
                    {"/methods/odometry: ", "initial poses"});
  expectRefusedWith([](Json& s) { s["methods"]["corridor"] = Json::object(); },
                    {"/methods/corridor: ", "data set"});
}

TEST_F(SuiteBadInput, NamesDataThatAreNotThere)
{
  expectRefusedWith([](Json& s) { s["data"]["corridor"]["folder"] = "nowhere"; },
                    {"/data/corridor: ", "nowhere"});
  expectRefusedWith([](Json& s) { s["data"]["corridor"]["reference"] = "none.txt"; },
                    {"/data/corridor/reference: ", "none.txt"});
  expectRefusedWith(
      [](Json& s) {
        s["data"]["corridor"] = {{"simulate", {{"scene", "moon"}}}};
      },
      {"/data/corridor/simulate/scene: ", "moon"});
  expectRefusedWith(
      [](Json& s) {
        s["data"]["corridor"] = {{"simulate", {{"scene", "rooms"}, {"scns", 3}}}};
      },
      {"/data/corridor/simulate/scns: "});
  expectRefusedWith(
      [](Json& s) {
        s["data"]["corridor"] = {{"simulate", {{"scene", "rooms"}, {"scanner", "x"}}}};
      },
      {"/data/corridor/simulate/scanner: ", "--scanner = x"});
}

TEST_F(SuiteBadInput, SeedsMustBeARangeOfASimulation)
{
  const auto seeded = [](Json seeds) {
    return [=](Json& s) {
      s["data"]["corridor"] = {{"simulate", {{"scene", "rooms"}}}, {"seeds", seeds}};
    };
  };
  expectRefusedWith(seeded(3), {"/data/corridor/seeds: ", "first and the last"});
  expectRefusedWith(seeded({1, 2, 3}),
                    {"/data/corridor/seeds: ", "first and the last"});
  expectRefusedWith(seeded({4, 3}), {"/data/corridor/seeds: ", "first <= last"});
  expectRefusedWith(seeded({1, 1001}), {"/data/corridor/seeds: ", "1000"});
  expectRefusedWith(seeded({1.5, 2}), {"/data/corridor/seeds/0: ", "1.5"});
  expectRefusedWith(
      [](Json& s) {
        s["data"]["corridor"]["seeds"] = {1, 2};
      },
      {"/data/corridor/seeds: ", "only simulated"});
  expectRefusedWith(
      [](Json& s) {
        s["data"]["corridor"] = {{"simulate", {{"scene", "rooms"}, {"seed", 1}}},
                                 {"seeds", {1, 2}}};
      },
      {"/data/corridor/seeds: ", "a seed already"});
  expectRefusedWith(
      [](Json& s) {
        s["data"]["corridor"] = {{"simulate", {{"scene", "rooms"}}}, {"seeds", {1, 2}}};
        s["data"]["corridor seed 2"] = {{"simulate", {{"scene", "rooms"}}}};
      },
      {"/data: ", "two data sets are called 'corridor seed 2'"});
}

TEST_F(SuiteBadInput, NamesWhatIsWrongWithADamage)
{
  const auto refused = [&](Json damage, const std::vector<std::string>& words) {
    expectRefusedWith([&](Json& s) { s["damages"]["bad"] = damage; }, words);
  };
  refused({{"swop", {1, 2}}}, {"/damages/bad: ", "'swop' is not known", "swap"});
  refused({{"swap", {1}}}, {"/damages/bad/swap: ", "indices of two scans"});
  refused({{"swap", {2, 2}}}, {"/damages/bad/swap: ", "two different scans"});
  refused({{"swap", {-1, 2}}}, {"/damages/bad/swap", "-1"});
  refused({{"links", {{1, 1}}}}, {"/damages/bad/links/0: ", "two different scans"});
  refused({{"links", {4}}}, {"/damages/bad/links/0: ", "indices of two scans"});
  refused({{"jump", 10}}, {"/damages/bad/jump: ", "index of a scan and metres"});
  refused({{"jump", {0, 10}}}, {"/damages/bad/jump/0: ", "after the first"});
  refused({{"odometry_noise", -1}}, {"/damages/bad/odometry_noise: ", "at least 0"});
  refused({{"odometry_scale", 0}}, {"/damages/bad/odometry_scale: ", "above 0"});
  refused({{"turn", "right"}}, {"/damages/bad/turn: "});
  refused({{"points", 2}}, {"/damages/bad/points: ", "at least 3"});
  refused({{"points", "few"}}, {"/damages/bad/points: "});
  refused({{"no_poses", 1}}, {"/damages/bad/no_poses: "});
  refused({{"no_poses", true}, {"turn", 90}}, {"/damages/bad/no_poses: ", "no poses"});
  refused({{"foreign", 1}}, {"/damages/bad/foreign: ", "no second data set"});
  refused({{"options", {{"voxl", 1}}}}, {"/damages/bad/options/voxl: "});
  refused({{"options", {{"voxel", {1}}}}}, {"/damages/bad/options/voxel: "});
  refused(3, {"/damages/bad: ", "object"});
}

TEST_F(SuiteBadInput, DamagesHaveNamesOfTheirOwnAndWhatTheyNeed)
{
  expectRefusedWith([](Json& s) { s["damages"] = Json::object(); },
                    {"/damages: ", "at least one"});
  expectRefusedWith([](Json& s) { s["damages"]["a/b"] = Json::object(); },
                    {"/damages: ", "is no name"});
  expectRefusedWith([](Json& s) { s["damages"]["corridor"] = Json::object(); },
                    {"/damages/corridor: ", "data set"});
  expectRefusedWith([](Json& s) { s["damages"]["pairwise"] = Json::object(); },
                    {"/methods/pairwise: ", "damage"});
  expectRefusedWith(
      [](Json& s) {
        s["damages"]["noise"] = {{"odometry_noise", 2}};
        s["data"]["corridor"].erase("reference");
      },
      {"/data/corridor: ", "has no reference, needed by odometry_noise of 'noise'"});
  expectRefusedWith([](Json& s) { s["table"] = "trusts"; },
                    {"/table: ", "\"trusts\", but must be \"errors\" or \"trust\""});
}

TEST_F(SuiteBadInput, IsNoJsonOrNotThere)
{
  expectRefused("{\"schema_version\": 1,\n oops}", {"small.json", "no JSON", "line 2"});
  expectError(pcl6d::test::runProgram("pcl_slam6d_evaluate",
                                      {"suite", (folder / "none.json").string()}),
              "pcl_slam6d_evaluate",
              2,
              {"none.json"});
}

TEST_F(SuiteBadInput, RefusesWrongArguments)
{
  const std::string name = "pcl_slam6d_evaluate";
  expectError(run(smallSuite(), {"--only", "pairwse"}), name, 2, {"--only pairwse"});
  expectError(run(smallSuite(), {"--jobs", "0"}), name, 2, {"--jobs = 0"});
  expectError(
      run(smallSuite(), {"--time-limit", "-3"}), name, 2, {"--time-limit = -3"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(SuiteBadInput, RefusesFoldersOfOthers)
{
  const std::string name = "pcl_slam6d_evaluate";
  fs::create_directory(out);
  writeText(out / "thesis.tex", "important");
  expectError(run(smallSuite()), name, 1, {"out: folder is not empty", "--force"});
  fs::remove_all(out);
  writeText(out, "a file");
  expectError(run(smallSuite()), name, 1, {"out: output is a file"});
  fs::remove(out);
  auto suite = smallSuite();
  fs::create_directories(out / "data");
  fs::copy(pcl6d::test::scans(), out / "data" / "mine");
  suite["data"]["corridor"]["folder"] = (out / "data" / "mine").string();
  expectError(run(suite, {"--force"}), name, 1, {"data/mine lies where"});
  EXPECT_TRUE(fs::exists(out / "data" / "mine" / "scan000.pcd"));
}

TEST_F(SuiteBadInput, ForceRemovesNothingOfOthers)
{
  fs::create_directories(out / "runs");
  writeText(out / "runs" / "notes.txt", "mine");
  expectError(run(smallSuite(), {"--force", "--fresh"}),
              "pcl_slam6d_evaluate",
              1,
              {"out/runs: is not of a suite"});
  EXPECT_EQ(pcl6d::test::readText(out / "runs" / "notes.txt"), "mine");
}

TEST_F(SuiteBadInput, ADocumentThatCannotBeWrittenIsToldBeforeTheRuns)
{
  const std::string name = "pcl_slam6d_evaluate";
  const std::string document = folder / "none" / "doc.md";
  expectError(run(smallSuite(), {"--document", document}), name, 1, {document});
  const std::string suite = folder / "small.json";
  expectError(run(smallSuite(), {"--document", suite}),
              name,
              1,
              {"small.json: is an input of the suite"});
  EXPECT_FALSE(fs::exists(out));
}
