// SPDX-License-Identifier: BSD-3-Clause
// Every program with a small real job where the surroundings are odd: a locale that is not
// installed, one that writes 0,5, standard output that is full or closed.
#include "support/folders.h"
#include "support/run_program.h"
#include "support/sanitizer.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace {
namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

struct Job {
  std::string program;
  std::vector<std::string> arguments;
};

/** A bent surface, of which PCL's classes and ours find the place. */
std::string
bentSurface(double shift)
{
  std::ostringstream cloud;
  for (int i = 0; i < 25; ++i)
    for (int k = 0; k < 25; ++k) {
      const double x = 0.01 * i, y = 0.01 * k;
      cloud << x + shift << ' ' << y << ' '
            << 0.05 * std::sin(20 * x) * std::cos(15 * y) + 1 << '\n';
    }
  return cloud.str();
}

/** A block of 0.6 m x 0.5 m x 1.6 m. */
std::string
blockMesh()
{
  std::ostringstream mesh;
  for (int i = 0; i < 8; ++i)
    mesh << "v " << (i & 1 ? 0.6 : 0) << ' ' << (i & 2 ? 0.5 : 0) << ' '
         << (i & 4 ? 1.6 : 0) << '\n';
  mesh << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\n";
  return mesh.str();
}

/** One job of each program, which builds on those before, in a folder. */
std::vector<Job>
chain()
{
  return {
      {"pcl_slam6d_simulate",
       {"corridor", "-o", "scans", "--scans", "8", "--seed", "3", "--quiet"}},
      {"pcl_slam6d", {"scans", "-o", "run", "--planes", "--report", "--quiet"}},
      {"pcl_slam6d_convert", {"scans", "scans", "-o", "xyz", "--format", "xyz"}},
      {"pcl_slam6d_evaluate",
       {"trajectory", "run/trajectory.kitti", "scans/groundtruth.txt"}},
      {"pcl_slam6d_graph", {"convert", "run/graph.g2o", "-o", "graph.toro"}},
      {"pcl_slam6d_render", {"picture", "run", "--view", "top", "-o", "picture.png"}},
      {"pcl_slam6d_planes", {"scans/scan000.pcd", "-o", "planes", "--quiet"}},
      {"pcl_slam6d_objects",
       {"train",
        "block.obj",
        "--background",
        "scans",
        "-o",
        "cascade.xml",
        "--positives",
        "60",
        "--negatives",
        "200",
        "--stages",
        "1",
        "--features-per-stage",
        "200",
        "--quiet"}},
      {"pcl_slam6d_semantic_map", {"build", "run", "-o", "map.json", "--quiet"}},
      {"pcl_slam6d_doctor", {"a.xyz", "b.xyz"}}};
}

Outcome
runIn(const fs::path& folder, const Job& job, const bp::environment& environment)
{
  Outcome outcome;
  const std::string out = folder / "stdout", err = folder / "stderr";
  outcome.exit_code = bp::system(bp::exe = std::string(PCL6D_BIN_DIR "/") + job.program,
                                 bp::args = job.arguments,
                                 bp::start_dir = folder.string(),
                                 environment,
                                 bp::std_in<bp::null, bp::std_out> out,
                                 bp::std_err > err);
  outcome.out = readText(out);
  outcome.err = readText(err);
  return outcome;
}

/** The chain, run in a folder of its own. */
struct RunOfAll {
  explicit RunOfAll(const bp::environment& environment)
  {
    writeText(folder / "a.xyz", bentSurface(0));
    writeText(folder / "b.xyz", bentSurface(0.004));
    writeText(folder / "block.obj", blockMesh());
    for (const Job& job : chain())
      outcomes.push_back(runIn(folder.path(), job, environment));
  }

  /** \return the files that hold no times, with their bytes */
  std::map<std::string, std::string>
  results() const
  {
    std::map<std::string, std::string> results = contentOf(folder.path());
    for (const char* const timed : {"run/summary.json",
                                    "run/report.html",
                                    "run/planes.json",
                                    "planes/planes.json",
                                    "map.json",
                                    "stdout",
                                    "stderr"})
      results.erase(timed);
    return results;
  }

  TempFolder folder;
  std::vector<Outcome> outcomes;
};

bp::environment
environmentWith(const std::map<std::string, std::string>& more)
{
  bp::environment environment = boost::this_process::environment();
  for (const char* const name : {"LANG", "LC_ALL", "LC_NUMERIC"})
    environment.erase(name);
  for (const auto& [name, value] : more)
    environment[name] = value;
  return environment;
}

class Surroundings : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    usual_ = new RunOfAll(environmentWith({}));
    for (std::size_t i = 0; i < usual_->outcomes.size(); ++i) {
      const Outcome& outcome = usual_->outcomes[i];
      EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3)
          << chain()[i].program << ": " << outcome.exit_code << '\n'
          << outcome.err;
    }
  }
  static void
  TearDownTestSuite()
  {
    delete usual_;
    usual_ = nullptr;
  }

  static void
  expectTheSame(const bp::environment& environment)
  {
    const RunOfAll odd(environment);
    for (std::size_t i = 0; i < odd.outcomes.size(); ++i)
      EXPECT_EQ(odd.outcomes[i].exit_code, usual_->outcomes[i].exit_code)
          << chain()[i].program << '\n'
          << odd.outcomes[i].err;
    const auto expected = usual_->results(), found = odd.results();
    for (const auto& [name, content] : expected)
      EXPECT_TRUE(found.count(name) && found.at(name) == content) << name;
    EXPECT_EQ(found.size(), expected.size());
  }

  static RunOfAll* usual_;
};
RunOfAll* Surroundings::usual_ = nullptr;
} // namespace

TEST_F(Surroundings, ALocaleThatIsNotInstalledChangesNothing)
{
  expectTheSame(environmentWith({{"LANG", "en_US.UTF-8"}, {"LC_ALL", "xx_YY.UTF-8"}}));
}

TEST_F(Surroundings, NumbersDoNotFollowTheLocale)
{
  const TempFolder locales;
  const fs::path compiler = "/usr/bin/localedef";
  if (!fs::exists(compiler) || bp::system(compiler.string(),
                                          "-i",
                                          "de_DE",
                                          "-f",
                                          "UTF-8",
                                          (locales / "de_DE.UTF-8").string(),
                                          bp::std_out > bp::null,
                                          bp::std_err > bp::null) != 0)
    GTEST_SKIP() << "localedef cannot make a German locale here";
  expectTheSame(environmentWith(
      {{"LOCPATH", locales.path().string()}, {"LC_ALL", "de_DE.UTF-8"}}));
}

TEST_F(Surroundings, WithoutADriverOfOpenGlWordsSayThatNothingCanBeDrawn)
{
  const TempFolder folder;
  const auto no_driver = environmentWith({{"LIBGL_DRIVERS_PATH", "/nonexistent"}});
  const fs::path run = usual_->folder / "run";
  const fs::path scan = usual_->folder / "scans/scan000.pcd";
  const auto draw = [&](const Job& job) {
    return runIn(folder.path(), job, no_driver);
  };
  const std::string words = "cannot draw pictures: no OpenGL";
  pcl6d::test::expectError(
      draw({"pcl_slam6d_render",
            {"picture", run.string(), "--view", "top", "-o", "picture.png"}}),
      "pcl_slam6d_render",
      1,
      {words});
  EXPECT_FALSE(fs::exists(folder / "picture.png"));
  const Outcome planes =
      draw({"pcl_slam6d_planes", {scan.string(), "-o", "planes", "--quiet"}});
  EXPECT_EQ(planes.exit_code, 3);
  EXPECT_NE(planes.err.find("warning: no planes.png: " + words), std::string::npos)
      << planes.err;
  EXPECT_TRUE(
      fs::exists(folder / "planes/planes.json")); // what needs no driver is kept
  const Outcome again = draw({"pcl_slam6d", {"--draw", run.string()}});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_NE(again.err.find("top_view.png: " + words), std::string::npos) << again.err;
}

TEST_F(Surroundings, WithoutMemoryForPicturesWordsAreNotThoseOfALibrary)
{
  if (pcl6d::test::isUnderAddressSanitizer())
    GTEST_SKIP() << "which takes more memory than there is";
  const std::string err = (usual_->folder / "stderr").string();
  bool is_short = false;
  for (int megabytes = 120; megabytes <= 300; megabytes += 15) {
    const std::string command = "ulimit -c 0; ulimit -v " +
                                std::to_string(1000 * megabytes) + "; exec " +
                                PCL6D_BIN_DIR + "/pcl_slam6d --draw run";
    bp::system(bp::exe = "/bin/sh",
               bp::args = {"-c", command},
               bp::start_dir = usual_->folder.path().string(),
               bp::std_err > err);
    EXPECT_EQ(readText(err).find("std::"), std::string::npos) << readText(err);
    is_short = is_short || readText(err).find("top_view.png: not enough memory") !=
                               std::string::npos;
  }
  EXPECT_TRUE(is_short);
}

TEST_F(Surroundings, OutputThatDoesNotArriveIsAnError)
{
  for (const Job& job : chain())
    for (const char* const arguments : {"", "--help"}) {
      const bool help = *arguments != '\0';
      Job now = job;
      if (help)
        now.arguments = {"--help"};
      else if (now.arguments.back() == "--quiet" || now.program == "pcl_slam6d_convert")
        continue; // it has nothing to say, or its folder is there
      std::string err = (usual_->folder / "stderr").string();
      const int code =
          bp::system(bp::exe = std::string(PCL6D_BIN_DIR "/") + now.program,
                     bp::args = now.arguments,
                     bp::start_dir = usual_->folder.path().string(),
                     bp::std_in<bp::null, bp::std_out> "/dev/full",
                     bp::std_err > err);
      EXPECT_EQ(code, 1) << now.program << ' ' << arguments;
      EXPECT_NE(readText(err).find(now.program +
                                   ": error: cannot write to the standard output"),
                std::string::npos)
          << now.program << ' ' << arguments << ": " << readText(err);
    }
}

TEST_F(Surroundings, AReaderThatHasSeenEnoughIsNone)
{
  const std::string command =
      std::string("{ ") + PCL6D_BIN_DIR + "/pcl_slam6d --help; echo $? >&2; } | true";
  const std::string err = (usual_->folder / "stderr of help").string();
  bp::system("/bin/sh", "-c", command, bp::std_err > err);
  EXPECT_EQ(readText(err), "0\n");
}

TEST_F(Surroundings, JsonThatDoesNotArriveIsAnError)
{
  const std::string err = (usual_->folder / "stderr").string();
  const std::string program = PCL6D_BIN_DIR "/pcl_slam6d_evaluate";
  const std::vector<std::string> arguments = {
      "trajectory", "run/trajectory.kitti", "scans/groundtruth.txt", "--json", "-"};
  const int code = bp::system(bp::exe = program,
                              bp::args = arguments,
                              bp::start_dir = usual_->folder.path().string(),
                              bp::std_in<bp::null, bp::std_out> "/dev/full",
                              bp::std_err > err);
  EXPECT_EQ(code, 1);
  EXPECT_NE(readText(err).find(": error: cannot write to the standard output"),
            std::string::npos)
      << readText(err);
}

TEST_F(Surroundings, NoFileTakesThePlaceOfAStreamThatIsClosed)
{
  const std::string command = "cd " + usual_->folder.path().string() + " && exec " +
                              PCL6D_BIN_DIR +
                              "/pcl_slam6d_graph convert run/graph.g2o -o closed.toro";
  EXPECT_EQ(bp::system("/bin/sh", "-c", command + " <&- >&- 2>&-"), 1);
  EXPECT_EQ(readText(usual_->folder / "closed.toro"),
            readText(usual_->folder / "graph.toro"));
}

TEST_F(Surroundings, ErrorsAreOneLineThatATerminalMayShow)
{
  const std::string name = "a\x1b[31m\nb";
  const Job job{"pcl_slam6d", {name + std::string(100000, 'x'), "-o", "c"}};
  const Outcome outcome = runIn(usual_->folder.path(), job, environmentWith({}));
  pcl6d::test::expectError(outcome, "pcl_slam6d", 1, {"a\\x1b[31m\\nbxxx", " [...] "});
  EXPECT_LT(outcome.err.size(), 1100u);
  const Job option{"pcl_slam6d", {"a", "-o", "c", "--first", std::string(100000, 'x')}};
  pcl6d::test::expectError(runIn(usual_->folder.path(), option, environmentWith({})),
                           "pcl_slam6d",
                           2,
                           {"--first", " [...] "});
}
