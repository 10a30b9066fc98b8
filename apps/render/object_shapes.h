// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/triangle_mesh.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The shapes of objects by class, from a folder of CLASS.ply, .obj or .stl [m],
 * or from a model store of pcl_slam6d_objects. */
class ObjectShapes {
public:
  /** \param[in] folder may be empty: no shapes
   * \throws IoFailed the path is no folder */
  explicit ObjectShapes(const std::filesystem::path& folder);

  /** \return the shape in the object's frame, cached; null if missing \throws IoFailed
   * its file is broken */
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
