// SPDX-License-Identifier: BSD-3-Clause
#include "sparse/elimination_plan.h"
#include "sparse/elimination_tree.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>

namespace pcl6d::graph_relaxation {

Adjacency
adjacencyOf(std::size_t size,
            const std::vector<std::pair<std::size_t, std::size_t>>& couplings)
{
  Adjacency graph(size);
  for (const auto& [a, b] : couplings) {
    graph[a].push_back(b);
    graph[b].push_back(a);
  }
  return graph;
}

std::vector<std::size_t>
fillReducingOrder(const Adjacency& graph)
{
  const auto size = static_cast<int>(graph.size());
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int column = 0; column < size; ++column) {
    entries.emplace_back(column, column, 1.0); // else Eigen gives the identity
    for (const std::size_t row : graph[column])
      entries.emplace_back(static_cast<int>(row), column, 1.0);
  }
  Eigen::SparseMatrix<double, Eigen::ColMajor, int> pattern(size, size);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(pattern, order);
  return {order.indices().data(), order.indices().data() + size};
}

std::vector<std::size_t>
inverseOf(const std::vector<std::size_t>& permutation)
{
  std::vector<std::size_t> inverse(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i)
    inverse[permutation[i]] = i;
  return inverse;
}

Adjacency
renamed(const Adjacency& graph, const std::vector<std::size_t>& order)
{
  const std::vector<std::size_t> place = inverseOf(order);
  Adjacency result(graph.size());
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const std::size_t neighbour : graph[order[i]])
      result[i].push_back(place[neighbour]);
  return result;
}

std::vector<std::size_t>
eliminationTree(const Adjacency& graph)
{
  std::vector<std::size_t> parents(graph.size(), kNoSupernode);
  std::vector<std::size_t> shortcuts = parents; // towards the root known so far
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (std::size_t j : graph[i])
      while (j < i) { // climb from an earlier neighbour; its root becomes a child of i
        const std::size_t next = shortcuts[j];
        shortcuts[j] = i;
        if (next == kNoSupernode)
          parents[j] = i;
        j = next;
      }
  return parents;
}

std::vector<std::size_t>
postorder(const std::vector<std::size_t>& parents)
{
  Adjacency children(parents.size());
  std::vector<std::size_t> stack;
  for (std::size_t i = parents.size(); i-- > 0;)
    if (parents[i] == kNoSupernode)
      stack.push_back(i);
    else
      children[parents[i]].push_back(i);
  // Parents before children from the last root on, then turned round.
  std::reverse(stack.begin(), stack.end());
  std::vector<std::size_t> order;
  while (!stack.empty()) {
    const std::size_t node = stack.back();
    stack.pop_back();
    order.push_back(node);
    stack.insert(stack.end(), children[node].rbegin(), children[node].rend());
  }
  std::reverse(order.begin(), order.end());
  return order;
}

Adjacency
factorRows(const Adjacency& graph, const std::vector<std::size_t>& parents)
{
  Adjacency rows(graph.size());
  std::vector<std::size_t> seen_by(graph.size(), kNoSupernode);
  for (std::size_t j = 0; j < graph.size(); ++j) {
    auto& own = rows[j]; // holds what the children have passed on
    for (const std::size_t row : own)
      seen_by[row] = j;
    for (const std::size_t row : graph[j])
      if (row > j && seen_by[row] != j) {
        seen_by[row] = j;
        own.push_back(row);
      }
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (parents[j] == kNoSupernode)
      continue;
    auto& above = rows[parents[j]];
    std::copy_if(own.begin(), own.end(), std::back_inserter(above), [&](auto row) {
      return row != parents[j];
    });
  }
  return rows;
}

} // namespace pcl6d::graph_relaxation
