// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joined_by.h"
#include "place_hypotheses.h"
#include "scan_group.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Cuts a group into what was joined by way of a scan, with it, and the rest. */
void
divide(const ScanGroup& group,
       const JoinedBy& joined_by,
       std::size_t scan,
       ScanGroup& block,
       ScanGroup& rest);

/** \return members that the links between members, each judged anew, do not tie to the others
 * (tiesOf()), and why. The parts that are looked at are those that were joined by way of a
 * scan */
std::vector<std::pair<std::size_t, std::string>>
untiedOf(const ScanGroup& group, const JoinedBy& joined_by, unsigned int num_threads);

/** \brief Takes parts of a group that fit it elsewhere as well out of it.
 * \param[in] max_ambiguity as fitsElsewhere()
 * \return these parts */
std::vector<ScanGroup>
splitOff(ScanGroup& group,
         const JoinedBy& joined_by,
         const PlaceHypotheses& hypotheses,
         double max_ambiguity,
         unsigned int num_threads);

} // namespace pcl6d::global_registration
