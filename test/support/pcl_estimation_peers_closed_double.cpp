// SPDX-License-Identifier: BSD-3-Clause
#include "support/pcl_estimation_peers.h"

PCL6D_TEST_PEERS_CLOSED_DOUBLE_(PCL6D_TEST_ESTIMATION_HERE_)
