// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/triangle_mesh.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The shapes of objects by their class, out of a folder that holds CLASS.ply, .obj
 * or .stl [m], or is a store of models as pcl_slam6d_objects takes it. */
class ObjectShapes {
public:
  /** \param[in] folder empty: there are none
   * \throws IoFailed it is no folder */
  explicit ObjectShapes(const std::filesystem::path& folder);

  /** \return the shape in the object's frame, kept for the next time; null if there is
   * none \throws IoFailed its file is broken */
  const TriangleMesh*
  of(const std::string& object_class);

private:
  std::optional<TriangleMesh>
  read(const std::string& object_class) const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> store_; ///< folders of models
  std::map<std::string, std::optional<TriangleMesh>> known_;
};

} // namespace pcl6d::app
