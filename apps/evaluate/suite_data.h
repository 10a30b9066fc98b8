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

/** \brief Damages scans unless that is done from an earlier call.
 * \param[in] source the scans without damage \param[in] foreign those of the data set that
 * a foreign scan comes from; null if none does
 * \param[in] truth of the source; empty if there is none
 * \param[in] folder to write; FOLDER.json lies beside it
 * \return the source itself if no file differs; with a fault if it cannot be damaged so
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

/** \brief Removes a folder of ours and makes it anew, so that nothing half finished stays.
 * \throws IoFailed it cannot be written */
void
makeAnew(const std::filesystem::path& folder);

} // namespace pcl6d::app
