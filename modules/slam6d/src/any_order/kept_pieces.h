// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "any_order/joined_runs.h"

#include <pcl6d/common/export.h>

#include <cstddef>
#include <utility>
#include <vector>

/** \file Pieces of a drive that a start in any order keeps: lost scans in a row, matched with each
 * other while the order of the scans was tried. */
namespace pcl6d::slam6d {

/** \return the known poses, and for further scans their poses in their pieces */
KnownPlaces
withPieces(KnownPlaces known, const KnownPlaces& pieces);

/** \return the pairs of scans to compare: of each piece only some scans (comparedOfPiece()) with all
 * other scans; empty, which means every pair, without pieces */
PCL6D_EXPORTS std::vector<std::pair<std::size_t, std::size_t>> // exported for its test
pairsBesidePieces(const KnownPlaces& pieces);

} // namespace pcl6d::slam6d
