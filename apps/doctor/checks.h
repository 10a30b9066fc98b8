// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/finding.h"
#include "doctor/measures.h"
#include "doctor/peers/experiments.h"

#include <vector>

/** \file Checks of the doctor. Each check measures, and adds its findings. */
namespace pcl6d::app {

/** \brief Checks each cloud alone: the file as read by PCL, empty and NaN rows,
 * duplicates, normals, points without echo, digits, size, VIEWPOINT, indices. */
Findings
checkClouds(const DoctorPair& pair);

/** \brief Checks both clouds before any registration: overlap, spacing, units,
 * identical points, the guess. */
Findings
checkStart(const DoctorPair& pair);

/** \brief Checks the runs for silent failures and surprises of a class.
 * \param[in] best index of the most reliable pose; empty: no pose */
Findings
checkRuns(const DoctorPair& pair,
          const std::vector<Experiment>& experiments,
          const std::optional<std::size_t>& best);

} // namespace pcl6d::app
