// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "evaluate/suite/suite_file.h"

#include <optional>

namespace pcl6d::app {

/** \brief The scans of a data set. */
struct PreparedData {
  std::filesystem::path scans;   ///< their folder
  nlohmann::ordered_json inputs; ///< what they depend on
  std::string fault;             ///< reason for missing scans; else empty
};

/** \brief Simulates scans, unless done by an earlier call; recorded data is checked for
 * changed files. \param[in] folder to simulate into; FOLDER.json and FOLDER.log lie
 * beside it \param[in] programs from describePrograms()
 * \param[in] time_limit [s] \return empty if interrupted
 * \throws IoFailed a file cannot be written */
std::optional<PreparedData>
prepareData(const SuiteData& data,
            const std::filesystem::path& folder,
            const nlohmann::ordered_json& programs,
            double time_limit,
            const Interrupt& interrupt,
            ProgressBar& bar);

/** \brief Makes damaged scans, unless done by an earlier call.
 * \param[in] source the scans without damage \param[in] foreign scans of the data set
 * for a foreign scan; null if not needed
 * \param[in] truth of the source; may be empty
 * \param[in] folder to write; FOLDER.json lies beside it
 * \return the source itself if no file differs; with a fault if the damage is
 * impossible
 * \throws IoFailed a file cannot be written */
PreparedData
prepareDamaged(const SuiteData& data,
               const PreparedData& source,
               const PreparedData* foreign,
               const std::filesystem::path& truth,
               const std::filesystem::path& folder);

/** \return the file with the links of a damaged folder, for --graph-in */
std::filesystem::path
linksOf(const std::filesystem::path& folder);

/** \brief Removes a folder of ours and makes a new, empty folder: no unfinished files
 * remain.
 * \throws IoFailed writing failed */
void
makeAnew(const std::filesystem::path& folder);

} // namespace pcl6d::app
