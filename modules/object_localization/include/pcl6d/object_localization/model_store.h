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

/** \brief An object that scans are searched for: its shape, what is known of it, and the
 * detectors that were trained for it. \ingroup object_localization */
struct StoredModel {
  ObjectModel model;    ///< z up, with its class and symmetry
  TriangleMesh mesh;    ///< the same; of a cloud, small squares, see meshOfPoints()
  bool has_mesh = true; ///< false: the file was a cloud
  std::optional<std::filesystem::path> range_cascade;       ///< file
  std::optional<std::filesystem::path> reflectance_cascade; ///< file
};

/** \brief What to know of a single file. */
struct ModelFileOptions {
  MeshOptions units;                            ///< of clouds, too
  std::optional<std::string> object_class = {}; ///< else the file's name
};

/** \brief Reads a mesh (.ply, .obj, .stl) or a cloud (as readScan(); its normals are
 * taken, if it has any), without cascades and symmetry.
 * \throws IoFailed naming the file: as readMesh() and readScan(), or as ObjectModel:
 * no points, or so large that it is hardly in metres; or the class that is its name is
 * none, see checkObjectClass()
 * \throws BadArgument that of the options is none, or scale <= 0 */
StoredModel
readModelFile(const std::filesystem::path& file, const ModelFileOptions& options = {});

/** \brief Reads a folder of the store or a single file, see readModelFile(). A folder
 * holds model.json and what it names:
 * \code
 * {"schema_version": 1,
 *  "class": "chair",
 *  "file": "model.ply",
 *  "scale": 1,              // [m] per unit of the file
 *  "up": "z",               // or y
 *  "symmetry": "none",      // or round, or turn:4, about the z axis
 *  "cascades": {"range": "range.xml", "reflectance": "reflectance.xml"}}
 * \endcode
 * Only class and file must be there; the cascades are not opened.
 * \throws IoFailed naming file and JSON pointer: what is missing, of another type or not
 * known, files that are missing, a class that checkObjectClass() refuses, and of a mesh a
 * symmetry that it does not have */
StoredModel
readStoredModel(const std::filesystem::path& path);

/** \return the folders in a store, those with a model.json, by name
 * \throws IoFailed it cannot be read, or holds none */
std::vector<std::filesystem::path>
listModels(const std::filesystem::path& store);

/** \brief Reads models that are to be looked for together: files, folders of the store, and
 * all models of a store, which may be empty for none.
 * \throws IoFailed as the readers \throws BadArgument two are of one class */
std::vector<StoredModel>
readModels(const std::vector<std::string>& paths,
           const std::filesystem::path& store = {},
           const ModelFileOptions& options = {});

/** \brief Classes are words of queries and names in files: 1 to 64 letters (of any
 * language, in UTF-8), digits, '-', '_' and '.', the first a letter or a digit.
 * \throws BadArgument it is none */
void
checkObjectClass(const std::string& object_class);

} // namespace pcl6d
