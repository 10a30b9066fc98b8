// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "group/joined_by.h"
#include "group/scan_group.h"
#include "pair/place_hypotheses.h"

#include <pcl6d/common/rejection.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Splits a group into the scans joined by way of a scan, with the scan itself, and the
 * rest. */
void
divide(const ScanGroup& group,
       const JoinedBy& joined_by,
       std::size_t scan,
       ScanGroup& block,
       ScanGroup& rest);

/** \return members disconnected from the rest by the links between members, each tested anew
 * (tiesOf()), and the reason. The tested parts are the scans joined by way of one scan */
std::vector<std::pair<std::size_t, Rejection>>
disconnectedOf(const ScanGroup& group,
               const JoinedBy& joined_by,
               unsigned int num_threads);

/** \brief Takes ambiguous parts out of a group: parts with a second pose that fits as well.
 * \param[in] max_ambiguity as fitsElsewhere()
 * \return the removed parts */
std::vector<ScanGroup>
splitOff(ScanGroup& group,
         const JoinedBy& joined_by,
         const PlaceHypotheses& hypotheses,
         double max_ambiguity,
         unsigned int num_threads);

} // namespace pcl6d::global_registration
