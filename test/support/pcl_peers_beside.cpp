// SPDX-License-Identifier: BSD-3-Clause
#include "support/pcl_peers.h"

PCL6D_TEST_PCL_PEERS_BESIDE_(PCL6D_TEST_COMPILED_HERE_)
