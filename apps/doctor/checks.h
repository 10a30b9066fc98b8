// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/experiments.h"
#include "doctor/finding.h"
#include "doctor/measures.h"

#include <vector>

/** \file What the doctor looks for. Each check measures, and adds what it finds. */
namespace pcl6d::app {

/** \brief Of each cloud for itself: what a reader of PCL makes of the file, empty and NaN
 * rows, duplicates, normals, points without echo, digits, size, VIEWPOINT, indices. */
Findings
checkClouds(const DoctorPair& pair);

/** \brief Of both together, before any registration: overlap, spacing, units, the same
 * points twice, the guess. */
Findings
checkStart(const DoctorPair& pair);

/** \brief Of the runs: what a class did in silence.
 * \param[in] best place of the pose that is believed most; none: there is none */
Findings
checkRuns(const DoctorPair& pair,
          const std::vector<Experiment>& experiments,
          const std::optional<std::size_t>& best);

} // namespace pcl6d::app
