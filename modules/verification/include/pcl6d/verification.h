// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module verification but its PCL classes, in
 * pcl6d/verification/pcl. Tests of links between scans and of whole maps: evidence, covariance,
 * ambiguous poses, verdict. */
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/map_verifier.h>
#include <pcl6d/verification/pair_verifier.h>
#include <pcl6d/verification/prepared_scans.h>
#include <pcl6d/verification/surface_fit.h>
#include <pcl6d/verification/verified_scan.h>
