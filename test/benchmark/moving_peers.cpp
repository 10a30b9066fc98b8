// SPDX-License-Identifier: BSD-3-Clause
#include "moving_peers.h"
#include "range_image_peer.h"
#include "voxel_count_peer.h"

namespace pcl6d::bench {

std::vector<MovingPeer>
movingPeers()
{
  return {{"voxels", countVoxels},
          {"images", removeAndRevert},
          {"removed", removeByImages}};
}

} // namespace pcl6d::bench
