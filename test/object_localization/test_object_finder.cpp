// SPDX-License-Identifier: BSD-3-Clause
// Models and a scan in memory, as a user of the library has them.
#include "object_localization/placed_objects.h"
#include "support/folders.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/object_finder.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {
using namespace test;

/** \return a scan of a room with a chair and a table of the store */
Points
furnishedRoom()
{
  Room room;
  room.add(stored("chair").mesh, inRoom(standing(2, 0.3, 0.6)));
  room.add(stored("table").mesh, inRoom(standing(-1.5, -1.2, 0.2)));
  return room.scan();
}
} // namespace

TEST(ObjectFinder, FindsObjectsOfSeveralModels)
{
  const ObjectFinder finder({stored("chair"), stored("table")});
  const auto found = finder.find(furnishedRoom());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_GE(found[0].evidence, found[1].evidence);
  EXPECT_NE(found[0].object_class, found[1].object_class);
  for (const auto& object : found) {
    const Eigen::Vector3d truth = object.object_class == "chair"
                                      ? Eigen::Vector3d(2, 0.3, -kHeight)
                                      : Eigen::Vector3d(-1.5, -1.2, -kHeight);
    EXPECT_LT((object.T_scene_object.translation() - truth).norm(), 0.03);
  }
}

TEST(ObjectFinder, NeedsACascadeToAskOne)
{
  StoredModel chair = stored("chair");
  chair.range_cascade.reset();
  chair.reflectance_cascade.reset();
  ObjectFinderOptions options;
  options.proposals = ProposalMethod::kCascade;
  EXPECT_THROW(ObjectFinder({chair}, options), BadArgument);
}

TEST(ObjectFinder, NeedsPoints)
{
  EXPECT_THROW(ObjectFinder({stored("chair")}).find(Points(5)), BadArgument);
}

TEST(ReadModels, TakesEachClassOnce)
{
  const auto store = std::filesystem::path(PCL6D_SOURCE_DIR) / "share/models";
  EXPECT_EQ(readModels({}, store).size(), listModels(store).size());
  const std::string chair = (store / "chair").string();
  EXPECT_EQ(readModels({chair}).front().model.objectClass(), "chair");
  EXPECT_THROW(readModels({chair, chair}), BadArgument);
}

} // namespace pcl6d
