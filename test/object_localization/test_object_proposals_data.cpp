// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"
#include "support/proposal_scores.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <gtest/gtest.h>

using namespace pcl6d;

TEST(ObjectProposalsData, CoverTheObjectsOfEachTableScene)
{
  PCL6D_DATA_OR_SKIP(folder, "objects");
  std::size_t objects = 0, covered = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "osd")) {
    SCOPED_TRACE(file.path().filename());
    const Scan scan = readScan(file.path());
    const auto labels = fieldValues(scan.cloud, "label");
    ASSERT_TRUE(labels);
    std::vector<std::uint32_t> object_of;
    for (const double label : labels->values)
      object_of.push_back(static_cast<std::uint32_t>(label) / 10);
    const PlaneCloud cloud(scan.points);
    const auto proposals = proposeObjects(cloud, segmentPlanes(cloud));
    for (const auto& cover :
         test::coverOf(scan.points, object_of, proposals, 50, 0.015)) {
      ++objects;
      covered += cover.iou > 0.5;
      EXPECT_LE(proposals.size(), 8u) << "few, not all that could be";
    }
  }
  EXPECT_GE(objects, 13u);
  EXPECT_GE(static_cast<double>(covered), 0.9 * static_cast<double>(objects));
}
