// SPDX-License-Identifier: BSD-3-Clause
#include "support/pcl_estimation_peers.h"

PCL6D_TEST_ESTIMATION_PEERS_OF_POINT_(PCL6D_TEST_ESTIMATION_HERE_, pcl::PointXYZ, float)
PCL6D_TEST_ESTIMATION_PEERS_OF_POINT_(PCL6D_TEST_ESTIMATION_HERE_,
                                      pcl::PointNormal,
                                      float)
PCL6D_TEST_ESTIMATION_PEERS_OF_PLANES_(PCL6D_TEST_ESTIMATION_HERE_,
                                       pcl::PointNormal,
                                       float)
