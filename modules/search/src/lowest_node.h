// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tree_items.h"

#include <pcl6d/search/point_tree.h>

namespace pcl6d::search {

/** The axes of the cuts between the leaves of one node: cut c is followed by 2c + 1 and
 * 2c + 2. */
using LowestAxes = int[7];

/** Makes the lowest nodes with their leaves.
 * \param[in] items 1 to 64 items; may lie in the memory of the leaves
 * \param[out] leaves as many as needed, full but for the last
 * \param[out] node boxes of the leaves \return box of the items */
ItemBox
makeLowestNode(const Item* items,
               int count,
               PointTree::Leaf* leaves,
               PointTree::Node& node,
               LowestAxes& axes);

} // namespace pcl6d::search
