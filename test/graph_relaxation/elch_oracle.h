// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/error_diffusion.h>

#include <limits>
#include <list>
#include <set>

namespace pcl6d::test {

/** \brief The weights of ELCH as the paper tells them: all pairs of crossings, one by
 * one, in the graph that is left. Slow and plain, an oracle. */
class ElchOracle {
public:
  ElchOracle(std::size_t n, const std::vector<WeightedEdge>& edges)
  : n_(n), edges_(edges.begin(), edges.end())
  {}

  std::vector<double>
  weights(std::size_t first, std::size_t last)
  {
    w_.assign(n_, -1);
    w_[first] = 0;
    w_[last] = 1;
    crossings_ = {first, last};
    while (closeShortestPath()) {}
    while (!crossings_.empty()) {
      const std::size_t v = *crossings_.begin();
      crossings_.erase(crossings_.begin());
      for (auto e = edges_.begin(); e != edges_.end();) {
        const auto edge = *e;
        if (edge.a != v && edge.b != v) {
          ++e;
          continue;
        }
        const std::size_t other = edge.a == v ? edge.b : edge.a;
        if (w_[other] < 0)
          w_[other] = w_[v];
        e = edges_.erase(e);
        if (degree(other) > 0)
          crossings_.insert(other);
      }
    }
    for (double& w : w_)
      w = w < 0 ? 0 : w;
    return w_;
  }

private:
  int
  degree(std::size_t v) const
  {
    int count = 0;
    for (const auto& edge : edges_)
      count += (edge.a == v) + (edge.b == v);
    return count;
  }

  /** Bellman and Ford, from one vertex. */
  void
  search(std::size_t from)
  {
    d_.assign(n_, std::numeric_limits<double>::infinity());
    before_.assign(n_, edges_.end());
    d_[from] = 0;
    for (bool again = true; again;) {
      again = false;
      for (auto e = edges_.begin(); e != edges_.end(); ++e)
        for (const auto& [a, b] : {std::pair(e->a, e->b), std::pair(e->b, e->a)})
          if (d_[a] + e->cost < d_[b]) {
            d_[b] = d_[a] + e->cost;
            before_[b] = e;
            again = true;
          }
    }
  }

  bool
  closeShortestPath()
  {
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t start = 0, end = 0;
    for (const std::size_t a : crossings_) {
      search(a);
      for (const std::size_t b : crossings_)
        if (a != b && d_[b] < shortest) {
          shortest = d_[b];
          start = a;
          end = b;
        }
    }
    if (shortest == std::numeric_limits<double>::infinity())
      return false;
    search(start);
    std::vector<std::list<WeightedEdge>::iterator> path;
    for (std::size_t v = end; v != start;) {
      const auto e = before_[v];
      path.push_back(e);
      if (v != end) {
        w_[v] = w_[start] + (w_[end] - w_[start]) * d_[v] / shortest;
        if (degree(v) > 2)
          crossings_.insert(v);
      }
      v = e->a == v ? e->b : e->a;
    }
    for (const auto& e : path)
      edges_.erase(e);
    for (auto v = crossings_.begin(); v != crossings_.end();)
      v = degree(*v) == 0 ? crossings_.erase(v) : std::next(v);
    return true;
  }

  std::size_t n_;
  std::list<WeightedEdge> edges_;
  std::set<std::size_t> crossings_;
  std::vector<double> w_, d_;
  std::vector<std::list<WeightedEdge>::iterator> before_;
};

} // namespace pcl6d::test
