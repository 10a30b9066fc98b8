// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/run_input.h"

#include <pcl6d/common/work_sharing.h>

#include <memory>
#include <string>

namespace pcl6d::app {

/** \brief Joins the processes that mpirun or srun has started together. Of these the first
 * alone prints.
 * \return null if this process was started alone
 * \throws IoFailed the program was built without MPI, or with another one than that of the
 * launcher */
std::unique_ptr<WorkSharing>
joinRanks();

/** \return what the first process is to print of an error that another one has alone */
std::string
ofRank(const WorkSharing& ranks, const std::string& error);

/** \brief Makes sure that all processes run the same build on the same scans, poses and options.
 * Afterwards a signal, by which a launcher ends the others when one of them dies, ends this one
 * at once; the first tells the user how to go on.
 * \param[in] name of the program, for messages
 * \throws IoFailed they do not; the first difference is named */
void
agreeOnInput(WorkSharing& ranks,
             const std::string& name,
             const Settings& settings,
             const ScanFolder& folder);

/** \brief What all but the first process do: their share of the work. Writes nothing. */
void
help(WorkSharing& ranks, const std::string& name, const Settings& settings);

} // namespace pcl6d::app
