// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/experiments.h"

#include <string>

namespace pcl6d::app {

/** \return how a run ended that is not done: "crashed: Segmentation fault" */
std::string
endWords(const ClassOutcome& out);

/** \return what a class says: "converged", "not converged (iteration limit)", or in a word
 * how it ended */
std::string
briefWords(const ClassOutcome& out);

/** \return the same in one word, for tables: "converged", "not converged", "no pose" */
std::string
saidShortly(const ClassOutcome& out);

} // namespace pcl6d::app
