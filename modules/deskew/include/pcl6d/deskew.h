// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module deskew. Motion of the scanner within a scan: corrected
 * along known poses, or estimated from the points. */
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_options.h>
