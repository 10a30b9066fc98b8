// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/peers/experiments.h"

#include <string>

namespace pcl6d::app {

/** \return the end of a failed run in words: "crashed: Segmentation fault" */
std::string
endWords(const ClassOutcome& out);

/** \return the state reported by a class: "converged", "not converged (iteration
 * limit)", or the end of the run in a word */
std::string
briefWords(const ClassOutcome& out);

/** \return the state as briefWords(), shorter, for tables: "converged", "not
 * converged", "no pose" */
std::string
saidShortly(const ClassOutcome& out);

} // namespace pcl6d::app
