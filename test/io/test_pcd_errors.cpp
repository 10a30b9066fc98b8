// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"

#include <pcl6d/io/scan_reader.h>

using pcl6d::PcdEncoding;
using pcl6d::readPcd;
using pcl6d::test::expectIoFailed;
using pcl6d::test::kEncodings;
using pcl6d::test::makeRichCloud;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {

/** \brief A small PCD file whose header lines a test can change. */
class BrokenPcd : public testing::Test {
protected:
  /** Expects that reading fails so, with one entry of the header replaced; an empty
   * value leaves the entry out. */
  void
  expectWithEntry(const std::string& word,
                  const std::string& value,
                  const std::string& message)
  {
    auto header = header_;
    for (auto& entry : header)
      if (entry.first == word)
        entry.second = value;
    expectMessage(textOf(header) + body_, message);
  }

  void
  expectWithBody(const std::string& body, const std::string& message)
  {
    expectMessage(textOf(header_) + body, message);
  }

  void
  expectMessage(const std::string& content, const std::string& message)
  {
    writeText(path_, content);
    expectIoFailed(path_, message, [&] { readPcd(path_); });
  }

  using Header = std::vector<std::pair<std::string, std::string>>;
  static std::string
  textOf(const Header& header)
  {
    std::string text;
    for (const auto& [word, value] : header)
      text += value.empty() ? "" : word + ' ' + value + '\n';
    return text;
  }

  const TempFolder folder_;
  const std::filesystem::path path_ = folder_ / "scan003.pcd";
  const Header header_ = {{"VERSION", "0.7"},
                          {"FIELDS", "x y z label"},
                          {"SIZE", "4 4 4 1"},
                          {"TYPE", "F F F U"},
                          {"COUNT", "1 1 1 1"},
                          {"WIDTH", "2"},
                          {"HEIGHT", "1"},
                          {"VIEWPOINT", "0 0 0 1 0 0 0"},
                          {"POINTS", "2"},
                          {"DATA", "ascii"}};
  const std::string body_ = "1 2 3 4\n5 6 7 8\n";
};

} // namespace

TEST_F(BrokenPcd, EveryEntryIsChecked)
{
  writeText(path_, textOf(header_) + body_);
  ASSERT_NO_THROW(readPcd(path_)); // so that each change below is what breaks it
  expectWithEntry("VERSION", "0.8", "line 1: VERSION '0.8' is not known (up to 0.7)");
  expectWithEntry("FIELDS", "", "the header has no FIELDS");
  expectWithEntry("FIELDS", " ", "line 2: FIELDS names no field");
  expectWithEntry("FIELDS", "x y z", "line 3: expected 3 values after SIZE, got 4");
  expectWithEntry("SIZE", "4 4 4", "line 3: expected 4 values after SIZE, got 3");
  expectWithEntry("SIZE", "", "the header has no SIZE");
  expectWithEntry("SIZE",
                  "4 4 2 1",
                  "line 4: no field has TYPE 'F' and SIZE '2' (known: I and U of 1, 2, "
                  "4, 8; F of 4, 8)");
  expectWithEntry("TYPE",
                  "F F X U",
                  "line 4: no field has TYPE 'X' and SIZE '4' (known: I and U of 1, 2, "
                  "4, 8; F of 4, 8)");
  expectWithEntry("TYPE", "F F F U U", "line 4: expected 4 values after TYPE, got 5");
  expectWithEntry("COUNT", "1 1 0 1", "line 5: COUNT of field 'z' is 0");
  expectWithEntry("COUNT", "1 1 -1 1", "line 5: COUNT '-1' is not a whole number >= 0");
  expectWithEntry("COUNT",
                  "4294967295 4294967295 1 1",
                  "line 2: a point has more than 1048576 bytes, or a gap leads ahead "
                  "of the start of the point");
  expectWithEntry("WIDTH", "two", "line 6: WIDTH 'two' is not a whole number >= 0");
  expectWithEntry("WIDTH", "3", "line 9: POINTS 2 is not WIDTH x HEIGHT = 3");
  expectWithEntry("DATA",
                  "zipped",
                  "line 10: DATA 'zipped' is not known (ascii, binary, "
                  "binary_compressed)");
  expectWithEntry("DATA", "", "line 10: '1' is not an entry of a PCD header");
}

TEST_F(BrokenPcd, GapsThatLeadOutOfThePointAreRefused)
{
  const auto expectCounts = [&](const std::string& counts, const std::string& message) {
    expectMessage("FIELDS _ x _\nSIZE 1 4 1\nTYPE U F U\nCOUNT " + counts +
                      "\nWIDTH 1\nDATA binary\n12345678",
                  message);
  };
  const std::string rule = "line 1: a point has more than 1048576 bytes, or a gap "
                           "leads ahead of the start of the point";
  expectCounts("-1 1 9", rule);
  expectCounts("4 1 -9", rule);
  expectCounts("4 1 -4", "line 4: a field ends behind the point");
  expectCounts("4 -1 4", "line 4: COUNT '-1' is not a whole number >= 0");
  expectCounts("-99999999999 1 4",
               "line 4: COUNT '-99999999999' is not a whole number >= 0");
}

TEST_F(BrokenPcd, HugeSizesAreRefusedBeforeMemoryIsAsked)
{
  expectWithEntry("HEIGHT",
                  "18446744073709551615",
                  "line 6: 2 x 18446744073709551615 points are more than a cloud can "
                  "hold");
  const std::string shape = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 65536\nHEIGHT "
                            "65535\nDATA ";
  expectMessage(shape + "binary\nabc",
                "expected 4294901760 points of 12 bytes, got 3 "
                "bytes");
  expectMessage(shape + "ascii\n1 2 3\n", "expected 4294901760 points, got 1");
  expectMessage(shape + "binary_compressed\n12345678",
                "expected 51538821120 bytes of points before compression, got "
                "943142453");
  // 4 GB from one byte: refused without asking for 4 GB.
  const std::string sizes = pcl6d::test::bytesOf<std::uint32_t>({1, 4000000000});
  expectMessage("FIELDS x\nSIZE 4\nTYPE F\nWIDTH 1000000000\nDATA binary_compressed\n" +
                    sizes + "a",
                "the compressed points are corrupt");
}

TEST_F(BrokenPcd, ViewpointsThatAreNoPoseAreRefused)
{
  const std::string start = "line 8: not a rigid motion (";
  expectWithEntry("VIEWPOINT",
                  "0 0 1 0 0 0 0",
                  start + "the quaternion has norm 0, but must have 1)");
  expectWithEntry("VIEWPOINT",
                  "0 0 0 1.02 0 0 0",
                  start + "the quaternion has norm 1.02, but must have 1)");
  expectWithEntry("VIEWPOINT", "0 nan 0 1 0 0 0", start + "a number is not finite)");
  expectWithEntry("VIEWPOINT", "0 0 0 1 0 0 inf", start + "a number is not finite)");
  expectWithEntry(
      "VIEWPOINT", "0 0 0 1 0 0", "line 8: expected 7 values after VIEWPOINT, got 6");
  expectWithEntry(
      "VIEWPOINT", "0 0 0 one 0 0 0", "line 8: VIEWPOINT 'one' is not a number");
}

TEST_F(BrokenPcd, TextBodiesAreCheckedLineByLine)
{
  expectWithBody("1 2 3 4\n5 6\n", "line 12: expected 4 numbers, got 2");
  expectWithBody("1 2 3 4\n5 6 7 8 9\n", "line 12: expected 4 numbers, got 5");
  expectWithBody("1 2 3 4\n\n5 abc 7 8\n", "line 13: 'abc' is not a number");
  expectWithBody("1 2,5 3 4\n5 6 7 8\n", "line 11: '2,5' is not a number");
  expectWithBody("1 2 3 4\n5 6 7 256\n",
                 "line 12: '256' is not a number that field 'label' can hold");
  expectWithBody("1 2 3 4\n5 6 7 -1\n",
                 "line 12: '-1' is not a number that field 'label' can hold");
  expectWithBody("1 2 3 4\n", "expected 2 points, got 1");
  expectWithBody("1 2 3 4\n5 6 7 8\n9 9 9 9\n", "line 13: expected 2 points, got more");
}

TEST_F(BrokenPcd, HeadersThatAreNoneAreRefused)
{
  expectMessage("", "the header ends without a DATA line");
  expectMessage("VERSION 0.7\n", "the header ends without a DATA line");
  expectMessage("ply\nformat ascii 1.0\n",
                "line 1: 'ply' is not an entry of a PCD "
                "header");
  expectMessage(std::string(100000, '\0'), "line 1: not a line of a PCD header");
  expectMessage("WIDTH 1\nWIDTH 2\n", "line 2: a second WIDTH");
}

TEST_F(BrokenPcd, FilesThatCannotBeReadAreNamedWithTheReason)
{
  const auto missing = folder_ / "missing.pcd";
  expectIoFailed(missing, "No such file or directory", [&] { readPcd(missing); });
  expectIoFailed(
      missing, "No such file or directory", [&] { pcl6d::readPcdViewpoint(missing); });
  expectIoFailed(folder_.path(), "Is a directory", [&] { readPcd(folder_.path()); });
  expectIoFailed(folder_.path(), "Is a directory", [&] {
    pcl6d::readPcdViewpoint(folder_.path());
  });
}

TEST_F(BrokenPcd, CompressedPointsThatAreCorruptAreAnErrorOrKeepTheirNumber)
{
  pcl6d::writePcd(path_, makeRichCloud(40));
  const std::string content = readText(path_);
  const std::size_t start = content.find("binary_compressed\n") + 18;
  std::size_t refused = 0;
  for (std::size_t i = start; i < content.size(); ++i) {
    std::string changed = content;
    changed[i] = static_cast<char>(changed[i] ^ 0xff);
    pcl6d::test::replaceText(path_, changed);
    try {
      EXPECT_EQ(readPcd(path_).width, 40u);
    } catch (const pcl6d::IoFailed& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).rfind(path_.string() + ": ", 0), 0u);
    }
  }
  EXPECT_GT(refused, 50u);
}

TEST_F(BrokenPcd, AFileCutAnywhereIsRefused)
{
  for (const auto encoding : kEncodings) {
    SCOPED_TRACE(static_cast<int>(encoding));
    pcl6d::writePcd(path_, makeRichCloud(5), Eigen::Isometry3d::Identity(), encoding);
    const std::string content = readText(path_);
    for (std::size_t size = 0; size < content.size(); ++size) {
      pcl6d::test::replaceText(path_, content.substr(0, size));
      // A text body is complete when no more than the end of its last number is cut
      // off: "-304" to "-3". Nobody can see that.
      const bool may_be_complete =
          encoding == PcdEncoding::kAscii && size + 5 > content.size();
      try {
        EXPECT_EQ(readPcd(path_).width, 5u);
        EXPECT_TRUE(may_be_complete) << "cut to " << size << " bytes";
      } catch (const pcl6d::IoFailed& error) {
        EXPECT_EQ(std::string(error.what()).rfind(path_.string() + ": ", 0), 0u);
      }
    }
  }
}

TEST_F(BrokenPcd, AScanNeedsFloatingPointCoordinates)
{
  const auto expectScan = [&](const std::string& fields,
                              const std::string& type,
                              const std::string& message) {
    auto header = header_;
    header[1].second = fields;
    header[3].second = type;
    header[2].second = "4 4 4 4";
    writeText(path_, textOf(header) + body_);
    expectIoFailed(path_, message, [&] { pcl6d::readScan(path_); });
  };
  expectScan("x y intensity label", "F F F U", "has no field 'z'");
  expectScan("a b c label", "F F F U", "has no field 'x'");
  expectScan("x y z label", "F I F U", "field 'y' is not float32 or float64");
}
