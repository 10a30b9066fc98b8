// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "object_localization/detection_room.h"
#include "object_localization/localization_cases.h"
#include "support/folders.h"

#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <vector>

/** \file Objects of the store at known places of a simulated room. */
namespace pcl6d::test {

inline constexpr double kHeight = 0.8; // [m] of the scanner over the floor

inline StoredModel
stored(const std::string& name)
{
  return readStoredModel(std::filesystem::path(PCL6D_SOURCE_DIR) / "share/models" /
                         name);
}

/** Objects in a room that is scanned from its middle. */
class Room {
public:
  void
  add(const TriangleMesh& mesh, const Eigen::Isometry3d& T_room_object)
  {
    addMesh(scene_, mesh, T_room_object, {});
  }
  void
  addBlock(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
  {
    addBox(scene_, low, high, {});
  }

  Points
  scan(double noise = 0) const
  {
    return scanOf(
        scene_, scannerByName("rotating"), poseFromEuler({0, 0, kHeight}, {}), noise);
  }

private:
  TriangleScene scene_ = room();
};

/** \return T_scene_object of what stands on the floor at a place of the room */
inline Eigen::Isometry3d
standing(double x, double y, double yaw)
{
  return poseFromEuler({x, y, -kHeight}, {0, 0, yaw});
}

/** \return T_room_object of the same */
inline Eigen::Isometry3d
inRoom(const Eigen::Isometry3d& T_scene_object)
{
  return Eigen::Translation3d(0, 0, kHeight) * T_scene_object;
}

inline std::vector<LocalizedObject>
locate(const ObjectModel& model, const Points& points, unsigned int num_threads = 0)
{
  LocalizerOptions options;
  options.num_threads = num_threads;
  const LocalizationScene scene(points, num_threads);
  const PlaneCloud cloud(scene.points(), num_threads);
  ProposalOptions proposing;
  proposing.num_threads = num_threads;
  return ObjectLocalizer(model, options)
      .locate(scene, proposeObjects(cloud, segmentPlanes(cloud), proposing));
}

} // namespace pcl6d::test
