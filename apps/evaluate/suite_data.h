// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "evaluate/suite_file.h"

#include <optional>

namespace pcl6d::app {

/** \brief The scans of a data set. */
struct PreparedData {
  std::filesystem::path scans;   ///< their folder
  nlohmann::ordered_json inputs; ///< what they depend on
  std::string fault;             ///< why there are none; else empty
};

/** \brief Simulates scans unless they are there from an earlier call; of other data it looks
 * for changes of the files. \param[in] folder to simulate into; FOLDER.json and FOLDER.log
 * lie beside it \param[in] programs as described by describePrograms()
 * \param[in] time_limit [s] \return nothing if interrupted
 * \throws IoFailed a file cannot be written */
std::optional<PreparedData>
prepareData(const SuiteData& data,
            const std::filesystem::path& folder,
            const nlohmann::ordered_json& programs,
            double time_limit,
            const Interrupt& interrupt,
            ProgressBar& bar);

/** \brief Removes a folder of ours and makes it anew, so that nothing half finished stays.
 * \throws IoFailed it cannot be written */
void
makeAnew(const std::filesystem::path& folder);

} // namespace pcl6d::app
