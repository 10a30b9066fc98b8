// SPDX-License-Identifier: BSD-3-Clause
// What pcl_slam6d_convert says of wrong command lines and broken scans.
#include "apps/convert/convert_test.h"

namespace fs = std::filesystem;
using pcl6d::test::cloudOf;
using pcl6d::test::contentOf;
using pcl6d::test::convert;
using pcl6d::test::expectConvertError;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
/** Good scans, one and a folder of two. */
struct BadInput : testing::Test {
  void
  SetUp() override
  {
    fs::create_directory(folder / "in");
    for (const char* const file : {"in/a.pcd", "in/b.pcd", "a.pcd"})
      pcl6d::writePcd(folder / file, cloudOf({"x", "y", "z"}, {1, 2, 3}));
    before = contentOf(folder.path());
  }

  /** Expects an error with the words, and that nothing was changed or written. */
  void
  expectRefused(std::vector<std::string> arguments,
                int code,
                const std::vector<std::string>& words)
  {
    arguments.insert(arguments.begin(), "scans");
    expectConvertError(arguments, code, words);
    EXPECT_EQ(contentOf(folder.path()), before);
  }

  std::string
  name(const std::string& file) const
  {
    return folder / file;
  }

  /** Makes a file that is there before. */
  std::string
  made(const std::string& file, const std::string& content)
  {
    writeText(folder / file, content);
    before = contentOf(folder.path());
    return folder / file;
  }

  const TempFolder folder;
  const std::string a = folder / "a.pcd", in = folder / "in", out = folder / "out";
  std::map<std::string, std::string> before;
};
} // namespace

TEST(Convert, HelpsAndKnowsItsVerbs)
{
  const auto help = convert({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* const verb : {"scans", "trajectory"}) {
    EXPECT_NE(help.out.find(std::string("\n  ") + verb), std::string::npos);
    EXPECT_EQ(convert({verb, "--help"}).exit_code, 0);
  }
  EXPECT_EQ(convert({"--version"}).exit_code, 0);
  expectConvertError({"paint"}, 2, {"lines, map, poses, scans, stereo, trajectory"});
  expectConvertError(
      {"maps"}, 2, {"'maps'", "lines, map, poses, scans, stereo, trajectory"});
}

TEST_F(BadInput, WrongFormatsAndEncodings)
{
  expectRefused({a, "-o", out}, 2, {"--format is missing", "out", "pcd, ply, uos"});
  expectRefused({in, "-o", out + ".ply"}, 2, {"--format is missing", "folder"});
  expectRefused({a, "-o", out, "--format", "dxf"}, 2, {"--format = 'dxf'", "uosr"});
  expectRefused({a, "-o", out + ".ply", "--format", "xyz"}, 2, {"extension of ply"});
  expectRefused(
      {a, "-o", out + ".ply", "--input-format", "dxf"}, 2, {"--input-format = 'dxf'"});
  expectRefused({a, "-o", out + ".pcd", "--encoding", "zip"},
                2,
                {"--encoding = zip", "binary_compressed"});
  expectRefused({a, "-o", out + ".ply", "--encoding", "binary_compressed"},
                2,
                {"--encoding = binary_compressed", "ascii or binary"});
  const std::string unknown = made("a.dxf", "x");
  expectRefused({unknown, "-o", out + ".ply"}, 1, {"a.dxf", "unknown format", ".3d"});
}

TEST_F(BadInput, InputsAreNoOutputs)
{
  expectRefused({a, "-o", a}, 2, {"is the input"});
  fs::create_symlink(a, folder / "link.pcd");
  before = contentOf(folder.path());
  expectRefused({a, "-o", name("link.pcd")}, 2, {"is the input"});
  expectRefused({in, "-o", in, "--format", "ply"}, 1, {"is the input folder"});
  expectRefused({in, "-o", folder.path(), "--format", "ply"}, 1, {"input", "inside"});
  expectRefused({in, "-o", name("in/a.pcd"), "--full"}, 2, {"is an input"});
}

TEST_F(BadInput, ScansWithoutPointsAreTold)
{
  fs::create_directory(folder / "in2");
  made("none.bin", "");
  made("in2/a.xyz", "");
  made("in2/b.xyz", "1 2 3\n");
  made("in2/c.xyz", "# nothing\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{name("none.bin"), "-o", name("none.pcd")}, "none.bin has no points"},
      {{name("in2"), "-o", out, "--format", "pcd"},
       "a.xyz and 1 other scan have no points"},
      {{name("in2"), "-o", name("all.pcd"), "--full"},
       "a.xyz and 1 other scan have no points"}};
  for (auto [arguments, words] : cases) {
    arguments.insert(arguments.begin(), "scans");
    const auto outcome = convert(arguments);
    EXPECT_EQ(outcome.exit_code, 3) << words;
    EXPECT_NE(outcome.err.find("warning: "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
}

TEST_F(BadInput, TargetsThatCannotBeWritten)
{
  expectRefused({a, "-o", name("none/a.ply")}, 1, {"none/a.ply", "No such file"});
  expectRefused({a, "-o", name("a.pcd/b.ply")}, 1, {"a.pcd/b.ply"});
  expectRefused({a, "-o", in, "--format", "ply"}, 1, {"is a folder"});
  expectRefused({in, "-o", name("a.pcd/out"), "--format", "ply"}, 1, {"a.pcd/out"});
  fs::create_directory(folder / "full");
  made("full/file", "");
  expectRefused({in, "-o", name("full"), "--format", "ply"}, 1, {"full", "not empty"});
  expectRefused({in, "-o", "/dev/full", "--format", "xyz", "--full"},
                1,
                {"/dev/full", "No space left"});
}

TEST_F(BadInput, OptionsOfAFolderNeedOne)
{
  const std::vector<std::pair<std::string, std::string>> options = {
      {"--first", "1"}, {"--last", "1"}, {"--every", "2"}, {"--poses", "x"}};
  for (const auto& [option, value] : options)
    expectRefused(
        {a, "-o", out + ".ply", option, value}, 2, {option, "needs a folder"});
  expectRefused({a, "-o", out + ".ply", "--full"}, 2, {"--full", "needs a folder"});
  expectRefused({in, "-o", out, "--format", "ply", "--every", "0"}, 2, {"--every = 0"});
  expectRefused({in, "-o", out, "--format", "ply", "--first", "2"},
                2,
                {"--first = 2", "2 scans"});
}

TEST_F(BadInput, BrokenScansAreNamedWithThePlace)
{
  const std::string to = out + ".ply";
  expectRefused({name("none.pcd"), "-o", to}, 1, {"none.pcd", "No such file"});
  expectRefused({made("b.xyz", "1 2 3\n4 5\n"), "-o", to},
                1,
                {"b.xyz", "line 2", "at least 3 numbers"});
  expectRefused(
      {made("b.3d", "1 2 3\n4 x 5\n"), "-o", to}, 1, {"b.3d", "line 2", "'x'"});
  expectRefused({made("b.3d", "1 2 3\n"), "-o", to, "--input-format", "uosr"},
                1,
                {"b.3d", "line 1", "at least 4 numbers"});
  expectRefused({made("b.bin", "123"), "-o", to}, 1, {"b.bin", "3 bytes", "16"});
  expectRefused({made("b.ply",
                      "ply\nformat binary_little_endian 1.0\nelement vertex 9\n"
                      "property float x\nend_header\nabc"),
                 "-o",
                 to + ".pcd"},
                1,
                {"b.ply", "vertex 1 of 9"});
  expectRefused({made("b.pcd", "FIELDS x y z\nSIZE 4 4\n"), "-o", to}, 1, {"b.pcd"});
}

TEST_F(BadInput, ScansWithoutCoordinatesAreNamed)
{
  const std::string file = folder / "flat.pcd";
  pcl6d::writePcd(file, cloudOf({"x", "y", "depth"}, {1, 2, 3}));
  before = contentOf(folder.path());
  for (const char* const to : {"b.ply", "b.xyz", "b.3d", "b.bin", "b.pcd"})
    expectRefused({file, "-o", name(to)}, 1, {"flat.pcd", "no field 'z'"});
}

TEST_F(BadInput, AFolderIsWrittenWholeOrNotAtAll)
{
  made("in/c.pcd", "PCD?");
  expectRefused({in, "-o", out, "--format", "ply"}, 1, {"c.pcd", "line 1"});
  expectRefused({in, "-o", out + ".ply", "--full"}, 1, {"c.pcd", "line 1"});
  fs::remove(folder / "in/c.pcd");
  fs::copy(folder / "a.pcd", folder / "in/a.PCD");
  before = contentOf(folder.path());
  expectRefused({in, "-o", out, "--format", "ply"}, 1, {"an equal name"});
  fs::remove(folder / "in/a.PCD");
  made("in/d.xyz", "1 2 3\n");
  expectRefused({in, "-o", out, "--format", "ply"}, 1, {"several formats"});
}
