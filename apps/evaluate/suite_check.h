// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite_file.h"

namespace pcl6d::app {

/** \brief Checks what a suite asks for, before anything runs: that pcl_slam6d and
 * pcl_slam6d_simulate know the options and take their values, each set alone and with those
 * of every data set, and that scans, poses and reference of every folder can be read. The
 * working folder must be that of the suite file, from which its paths count.
 * \throws UsageError naming file, place (a JSON pointer) and what is wrong */
void
checkSuite(const Suite& suite);

} // namespace pcl6d::app
