// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/input/run_input.h"

#include <pcl6d/common/work_sharing.h>

#include <memory>
#include <string>

namespace pcl6d::app {

/** \brief Joins the processes started together by mpirun or srun. Only the first process prints.
 * \return null if this process was started alone
 * \throws IoFailed the program was built without MPI, or with an MPI different from the
 * launcher's */
std::unique_ptr<WorkSharing>
joinRanks();

/** \return the message that the first process prints about an error of another process */
std::string
ofRank(const WorkSharing& ranks, const std::string& error);

/** \brief Checks that all processes run equal builds on equal scans, poses and options. Afterwards,
 * this process ends at once on the signal that a launcher sends when a process dies; the first
 * process tells the user how to continue.
 * \param[in] name of the program, for messages
 * \throws IoFailed naming the first difference */
void
agreeOnInput(WorkSharing& ranks,
             const std::string& name,
             const Settings& settings,
             const ScanFolder& folder);

/** \brief The part of every process except the first: computes its share of the work, and writes no
 * files. */
void
help(WorkSharing& ranks, const std::string& name, const Settings& settings);

} // namespace pcl6d::app
