// SPDX-License-Identifier: BSD-3-Clause
#include "convert/loss_tally.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <iostream>

namespace pcl6d::app {

void
LossTally::addScan(const ScanCloud& scan, const std::vector<std::string>& losses)
{
  ++scans_;
  dropped_points_ += scan.dropped;
  for (const auto& thing : scan.left_out)
    count("did not read " + thing);
  for (const auto& loss : losses)
    count(loss);
}

void
LossTally::count(const std::string& loss)
{
  const auto known = std::find_if(of_scans_.begin(),
                                  of_scans_.end(),
                                  [&](const auto& l) { return l.first == loss; });
  if (known == of_scans_.end())
    of_scans_.emplace_back(loss, 1);
  else
    ++known->second;
}

void
LossTally::add(const std::string& loss)
{
  others_.push_back(loss);
}

void
LossTally::print() const
{
  if (dropped_points_ > 0)
    std::cout << "dropped " << text::counted(dropped_points_, "point")
              << " whose x, y or z is not finite\n";
  for (const auto& [loss, count] : of_scans_) {
    std::cout << loss;
    if (scans_ > 1)
      std::cout << " (" << count << " of " << text::counted(scans_, "scan") << ')';
    std::cout << '\n';
  }
  for (const auto& loss : others_)
    std::cout << loss << '\n';
}

} // namespace pcl6d::app
