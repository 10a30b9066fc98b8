// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/io/bag_options.h>

namespace pcl6d {

namespace {
constexpr Named<BagTime> kBagTimes[] = {{BagTime::kAuto, "auto"},
                                        {BagTime::kHeader, "header"},
                                        {BagTime::kRecord, "record"}};
} // namespace

BagTime
bagTimeFromName(const std::string& name)
{
  return fromName(kBagTimes, "time", name, WordList::kOr);
}

std::string
toString(BagTime time)
{
  return nameOf(kBagTimes, time);
}

} // namespace pcl6d
