// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/image.h>

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

using pcl6d::Colour;
using pcl6d::Image;

namespace {
/** 3 columns, 2 rows, all pixels different. */
const Image kSmall{3,
                   2,
                   {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18}};
} // namespace

TEST(Image, CountsRowsFromTheTop)
{
  EXPECT_EQ(kSmall.at(0, 0), (Colour{1, 2, 3}));
  EXPECT_EQ(kSmall.at(2, 0), (Colour{7, 8, 9}));
  EXPECT_EQ(kSmall.at(0, 1), (Colour{10, 11, 12}));
  EXPECT_THROW(kSmall.at(3, 0), pcl6d::BadArgument);
  EXPECT_THROW(kSmall.at(0, -1), pcl6d::BadArgument);
}

TEST(WritePng, GivesTheSamePixelsBack)
{
  const pcl6d::test::TempFolder folder;
  pcl6d::writePng(folder / "small.png", kSmall);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((folder / "small.png").c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  int size[3];
  data->GetDimensions(size);
  ASSERT_EQ(size[0], kSmall.width);
  ASSERT_EQ(size[1], kSmall.height);
  for (int row = 0; row < kSmall.height; ++row)
    for (int column = 0; column < kSmall.width; ++column)
      for (int i = 0; i < 3; ++i) // VTK counts rows from below
        EXPECT_EQ(
            data->GetScalarComponentAsDouble(column, kSmall.height - 1 - row, 0, i),
            kSmall.at(column, row)[static_cast<std::size_t>(i)]);
}

TEST(WritePng, RefusesWhatIsNoPictureOrCannotBeWritten)
{
  const pcl6d::test::TempFolder folder;
  EXPECT_THROW(pcl6d::writePng(folder / "a.png", Image()), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::writePng(folder / "a.png", Image{2, 2, {1, 2, 3}}),
               pcl6d::BadArgument);
  pcl6d::test::writeText(folder / "file", "");
  EXPECT_THROW(pcl6d::writePng(folder / "file" / "a.png", kSmall), pcl6d::IoFailed);
  EXPECT_THROW(pcl6d::writePng(folder / "missing" / "a.png", kSmall), pcl6d::IoFailed);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}
