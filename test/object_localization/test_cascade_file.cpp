// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/cascade_cases.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/cascade_evaluator.h>
#include <pcl6d/object_localization/cascade_file.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {
struct CascadeFile : testing::Test {
  CascadeFile() : file(folder / "cascade.xml")
  {
    cascade = test::randomCascade(20, 30, HaarFeatureSet::kAll, 2, 3);
    cascade.subject = CascadeSubject{ImageChannel::kReflectance, 1.2, 0.00512, 2};
    writeCascade(file, cascade);
    text = test::readText(file);
  }
  /** Replaces a text in the file and expects an error with these words. */
  void
  expectBroken(const std::string& from, const std::string& to, const std::string& words)
  {
    const auto place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    test::writeText(file, std::string(text).replace(place, from.size(), to));
    try {
      readCascade(file);
      ADD_FAILURE() << "accepted " << to;
    } catch (const IoFailed& e) {
      EXPECT_EQ(std::string(e.what()).rfind(file + ": ", 0), 0u) << e.what();
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  }
  test::TempFolder folder;
  std::string file, text;
  HaarCascade cascade;
};
} // namespace

TEST_F(CascadeFile, KeepsEveryBit)
{
  const HaarCascade read = readCascade(file);
  EXPECT_EQ(read.width, 20);
  EXPECT_EQ(read.height, 30);
  ASSERT_TRUE(read.subject);
  EXPECT_EQ(read.subject->channel, ImageChannel::kReflectance);
  EXPECT_EQ(read.subject->object_size, 1.2);
  EXPECT_EQ(read.subject->pixel, 0.00512);
  EXPECT_EQ(read.subject->slice_depth, 2);
  const std::string again = folder / "again.xml";
  writeCascade(again, read);
  EXPECT_EQ(test::readText(again), text);
  const GrayImage image = test::randomImage(100, 100, 2);
  EXPECT_EQ(detectWindows(read, image), detectWindows(cascade, image));
}

TEST_F(CascadeFile, NamesWhatIsWrong)
{
  expectBroken("</stages>", "", "line");
  expectBroken("<height>30</height>", "<height>20</height>", "does not fit");
  expectBroken("<width>20</width>", "", "<width>");
  expectBroken("<width>20</width>", "<width>2000</width>", "width = 2000");
  expectBroken("<width>20</width>", "<width>20.5</width>", "whole");
  expectBroken("HAAR", "LBP", "Haar");
  expectBroken("opencv_storage>\n<cascade", "opencv_storage>\n<cas", "no element");
  expectBroken("<stageThreshold>", "<stageThreshold>x", "no number");
  expectBroken("<stageThreshold>", "<stageThreshold>nan ", "no number");
  expectBroken("<channel>reflectance", "<channel>colour", "channel");
  expectBroken("1 0 0 ", "1 0 7000 ", "feature of a node = 7000");
  expectBroken("1 0 0 ", "0 0 0 0 1 0 0 ", "leaves of a tree");
  expectBroken("1 0 0 ", "9 0 0 ", "child of a node = 9");
  expectBroken("</leafValues>", " 3</leafValues>", "leaves of a tree");
}

TEST_F(CascadeFile, RefusesWhatIsNoFile)
{
  EXPECT_THROW(readCascade(folder / "none.xml"), IoFailed);
  EXPECT_THROW(readCascade(std::string(folder / "")), IoFailed);
  test::writeText(file, "");
  EXPECT_THROW(readCascade(file), IoFailed);
  test::writeText(file, "<opencv_storage><data/></opencv_storage>");
  EXPECT_THROW(readCascade(file), IoFailed);
}

TEST_F(CascadeFile, IsNotReadDeeperThanAnybodyWritesIt)
{
  for (const int depth : {20000, 500000}) {
    std::string deep = "<opencv_storage>";
    for (int i = 0; i < depth; ++i)
      deep += "<a>";
    test::writeText(file, deep);
    try {
      readCascade(file);
      ADD_FAILURE() << "it was read";
    } catch (const IoFailed& e) {
      EXPECT_EQ(std::string(e.what()), file + ": line 1: nested more than 200 deep");
    }
  }
}

TEST_F(CascadeFile, RefusesToWriteABrokenCascade)
{
  HaarCascade broken = cascade;
  broken.stages.clear();
  EXPECT_THROW(writeCascade(file, broken), BadArgument);
  EXPECT_EQ(test::readText(file), text);
  EXPECT_THROW(writeCascade(folder / "none/cascade.xml", cascade), IoFailed);
}

} // namespace pcl6d
