// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/graph_relaxation/block_system.h>
