// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/status.h>

#include <cstdio>

int
main()
{
  std::puts(pcl6d::toString(pcl6d::Status::kOk));
}
