// SPDX-License-Identifier: BSD-3-Clause
#include "diffusion/loop_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kZeroCost = 1e-12; ///< for 0, relative to the smallest positive cost
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/** Scales the costs to at most 1, against overflow of sums, and makes the costs positive. */
std::vector<WeightedEdge>
positiveCosts(std::vector<WeightedEdge> edges)
{
  double largest = 0;
  for (const auto& edge : edges)
    largest = std::max(largest, edge.cost);
  double smallest = 1;
  for (auto& edge : edges) {
    edge.cost = largest > 0 ? edge.cost / largest : 1;
    if (edge.cost > 0)
      smallest = std::min(smallest, edge.cost);
  }
  const double zero =
      std::max(kZeroCost * smallest, std::numeric_limits<double>::min());
  for (auto& edge : edges)
    edge.cost = std::max(edge.cost, zero);
  return edges;
}

/** The weights of a graph during the search.
 *
 * A vertex with a weight is a terminal. Each remaining vertex stores its nearest terminal, by a
 * shortest path through vertices without weights. The shortest path between two terminals then
 * runs across the best edge between regions of different terminals: from both ends of the edge
 * back to the terminals (K. Mehlhorn, "A faster approximation algorithm for the Steiner problem
 * in graphs", 1988). After a path has its weights, its vertices are terminals, too, and
 * distances only shrink. Its edges need not be deleted: both ends have weights, so that no
 * weight is left to find across the edge. */
class ElchGraph {
public:
  ElchGraph(std::size_t num_vertices, const std::vector<WeightedEdge>& edges)
  : edges_(positiveCosts(edges)), start_(num_vertices + 1), vertices_(num_vertices)
  {
    for (const auto& edge : edges_) {
      ++start_[edge.a];
      ++start_[edge.b];
    }
    std::size_t sum = 0;
    for (auto& start : start_)
      start = sum += start;
    incident_.resize(sum);
    for (std::size_t e = edges_.size(); e-- > 0;) {
      incident_[--start_[edges_[e].a]] = e;
      incident_[--start_[edges_[e].b]] = e;
    }
  }

  /** \return the weights; empty if no path joins the two */
  std::vector<double>
  solve(std::size_t first, std::size_t last)
  {
    addTerminal(first, 0);
    addTerminal(last, 1);
    spread();
    bool joined = false;
    for (std::size_t e = popBridge(); e != kNone; e = popBridge()) {
      joined = true;
      weighPath(e);
      spread();
    }
    std::vector<double> weights;
    if (!joined)
      return weights;
    for (const auto& v : vertices_) // branches: weight of the terminal at their root
      weights.push_back(v.terminal == kNone ? 0 : vertices_[v.terminal].weight);
    return weights;
  }

private:
  struct Vertex {
    double distance = kInfinity;  ///< from its terminal
    std::size_t terminal = kNone; ///< the nearest; of a terminal: itself
    std::size_t edge = kNone;     ///< last edge of the path from the terminal
    double weight = 0;            ///< of a terminal
  };
  using Entry = std::tuple<double, std::size_t>; ///< distance or length; vertex or edge
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

  std::size_t
  otherEnd(std::size_t e, std::size_t v) const
  {
    return edges_[e].a == v ? edges_[e].b : edges_[e].a;
  }

  void
  addTerminal(std::size_t v, double weight)
  {
    vertices_[v] = {0, v, kNone, weight};
    frontier_.emplace(0, v);
  }

  /** The length of the path between terminals across an edge, which may be the edge alone;
   * infinite if the edge joins a region with itself. */
  double
  lengthAcross(std::size_t e) const
  {
    const Vertex &a = vertices_[edges_[e].a], &b = vertices_[edges_[e].b];
    if (a.terminal == b.terminal || a.terminal == kNone || b.terminal == kNone)
      return kInfinity;
    return a.distance + edges_[e].cost + b.distance;
  }

  /** Dijkstra's algorithm from where distances have become shorter. */
  void
  spread()
  {
    while (!frontier_.empty()) {
      const auto [distance, v] = frontier_.top();
      frontier_.pop();
      if (distance > vertices_[v].distance)
        continue; // a shorter way was found meanwhile
      for (std::size_t i = start_[v]; i < start_[v + 1]; ++i)
        follow(incident_[i], v);
    }
  }

  void
  follow(std::size_t e, std::size_t v)
  {
    const std::size_t n = otherEnd(e, v);
    const double distance = vertices_[v].distance + edges_[e].cost;
    // A path through v changes its terminal with v, even if rounding swallows the gain.
    const bool follows = vertices_[n].edge == e;
    if (distance < vertices_[n].distance ||
        (follows && vertices_[n].terminal != vertices_[v].terminal)) {
      vertices_[n].distance = distance;
      vertices_[n].terminal = vertices_[v].terminal;
      vertices_[n].edge = e;
      frontier_.emplace(distance, n);
    }
    if (const double length = lengthAcross(e); length < kInfinity)
      bridges_.emplace(length, e);
  }

  /** \return the edge of the shortest path between terminals across regions, or kNone */
  std::size_t
  popBridge()
  {
    while (!bridges_.empty()) {
      const auto [length, e] = bridges_.top();
      bridges_.pop();
      if (length == lengthAcross(e)) // still so
        return e;
    }
    return kNone;
  }

  /** Makes terminals of the vertices of the path across an edge. */
  void
  weighPath(std::size_t bridge)
  {
    const double length = lengthAcross(bridge);
    const std::size_t from = vertices_[edges_[bridge].a].terminal;
    const std::size_t to = vertices_[edges_[bridge].b].terminal;
    const double w = vertices_[from].weight, rise = vertices_[to].weight - w;
    const auto weighBack = [&](std::size_t v, auto&& shareOf) {
      while (vertices_[v].edge != kNone) {
        const std::size_t before = otherEnd(vertices_[v].edge, v);
        addTerminal(v, w + rise * shareOf(vertices_[v].distance));
        v = before;
      }
    };
    weighBack(edges_[bridge].a, [&](double d) { return d / length; });
    weighBack(edges_[bridge].b, [&](double d) { return (length - d) / length; });
  }

  std::vector<WeightedEdge> edges_;
  std::vector<std::size_t> start_;    ///< of each vertex in incident_
  std::vector<std::size_t> incident_; ///< edges, by vertex
  std::vector<Vertex> vertices_;
  Queue frontier_; ///< vertices with a shortened distance
  Queue bridges_;  ///< edges between regions
};
} // namespace

std::vector<double>
elchWeights(std::size_t num_vertices,
            const std::vector<WeightedEdge>& edges,
            std::size_t first,
            std::size_t last)
{
  requireLoop(num_vertices, first, last);
  for (const auto& edge : edges) {
    requireEnds(num_vertices, edge.a, edge.b);
    require(std::isfinite(edge.cost) && edge.cost >= 0,
            "cost of an edge",
            edge.cost,
            "finite and >= 0");
  }
  return ElchGraph(num_vertices, edges).solve(first, last);
}

} // namespace pcl6d
