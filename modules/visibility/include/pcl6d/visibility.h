// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module visibility. Free space along the rays of a scan: seen,
 * empty and hidden space. */
#include <pcl6d/visibility/cube_faces.h>
#include <pcl6d/visibility/range_noise.h>
#include <pcl6d/visibility/ray_image.h>
#include <pcl6d/visibility/sight_evidence.h>
