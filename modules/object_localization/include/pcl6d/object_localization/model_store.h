// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/object_localization/object_model.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A model of an object to search for: shape, class, symmetry, and the detectors
 * trained for it. \ingroup object_localization */
struct StoredModel {
  ObjectModel model;    ///< z up, with its class and symmetry
  TriangleMesh mesh;    ///< of the model; of a cloud, small squares, see meshOfPoints()
  bool has_mesh = true; ///< false: the file was a cloud
  std::optional<std::filesystem::path> range_cascade;       ///< file
  std::optional<std::filesystem::path> reflectance_cascade; ///< file
};

/** \brief Units and class of a model read from a single file. */
struct ModelFileOptions {
  MeshOptions units;                            ///< of meshes and clouds
  std::optional<std::string> object_class = {}; ///< default: the file's name
};

/** \brief Reads a mesh (.ply, .obj, .stl) or a cloud (formats of readScan(); its
 * normals are used if present), without cascades and symmetry.
 * \throws IoFailed naming the file: see readMesh(), readScan() and ObjectModel; no
 * points, a diameter too large for metres, or a file name that is not a valid class,
 * see checkObjectClass()
 * \throws BadArgument the class of the options is not valid, or scale <= 0 */
StoredModel
readModelFile(const std::filesystem::path& file, const ModelFileOptions& options = {});

/** \brief Reads a folder of the store or a single file, see readModelFile(). A folder
 * holds model.json and the files named there:
 * \code
 * {"schema_version": 1,
 *  "class": "chair",
 *  "file": "model.ply",
 *  "scale": 1,              // [m] per unit of the file
 *  "up": "z",               // or y
 *  "symmetry": "none",      // or round, or turn:4, about the z axis
 *  "cascades": {"range": "range.xml", "reflectance": "reflectance.xml"}}
 * \endcode
 * Only class and file are required; the cascades are not opened.
 * \throws IoFailed naming file and JSON pointer: a field missing, unknown or of another
 * type, a file missing, a class rejected by checkObjectClass(), or a symmetry that the
 * mesh does not have */
StoredModel
readStoredModel(const std::filesystem::path& path);

/** \return the folders of a store with a model.json, sorted by name
 * \throws IoFailed the store cannot be read, or holds no model */
std::vector<std::filesystem::path>
listModels(const std::filesystem::path& store);

/** \brief Reads models to search for together: files, folders of the store, and every
 * model of a store. An empty store path means no store.
 * \throws IoFailed see readStoredModel() and listModels() \throws BadArgument two
 * models are of one class */
std::vector<StoredModel>
readModels(const std::vector<std::string>& paths,
           const std::filesystem::path& store = {},
           const ModelFileOptions& options = {});

/** \brief Checks a class name. Classes are words of queries and names in files: 1 to 64
 * letters (of any language, in UTF-8), digits, '-', '_' and '.', the first a letter or
 * a digit.
 * \throws BadArgument the name is not valid */
void
checkObjectClass(const std::string& object_class);

} // namespace pcl6d
