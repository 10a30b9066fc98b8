// SPDX-License-Identifier: BSD-3-Clause
#include "render/object_shapes.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/object_localization/model_store.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr const char* kModelFile = "model.json";

/** \return the folders of models in a folder, or the folder, if it contains a model */
std::vector<fs::path>
modelsIn(const fs::path& folder)
{
  if (fs::exists(folder / kModelFile))
    return {folder};
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path() / kModelFile))
      return listModels(folder);
  return {};
}
} // namespace

ObjectShapes::ObjectShapes(const fs::path& folder) : folder_(folder)
{
  if (folder.empty())
    return;
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw IoFailed(folder.string() + ": no such folder of models");
  store_ = modelsIn(folder);
}

const TriangleMesh*
ObjectShapes::of(const std::string& object_class)
{
  auto known = known_.find(object_class);
  if (known == known_.end())
    known = known_.emplace(object_class, read(object_class)).first;
  return known->second ? &*known->second : nullptr;
}

std::optional<TriangleMesh>
ObjectShapes::read(const std::string& object_class) const
{
  if (folder_.empty())
    return std::nullopt;
  for (const char* const extension : {".ply", ".obj", ".stl"})
    if (const fs::path file = folder_ / (object_class + extension); fs::exists(file))
      return readMesh(file);
  for (const fs::path& path : store_)
    if (const StoredModel stored = readStoredModel(path);
        stored.model.objectClass() == object_class)
      return stored.mesh;
  return std::nullopt;
}

} // namespace pcl6d::app
