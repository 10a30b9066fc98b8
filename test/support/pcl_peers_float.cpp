// SPDX-License-Identifier: BSD-3-Clause
#include "support/pcl_peers.h"

PCL6D_TEST_PCL_PEERS_OF_SCALAR_(PCL6D_TEST_COMPILED_HERE_, float)
