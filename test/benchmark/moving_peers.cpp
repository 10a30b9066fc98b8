// SPDX-License-Identifier: BSD-3-Clause
#include "moving_peers.h"

namespace pcl6d::bench {

std::vector<MovingPeer>
movingPeers()
{
  return {};
}

} // namespace pcl6d::bench
