// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "semantic_map/finished_run.h"

#include <pcl6d/semantic_map/semantic_map.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/** \file Where planes and objects of a map come from. */
namespace pcl6d::app {

/** \brief Where to take planes and objects from. */
struct ScenePartsOptions {
  std::filesystem::path planes;  ///< as planes.json; empty: see findPlanes()
  std::filesystem::path objects; ///< as objects.json; empty: see findObjects()
  std::filesystem::path rules;   ///< of labels; empty: the book's
  unsigned int num_threads = 0;  ///< 0: one per core; never changes the result
};

/** \brief Planes or objects, and where they come from, for people. */
template <typename Part>
struct SceneParts {
  std::vector<Part> parts;
  std::string source;
};

/** \brief The planes of a run, labelled: those of the given file, of planes.json in the
 * folder of the run, or found in its scans, labelled and refined (book 7.1), as
 * pcl_slam6d_planes does. Planes of a file without any label are labelled.
 * \return nothing if interrupted \throws IoFailed a file cannot be read */
std::optional<SceneParts<MapPlane>>
findPlanes(const FinishedRun& run,
           const ScenePartsOptions& options,
           ProgressBar& bar,
           const Interrupt& interrupt);

/** \brief The objects of a run, one entry per observation: those of the given file, or of
 * objects.json in the folder of the run; none without either. The place where
 * localisation with models plugs in.
 * \throws IoFailed a file cannot be read */
SceneParts<MapObject>
findObjects(const FinishedRun& run, const ScenePartsOptions& options);

} // namespace pcl6d::app
