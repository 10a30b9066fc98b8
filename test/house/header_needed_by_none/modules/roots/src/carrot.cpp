// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/fruit/core.h>
#include <pcl6d/fruit/plum.h>
