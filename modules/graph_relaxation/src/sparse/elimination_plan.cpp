// SPDX-License-Identifier: BSD-3-Clause
#include "sparse/elimination_plan.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <numeric>

namespace pcl6d::graph_relaxation {

namespace {
using Adjacency = std::vector<std::vector<std::size_t>>;

/** \return the neighbours of each vertex */
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

/** \return the vertices in an order of elimination with little fill */
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

/** \return the inverse permutation: for each i the index of the entry i */
std::vector<std::size_t>
inverseOf(const std::vector<std::size_t>& permutation)
{
  std::vector<std::size_t> inverse(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i)
    inverse[permutation[i]] = i;
  return inverse;
}

/** \return the graph with its vertices renumbered by the order */
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

/** \return the parent of each vertex, kNoSupernode for a root */
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

/** \return the nodes of a forest, children before parents, subtrees together */
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

/** \return the rows below the diagonal of each column of the factor, ascending
 * \param[in] graph with vertices in postorder of the tree */
Adjacency
factorRows(const Adjacency& graph, const std::vector<std::size_t>& parents)
{
  Adjacency rows(graph.size());
  std::vector<std::size_t> seen_by(graph.size(), kNoSupernode);
  for (std::size_t j = 0; j < graph.size(); ++j) {
    auto& own = rows[j]; // contains the rows from the children
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

/** A supernode while growing; its columns are not yet adjacent. */
struct Draft {
  std::vector<std::size_t> columns;
  std::vector<std::size_t> rows;
  std::size_t parent = kNoSupernode;
  double zeros = 0;    ///< stored blocks that are zero
  bool merged = false; ///< into its parent
};

/** \return drafts of consecutive columns with equal rows */
std::vector<Draft>
fundamentalSupernodes(const Adjacency& rows, const std::vector<std::size_t>& parents)
{
  std::vector<Draft> drafts;
  std::vector<std::size_t> draft_of(rows.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const bool continues =
        j > 0 && parents[j - 1] == j && rows[j - 1].size() == rows[j].size() + 1;
    if (!continues)
      drafts.emplace_back();
    draft_of[j] = drafts.size() - 1;
    drafts.back().columns.push_back(j);
    drafts.back().rows = rows[j];
  }
  for (auto& draft : drafts) {
    const std::size_t parent = parents[draft.columns.back()];
    draft.parent = parent == kNoSupernode ? parent : draft_of[parent];
  }
  return drafts;
}

/** \return whether the share of zeros in a supernode is acceptable: the overhead of a small
 * supernode exceeds its arithmetic */
bool
isWorthwhile(double columns, double zeros, double blocks)
{
  const double share = zeros / blocks;
  return columns <= 2    ? share < 0.6
         : columns <= 8  ? share < 0.3
         : columns <= 16 ? share < 0.1
                         : share < 0.05;
}

void
mergeIfWorthwhile(Draft& child, Draft& parent)
{
  const auto child_columns = static_cast<double>(child.columns.size());
  const auto columns = child_columns + static_cast<double>(parent.columns.size());
  const auto rows = static_cast<double>(parent.rows.size());
  const double below_child = columns - child_columns + rows;
  const double zeros =
      child.zeros + parent.zeros +
      child_columns * (below_child - static_cast<double>(child.rows.size()));
  const double blocks = columns * (columns + 1) / 2 + columns * rows;
  if (!isWorthwhile(columns, zeros, blocks))
    return;
  parent.columns.insert(
      parent.columns.begin(), child.columns.begin(), child.columns.end());
  parent.zeros = zeros;
  child.merged = true;
}

/** Merges children into parents where this adds few zeros. */
void
relax(std::vector<Draft>& drafts)
{
  // Children precede parents; the last child is the most similar to its parent.
  for (std::size_t i = drafts.size(); i-- > 0;) {
    std::size_t parent = drafts[i].parent;
    while (parent != kNoSupernode && drafts[parent].merged)
      parent = drafts[parent].parent;
    drafts[i].parent = parent;
    if (parent != kNoSupernode)
      mergeIfWorthwhile(drafts[i], drafts[parent]);
  }
}

/** Removes merged drafts. */
std::vector<Draft>
compacted(std::vector<Draft> drafts)
{
  std::vector<std::size_t> index(drafts.size(), kNoSupernode);
  std::vector<Draft> kept;
  for (std::size_t i = 0; i < drafts.size(); ++i)
    if (!drafts[i].merged) {
      index[i] = kept.size();
      kept.push_back(std::move(drafts[i]));
    }
  for (auto& draft : kept)
    if (draft.parent != kNoSupernode)
      draft.parent = index[draft.parent];
  return kept;
}

std::vector<std::size_t>
placesInParent(const Supernode& child, const Supernode& parent)
{
  std::vector<std::size_t> places;
  auto row = parent.rows.begin();
  for (const std::size_t wanted : child.rows) {
    if (wanted < parent.end) {
      places.push_back(wanted - parent.begin);
      continue;
    }
    row = std::lower_bound(row, parent.rows.end(), wanted);
    places.push_back(parent.numColumns() +
                     static_cast<std::size_t>(row - parent.rows.begin()));
  }
  return places;
}

double
workOf(const Supernode& node)
{
  const auto k = static_cast<double>(node.numColumns());
  const auto r = static_cast<double>(node.rows.size());
  return k * k * k / 3 + k * k * r + k * r * r + r * r;
}

/** Puts the drafts in postorder: the final order of their columns. */
void
makeSupernodes(const std::vector<Draft>& drafts,
               const std::vector<std::size_t>& block_of_column,
               EliminationPlan& plan)
{
  std::vector<std::size_t> parents;
  for (const auto& draft : drafts)
    parents.push_back(draft.parent);
  const std::vector<std::size_t> order = postorder(parents);
  const std::vector<std::size_t> index = inverseOf(order);
  std::vector<std::size_t> place_of_column(block_of_column.size());
  for (const std::size_t draft : order) {
    Supernode node;
    node.begin = plan.block_at.size();
    for (const std::size_t column : drafts[draft].columns) {
      place_of_column[column] = plan.block_at.size();
      plan.block_at.push_back(block_of_column[column]);
    }
    node.end = plan.block_at.size();
    node.parent = drafts[draft].parent;
    if (node.parent != kNoSupernode)
      node.parent = index[node.parent];
    plan.supernodes.push_back(std::move(node));
  }
  plan.place_of = inverseOf(plan.block_at);
  for (std::size_t i = 0; i < order.size(); ++i) {
    auto& rows = plan.supernodes[i].rows;
    for (const std::size_t row : drafts[order[i]].rows)
      rows.push_back(place_of_column[row]);
    std::sort(rows.begin(), rows.end());
  }
}

void
connect(std::vector<Supernode>& nodes)
{
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].work = workOf(nodes[i]);
    nodes[i].subtree_work += nodes[i].work; // its children have added theirs
    if (nodes[i].parent == kNoSupernode)
      continue;
    Supernode& parent = nodes[nodes[i].parent];
    parent.children.push_back(i);
    parent.subtree_work += nodes[i].subtree_work;
    nodes[i].place_in_parent = placesInParent(nodes[i], parent);
  }
}

/** Cuts the tree below its top so that no subtree is a large part of the total work. */
void
cutSubtrees(EliminationPlan& plan)
{
  constexpr double kLargestShare = 1.0 / 16;
  const auto& nodes = plan.supernodes;
  double total = 0;
  for (const auto& node : nodes)
    total += node.work;
  std::vector<std::size_t> subtree_of(nodes.size(), kNoSupernode);
  std::vector<std::size_t> roots;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const std::size_t parent = nodes[i].parent;
    if (parent != kNoSupernode && subtree_of[parent] != kNoSupernode)
      subtree_of[i] = subtree_of[parent];
    else if (nodes[i].subtree_work > kLargestShare * total)
      plan.top.push_back(i);
    else {
      subtree_of[i] = roots.size();
      roots.push_back(i);
    }
  }
  std::reverse(plan.top.begin(), plan.top.end());
  std::vector<std::size_t> heaviest(roots.size());
  std::iota(heaviest.begin(), heaviest.end(), 0);
  std::stable_sort(heaviest.begin(), heaviest.end(), [&](auto a, auto b) {
    return nodes[roots[a]].subtree_work > nodes[roots[b]].subtree_work;
  });
  const std::vector<std::size_t> rank = inverseOf(heaviest);
  plan.subtrees.resize(roots.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (subtree_of[i] != kNoSupernode)
      plan.subtrees[rank[subtree_of[i]]].push_back(i);
}
} // namespace

EliminationPlan
planElimination(std::size_t num_blocks,
                const std::vector<std::pair<std::size_t, std::size_t>>& couplings)
{
  const Adjacency graph = adjacencyOf(num_blocks, couplings);
  std::vector<std::size_t> order = fillReducingOrder(graph);
  const std::vector<std::size_t> tree_order =
      postorder(eliminationTree(renamed(graph, order)));
  std::vector<std::size_t> block_of_column(num_blocks);
  for (std::size_t i = 0; i < num_blocks; ++i)
    block_of_column[i] = order[tree_order[i]];
  const Adjacency ordered = renamed(graph, block_of_column);
  const std::vector<std::size_t> parents = eliminationTree(ordered);
  std::vector<Draft> drafts =
      fundamentalSupernodes(factorRows(ordered, parents), parents);
  relax(drafts);
  EliminationPlan plan;
  makeSupernodes(compacted(std::move(drafts)), block_of_column, plan);
  connect(plan.supernodes);
  cutSubtrees(plan);
  return plan;
}

} // namespace pcl6d::graph_relaxation
