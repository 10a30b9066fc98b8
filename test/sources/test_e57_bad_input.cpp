// SPDX-License-Identifier: BSD-3-Clause
// Files that are broken are refused in one line, with memory for what they hold only.
#include "sources/made_e57.h"

#include <pcl6d/common/error.h>
#include <pcl6d/sources/e57_source.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace pcl6d::test;
using namespace pcl6d::sources;
using pcl6d::E57Source;

class E57BadInput : public testing::Test {
protected:
  /** \return the message about the file, without its name; "read" if it is read whole */
  std::string
  refusal() const
  {
    try {
      const E57Source source(path_);
      for (std::size_t i = 0; i < source.scans().size(); ++i)
        source.read(i);
    } catch (const pcl6d::IoFailed& e) {
      const std::string message = e.what(), start = path_.string() + ": ";
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(message.compare(0, start.size(), start), 0) << message;
      return message.substr(std::min(start.size(), message.size()));
    }
    return "read";
  }

  std::string
  refusalOf(const std::string& xml) const
  {
    std::filesystem::remove(path_);
    makeE57OfText(path_, xml);
    return refusal();
  }

  std::string
  refusalOf(const MadeScan& scan) const
  {
    makeE57(path_, {scan});
    return refusal();
  }

  /** \return the message about the good file with another word in its place */
  std::string
  refusalWith(const std::string& word, const std::string& other) const
  {
    PageWriter pages(path_);
    std::string text = writeMadeScan(kGood, pages);
    const std::size_t place = text.find(word);
    EXPECT_NE(place, std::string::npos);
    finishWith(dataText(text.replace(place, word.size(), other)), pages);
    return refusal();
  }

  void
  setHeader(std::size_t place, std::uint64_t value) const
  {
    makeE57(path_, {kGood});
    std::string bytes = readText(path_);
    storeLittleEndian(value, 8, reinterpret_cast<std::uint8_t*>(&bytes[place]));
    writeResealed(path_, bytes);
  }

  TempFolder folder_;
  const std::filesystem::path path_ = folder_ / "a.e57";
  const MadeScan kGood =
      scanOfPoints(std::vector<std::vector<double>>(100, {1.5, 2.5, 3.5}));
};

TEST_F(E57BadInput, TheGoodFileIsRead)
{
  EXPECT_EQ(refusalOf(kGood), "read");
}

TEST_F(E57BadInput, AFileThatIsCutOffAnywhereIsRefused)
{
  makeE57(path_, {kGood});
  const std::string whole = readText(path_);
  for (std::size_t size = 0; size < whole.size(); size += size < 100 ? 1 : 97) {
    std::filesystem::remove(path_);
    writeText(path_, whole.substr(0, size));
    EXPECT_EQ(refusal(),
              size < kE57HeaderSize
                  ? "is no E57 file: does not begin with ASTM-E57 and a header"
                  : "is cut off: " + std::to_string(size) +
                        " bytes, but the header says " + std::to_string(whole.size()))
        << size;
  }
}

TEST_F(E57BadInput, EachFlippedByteIsFoundByAChecksumOrTheHeader)
{
  makeE57(path_, {kGood});
  const std::string whole = readText(path_);
  for (std::size_t place = 0; place < whole.size(); place += 61) {
    std::string bytes = whole;
    bytes[place] = static_cast<char>(bytes[place] ^ 0x10);
    std::filesystem::remove(path_);
    writeText(path_, bytes);
    EXPECT_NE(refusal(), "read") << place;
    if (place < 1024)
      continue; // the header may be what is refused
    EXPECT_NE(refusal().find("page " + std::to_string(place / 1024) + " (bytes from " +
                             std::to_string(place / 1024 * 1024) +
                             "): wrong checksum, the content is damaged"),
              std::string::npos)
        << place << refusal();
  }
}

TEST_F(E57BadInput, HeadersThatPointOutsideAreRefused)
{
  setHeader(16, 1000);
  EXPECT_EQ(refusal(), "header: file length 1000, but must be a multiple of 1024");
  setHeader(16, ~std::uint64_t{1023});
  EXPECT_NE(refusal().find("is cut off"), std::string::npos);
  setHeader(24, std::uint64_t{1} << 40);
  EXPECT_NE(refusal().find("the XML section begins at byte 1099511627776, but the file "
                           "ends at "),
            std::string::npos);
  setHeader(24, 1022);
  EXPECT_EQ(refusal(),
            "the XML section begins at byte 1022, inside the checksum of a page");
  setHeader(32, ~std::uint64_t{0});
  EXPECT_EQ(
      refusal(),
      "the XML section of 18446744073709551615 bytes goes on behind the end of the "
      "file");
  setHeader(40, 512);
  EXPECT_EQ(refusal(), "pages of 512 bytes, but must be 1024");
  setHeader(8, 2);
  EXPECT_EQ(refusal(), "E57 version 2, but only 1 is known");
}

TEST_F(E57BadInput, CountsAndOffsetsBeyondTheFileAreRefusedBeforeMemoryIsTaken)
{
  EXPECT_EQ(
      refusalWith("recordCount=\"100\"", "recordCount=\"18446744073709551615\""),
      "scan 0: has 18446744073709551615 points, but a cloud holds at most 4294967295");
  EXPECT_EQ(refusalWith("recordCount=\"100\"", "recordCount=\"4294967295\""),
            "scan 0: has 4294967295 points, but its section of 2444 bytes has no room "
            "for the streams");
  EXPECT_EQ(refusalWith("recordCount=\"100\"", "recordCount=\"101\""),
            "scan 0: holds 100 values of 'cartesianX', but 101 points");
  EXPECT_NE(refusalWith("fileOffset=\"48\"", "fileOffset=\"999999999999\"")
                .find("scan 0 begins at byte 999999999999, but the file ends at "),
            std::string::npos);
  EXPECT_EQ(refusalWith("fileOffset=\"48\"", "fileOffset=\"52\""),
            "scan 0: the points begin with the section type 0, but must with 1");
  EXPECT_NE(refusalWith("fileOffset=\"48\"", "fileOffset=\"-1\"").find("is no integer"),
            std::string::npos);
}

TEST_F(E57BadInput, PointsOfNoBitsAreNotMoreThanTheFileHasBitsFor)
{
  MadeScan scan;
  for (const char axis : {'X', 'Y', 'Z'})
    scan.fields.push_back(integersOf(
        std::string("cartesian") + axis, 7, 7, std::vector<std::int64_t>(5, 7)));
  EXPECT_EQ(refusalOf(scan), "read");
  const std::string before = "recordCount=\"5\"", after = "recordCount=\"9999\"";
  PageWriter pages(path_);
  std::string text = writeMadeScan(scan, pages);
  finishWith(dataText(text.replace(text.find(before), before.size(), after)), pages);
  EXPECT_EQ(refusal(),
            "scan 0: has 9999 points, but its section of 44 bytes has no room for the "
            "streams");
}

TEST_F(E57BadInput, XmlIsReadToALimitedDepthAndWithoutEntities)
{
  std::string open, close;
  for (int i = 0; i < 100000; ++i) {
    open += "<a>";
    close += "</a>";
  }
  for (const std::string& where : {rootText(open + close), dataText(open + close)})
    EXPECT_NE(refusalOf(where).find("nested more than 200 deep"), std::string::npos);
  const std::string bomb =
      "<?xml version=\"1.0\"?><!DOCTYPE e57Root [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b "
      "\"&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\">]>"
      "<e57Root><data3D>&c;</data3D></e57Root>";
  EXPECT_EQ(
      refusalOf(bomb),
      "XML section: line 1: declares a document type, but E57 has no document type");
  EXPECT_EQ(refusalOf("<e57Root>\n<data3D>"),
            "XML section: line 2: is not well-formed XML");
  EXPECT_EQ(refusalOf(""), "XML section: line 1: is not well-formed XML");
  EXPECT_EQ(refusalOf("<other/>"),
            "the XML section holds <'other'>, but must hold <e57Root>");
}

TEST_F(E57BadInput, FilesWithoutScansAreRefused)
{
  EXPECT_EQ(refusalOf(rootText("")), "holds no scan");
  EXPECT_EQ(refusalOf(rootText("<images2D type=\"Vector\"><vectorChild "
                               "type=\"Structure\"/></images2D>")),
            "holds no scan");
  EXPECT_EQ(refusalOf(dataText("<vectorChild type=\"Structure\"/>")),
            "XML section: line 4: <'vectorChild'>: is a scan without points");
}

TEST_F(E57BadInput, FieldsThatBreakARuleAreNamed)
{
  MadeScan scan = kGood;
  scan.fields.erase(scan.fields.begin());
  EXPECT_EQ(refusalOf(scan),
            "scan 0: the points have no cartesianX, cartesianY, cartesianZ and no "
            "sphericalRange, sphericalAzimuth, sphericalElevation");
  EXPECT_NE(refusalWith("<cartesianX type=\"Float\"/>", "<cartesianX type=\"Flaot\"/>")
                .find("<'cartesianX'>: has the unknown type 'Flaot'"),
            std::string::npos);
  EXPECT_NE(refusalWith("<cartesianX type=\"Float\"/>", "<cartesianX tipe=\"Float\"/>")
                .find("<'cartesianX'>: has no type"),
            std::string::npos);
  scan = kGood;
  scan.fields[0] =
      scaledOf(integersOf("cartesianX", 0, 9, std::vector<std::int64_t>(100)), 0);
  EXPECT_NE(refusalOf(scan).find(
                "the scale or offset is no finite number, or the scale is 0"),
            std::string::npos);
  scan.fields[0].field.scale = 1e-3;
  scan.fields[0].field.minimum = 10;
  EXPECT_NE(refusalOf(scan).find("the minimum is above the maximum"),
            std::string::npos);
}

TEST_F(E57BadInput, PosesThatAreNoRotationsAreNamed)
{
  const auto posed = [&](const std::string& rotation, const std::string& translation) {
    MadeScan scan = kGood;
    scan.about = "<pose type=\"Structure\"><rotation type=\"Structure\">" + rotation +
                 "</rotation><translation type=\"Structure\">" + translation +
                 "</translation></pose>";
    return refusalOf(scan);
  };
  EXPECT_EQ(posed("<w>0.5</w><x>1</x>", ""),
            "XML section: line 6: <'pose'>: is no rotation: the quaternion has the "
            "length 1.118033988749895, but must have 1");
  EXPECT_NE(posed("<w/>", "").find("has the length 0, but must have 1"),
            std::string::npos);
  EXPECT_NE(posed("<w>nan</w>", "").find("<'w'>: 'nan' is not finite"),
            std::string::npos);
  EXPECT_NE(posed("<w>one</w>", "").find("<'w'>: 'one' is no number"),
            std::string::npos);
  EXPECT_NE(posed("<w>1</w>", "<x>1e9</x>").find("1e9 m or farther from the origin"),
            std::string::npos);
}

TEST_F(E57BadInput, AFolderOrNothingInItsPlaceIsNamed)
{
  EXPECT_EQ(refusal(), "No such file or directory");
  std::filesystem::create_directory(path_);
  EXPECT_EQ(refusal(), "Is a directory");
}

} // namespace
