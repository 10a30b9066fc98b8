// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/printable.h"
#include "convert/loss_tally.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <iostream>

namespace pcl6d::app {

void
LossTally::addScan(const std::string& name,
                   const ScanCloud& scan,
                   const std::vector<std::string>& losses)
{
  ++scans_;
  if (scan.cloud.data.empty())
    empty_scans_.push_back(name);
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
              << " with an x, y or z that is not finite\n";
  for (const auto& [loss, count] : of_scans_) {
    std::cout << printable(loss); // may contain names of fields
    if (scans_ > 1)
      std::cout << " (" << count << " of " << text::counted(scans_, "scan") << ')';
    std::cout << '\n';
  }
  for (const auto& loss : others_)
    std::cout << printable(loss) << '\n';
}

int
LossTally::evaluate(ProgressBar& bar) const
{
  if (empty_scans_.empty())
    return kDone;
  const std::size_t others = empty_scans_.size() - 1;
  bar.warn(empty_scans_.front() +
           (others == 0
                ? " has no points"
                : " and " + text::counted(others, "other scan") + " have no points"));
  return kDoubtful;
}

} // namespace pcl6d::app
