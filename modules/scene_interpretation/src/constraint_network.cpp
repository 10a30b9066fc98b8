// SPDX-License-Identifier: BSD-3-Clause
#include "constraint_network.h"

#include <pcl6d/common/components.h>

#include <algorithm>
#include <map>

namespace pcl6d::scene_interpretation {
namespace {
constexpr std::size_t kNone = NetworkSolution::kNone;

/* Depth-first branch and bound over the variables of one component. A value in conflict
 * with a chosen value is blocked; a variable without open values adds nothing. Branches
 * that cannot beat the best solution are skipped. */
class Search {
public:
  Search(const ConstraintNetwork& network,
         const std::vector<std::vector<std::size_t>>& domains,
         std::vector<std::size_t> order,
         NetworkSolution& solution,
         std::size_t node_limit)
  : network_(network)
  , domains_(domains)
  , order_(std::move(order))
  , solution_(solution)
  , node_limit_(node_limit)
  , blocked_(network.values.size(), 0)
  , open_(network.worth.size(), 0)
  , chosen_(network.worth.size(), kNone)
  , is_decided_(network.worth.size(), false)
  {
    for (const auto variable : order_) {
      open_[variable] = domains_[variable].size();
      if (open_[variable] > 0)
        reachable_ += network_.worth[variable];
    }
  }

  void
  run()
  {
    descend(0);
    for (const auto variable : order_)
      solution_.chosen[variable] =
          best_choice_.empty() ? kNone : best_choice_[variable];
    solution_.worth += std::max<std::int64_t>(best_, 0);
  }

private:
  void
  descend(std::size_t depth)
  {
    if (worth_ + reachable_ <= best_ || !solution_.is_complete)
      return;
    if (depth == order_.size()) {
      best_ = worth_;
      best_choice_ = chosen_;
      return;
    }
    const std::size_t variable = order_[depth];
    is_decided_[variable] = true;
    if (open_[variable] > 0)
      reachable_ -= network_.worth[variable];
    for (const auto value : domains_[variable])
      if (blocked_[value] == 0)
        tryValue(depth, variable, value);
    if (enter() && needsCanBeMet())
      descend(depth + 1);
    if (open_[variable] > 0)
      reachable_ += network_.worth[variable];
    is_decided_[variable] = false;
  }

  void
  tryValue(std::size_t depth, std::size_t variable, std::size_t value)
  {
    if (!enter())
      return;
    chosen_[variable] = value;
    worth_ += network_.worth[variable];
    for (const auto other : network_.values[value].conflicts)
      block(other);
    const bool has_needs = !network_.values[value].needs.empty();
    if (has_needs)
      needy_.push_back(value);
    if (needsCanBeMet())
      descend(depth + 1);
    if (has_needs)
      needy_.pop_back();
    for (const auto other : network_.values[value].conflicts)
      unblock(other);
    worth_ -= network_.worth[variable];
    chosen_[variable] = kNone;
  }

  bool
  enter()
  {
    if (solution_.nodes >= node_limit_)
      solution_.is_complete = false;
    else
      ++solution_.nodes;
    return solution_.is_complete;
  }

  void
  block(std::size_t value)
  {
    const std::size_t variable = network_.values[value].variable;
    if (blocked_[value]++ == 0 && --open_[variable] == 0 && !is_decided_[variable])
      reachable_ -= network_.worth[variable];
  }

  void
  unblock(std::size_t value)
  {
    const std::size_t variable = network_.values[value].variable;
    if (--blocked_[value] == 0 && open_[variable]++ == 0 && !is_decided_[variable])
      reachable_ += network_.worth[variable];
  }

  bool
  needsCanBeMet() const
  {
    const auto supports = [&](std::size_t value) {
      const std::size_t variable = network_.values[value].variable;
      return is_decided_[variable] ? chosen_[variable] == value : blocked_[value] == 0;
    };
    return std::all_of(needy_.begin(), needy_.end(), [&](std::size_t value) {
      const auto& needs = network_.values[value].needs;
      return std::all_of(needs.begin(), needs.end(), [&](const auto& need) {
        return std::any_of(need.begin(), need.end(), supports);
      });
    });
  }

  const ConstraintNetwork& network_;
  const std::vector<std::vector<std::size_t>>& domains_;
  std::vector<std::size_t> order_;
  NetworkSolution& solution_;
  std::size_t node_limit_;
  std::vector<int> blocked_; // per value: number of chosen values in conflict with it
  std::vector<std::size_t> open_; // per variable: number of values that are not blocked
  std::vector<std::size_t> chosen_;
  std::vector<bool> is_decided_;
  std::vector<std::size_t> needy_; // chosen values with needs
  std::vector<std::size_t> best_choice_;
  std::int64_t worth_ = 0;
  std::int64_t reachable_ = 0; // worth of the undecided variables with open values
  std::int64_t best_ = -1;
};

// Arc consistency. "none" is compatible with every value, so conflicts rule out no
// value before others are chosen; a need without a supporting value does.
std::vector<bool>
supportedValues(const ConstraintNetwork& network)
{
  std::vector<bool> is_supported(network.values.size(), true);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t value = 0; value < network.values.size(); ++value)
      for (const auto& need : network.values[value].needs) {
        const bool is_met =
            std::any_of(need.begin(), need.end(), [&](std::size_t other) {
              return is_supported[other];
            });
        if (is_met || !is_supported[value])
          continue;
        is_supported[value] = false;
        changed = true;
      }
  }
  return is_supported;
}

// Groups of variables that can influence each other, each by falling worth.
std::vector<std::vector<std::size_t>>
componentOrders(const ConstraintNetwork& network, const std::vector<bool>& is_supported)
{
  Components components(network.worth.size());
  const auto join = [&](const NetworkValue& value, std::size_t other) {
    if (is_supported[other])
      components.join(value.variable, network.values[other].variable);
  };
  for (std::size_t i = 0; i < network.values.size(); ++i) {
    const NetworkValue& value = network.values[i];
    if (!is_supported[i])
      continue;
    for (const auto other : value.conflicts)
      join(value, other);
    for (const auto& need : value.needs)
      for (const auto other : need)
        join(value, other);
  }
  std::map<std::size_t, std::vector<std::size_t>> orders;
  for (std::size_t variable = 0; variable < network.worth.size(); ++variable)
    orders[components.firstOf(variable)].push_back(variable);
  std::vector<std::vector<std::size_t>> result;
  for (auto& [first, order] : orders) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return network.worth[a] > network.worth[b];
    });
    result.push_back(std::move(order));
  }
  return result;
}
} // namespace

NetworkSolution
solve(const ConstraintNetwork& network, std::size_t node_limit)
{
  const std::vector<bool> is_supported = supportedValues(network);
  std::vector<std::vector<std::size_t>> domains(network.worth.size());
  for (std::size_t i = 0; i < network.values.size(); ++i)
    if (is_supported[i])
      domains[network.values[i].variable].push_back(i);
  NetworkSolution solution;
  solution.chosen.assign(network.worth.size(), kNone);
  bool is_complete = true;
  const auto orders = componentOrders(network, is_supported);
  for (std::size_t c = 0; c < orders.size(); ++c) {
    // Limit of a component: an even share of the remaining nodes.
    const std::size_t left = node_limit - std::min(solution.nodes, node_limit);
    const std::size_t share = solution.nodes + left / (orders.size() - c);
    Search(network, domains, orders[c], solution, share).run();
    is_complete = is_complete && solution.is_complete;
    solution.is_complete = true;
  }
  solution.is_complete = is_complete;
  return solution;
}

} // namespace pcl6d::scene_interpretation
