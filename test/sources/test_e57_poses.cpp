// SPDX-License-Identifier: BSD-3-Clause
// Poses are written into a file of which nothing else changes.
#include "sources/made_e57.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/sources/e57_poses.h>
#include <pcl6d/sources/e57_source.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl6d::test;
using namespace pcl6d::sources;
using pcl6d::E57Source;
using pcl6d::writeE57Poses;

const MadeScan kScan = scanOfPoints(std::vector<std::vector<double>>(300, {1, 2, 3}));
/** As libE57 writes it: longer than what is put in its place. */
constexpr const char* kLongPose =
    "<pose type=\"Structure\">\n  <rotation type=\"Structure\">\n    <w "
    "type=\"Float\">1.00000000000000000e+00</w>\n    <x "
    "type=\"Float\">0.00000000000000000e+00</x>\n    <y "
    "type=\"Float\">0.00000000000000000e+00</y>\n    <z "
    "type=\"Float\">0.00000000000000000e+00</z>\n  </rotation>\n  <translation "
    "type=\"Structure\">\n    <x type=\"Float\">0.00000000000000000e+00</x>\n    <y "
    "type=\"Float\">0.00000000000000000e+00</y>\n    <z "
    "type=\"Float\">0.00000000000000000e+00</z>\n  </translation>\n        </pose>";

Eigen::Isometry3d
poseOf(int i)
{
  return pcl6d::poseFromEuler({512345.123456789 + i, -1.0 / 3, 0.1},
                              {0.1, -0.2, 1.0 + i});
}

/** \return the content of the XML section, and of everything before it in the file */
std::pair<std::string, std::string>
partsOf(const std::filesystem::path& path)
{
  PageReader file(path);
  const std::uint64_t begin = file.logicalOf(file.header().xml_offset, "XML");
  std::string xml(file.header().xml_length, ' '), before(begin - kE57HeaderSize, ' ');
  file.read(begin, reinterpret_cast<std::uint8_t*>(xml.data()), xml.size());
  file.read(
      kE57HeaderSize, reinterpret_cast<std::uint8_t*>(before.data()), before.size());
  return {xml, before};
}

/** \return the text without all that stands in elements <pose> */
std::string
withoutPoses(std::string xml)
{
  for (std::size_t begin = 0; (begin = xml.find("<pose ", begin)) != std::string::npos;)
    xml.erase(begin, xml.find("</pose>", begin) + 7 - begin);
  return xml;
}

/** \return the pages, checksums included, in which two files of one size differ */
std::vector<std::size_t>
differingPages(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> pages;
  for (std::size_t begin = 0; begin < a.size(); begin += 1024)
    if (a.compare(begin, 1024, b, begin, 1024) != 0)
      pages.push_back(begin / 1024);
  return pages;
}

void
expectPoses(const std::filesystem::path& path, std::size_t count)
{
  const E57Source source(path);
  ASSERT_EQ(source.scans().size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Isometry3d expected = poseOf(static_cast<int>(i));
    EXPECT_EQ(source.scans()[i].pose->translation(), expected.translation());
    EXPECT_LT((source.scans()[i].pose->linear() - expected.linear()).norm(), 4e-15);
    EXPECT_EQ(source.read(i).cloud.width, 300U);
  }
}

TEST(E57Poses, TakeThePlaceOfThoseThatAreThere)
{
  const TempFolder folder;
  MadeScan scan = kScan;
  scan.about = kLongPose;
  makeE57(folder / "a.e57", {scan, scan});
  writeE57Poses(folder / "a.e57", folder / "b.e57", {poseOf(0), poseOf(1)});
  expectPoses(folder / "b.e57", 2);
  const std::string a = readText(folder / "a.e57"), b = readText(folder / "b.e57");
  ASSERT_EQ(a.size(), b.size());
  const auto [xml_a, before_a] = partsOf(folder / "a.e57");
  const auto [xml_b, before_b] = partsOf(folder / "b.e57");
  EXPECT_EQ(before_a, before_b);
  EXPECT_EQ(withoutPoses(xml_a), withoutPoses(xml_b));
  const std::size_t first_xml_page =
      PageReader(folder / "a.e57").header().xml_offset / 1024;
  for (const std::size_t page : differingPages(a, b))
    EXPECT_GE(page, first_xml_page);
}

TEST(E57Poses, TheSameOnesTwiceChangeNothingMore)
{
  const TempFolder folder;
  MadeScan scan = kScan;
  scan.about = kLongPose;
  makeE57(folder / "a.e57", {scan, scan});
  writeE57Poses(folder / "a.e57", folder / "a.e57", {poseOf(0), poseOf(1)});
  const std::string once = readText(folder / "a.e57");
  writeE57Poses(folder / "a.e57", folder / "a.e57", {poseOf(0), poseOf(1)});
  EXPECT_EQ(readText(folder / "a.e57"), once);
  writeE57Poses(folder / "a.e57", folder / "b.e57", {std::nullopt, std::nullopt});
  EXPECT_EQ(readText(folder / "b.e57"), once);
}

TEST(E57Poses, MakeTheSectionLongerWhereThereAreNone)
{
  const TempFolder folder;
  makeE57(folder / "a.e57", {kScan, kScan, kScan});
  writeE57Poses(folder / "a.e57", folder / "b.e57", {poseOf(0), poseOf(1), poseOf(2)});
  expectPoses(folder / "b.e57", 3);
  const auto [xml_a, before_a] = partsOf(folder / "a.e57");
  const auto [xml_b, before_b] = partsOf(folder / "b.e57");
  EXPECT_EQ(before_a, before_b);
  EXPECT_EQ(PageReader(folder / "a.e57").header().xml_offset,
            PageReader(folder / "b.e57").header().xml_offset);
  EXPECT_GT(xml_b.size(), xml_a.size());
}

TEST(E57Poses, MoveTheSectionBehindTheOthersWhereTheyFollowIt)
{
  const TempFolder folder;
  const std::filesystem::path path = folder / "a.e57";
  { // the XML section stands first, as some writers put it
    MadeScan scan = kScan;
    PageWriter measure(folder / "unused");
    const std::string draft = dataText(writeMadeScan(scan, measure));
    PageWriter pages(path);
    std::string xml(draft.size() + 64, ' ');
    const std::uint64_t xml_offset = pages.physical();
    pages.write(xml.data(), xml.size());
    const std::string text = dataText(writeMadeScan(scan, pages));
    pages.finish(xml_offset, xml.size());
    std::string bytes = readText(path);
    std::size_t place = kE57HeaderSize;
    for (const char c : text + std::string(xml.size() - text.size(), ' ')) {
      bytes[place++] = c;
      if (place % kPageSize == kPageContent)
        place += 4;
    }
    writeResealed(path, bytes);
  }
  std::filesystem::remove(folder / "unused");
  ASSERT_EQ(E57Source(path).read(0).cloud.width, 300U);
  writeE57Poses(path, folder / "b.e57", {poseOf(0)});
  expectPoses(folder / "b.e57", 1);
  const std::string a = readText(path), b = readText(folder / "b.e57");
  EXPECT_EQ(PageReader(folder / "b.e57").header().xml_offset, a.size());
  EXPECT_EQ(differingPages(a, b), std::vector<std::size_t>{0}); // the header's
}

TEST(E57Poses, AnotherNumberOfPosesIsTheCallersMistake)
{
  const TempFolder folder;
  makeE57(folder / "a.e57", {kScan});
  EXPECT_THROW(writeE57Poses(folder / "a.e57", folder / "b.e57", {}),
               pcl6d::BadArgument);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.e57"));
}

} // namespace
