// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

/** \file Steps of planElimination(). Internal to the module graph_relaxation. */
namespace pcl6d::graph_relaxation {

using Adjacency = std::vector<std::vector<std::size_t>>;

/** \return the neighbours of each vertex */
Adjacency
adjacencyOf(std::size_t size,
            const std::vector<std::pair<std::size_t, std::size_t>>& couplings);

/** \return the vertices in an order of elimination with little fill */
std::vector<std::size_t>
fillReducingOrder(const Adjacency& graph);

/** \return the graph with its vertices named by their place in the order */
Adjacency
renamed(const Adjacency& graph, const std::vector<std::size_t>& order);

/** \return the parent of each vertex, kNoSupernode for a root */
std::vector<std::size_t>
eliminationTree(const Adjacency& graph);

/** \return the nodes of a forest, children before parents, subtrees together */
std::vector<std::size_t>
postorder(const std::vector<std::size_t>& parents);

/** \return for each place i the i-th entry's index: the inverse permutation */
std::vector<std::size_t>
inverseOf(const std::vector<std::size_t>& permutation);

/** \return the rows below the diagonal of each column of the factor, ascending
 * \param[in] graph whose vertices are in postorder of the tree */
Adjacency
factorRows(const Adjacency& graph, const std::vector<std::size_t>& parents);

} // namespace pcl6d::graph_relaxation
