// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module scanner. Measurement principles, models of scanners
 * and cameras, calibration, stereo, range images. */
#include <pcl6d/scanner/calibrate_stereo.h>
#include <pcl6d/scanner/camera_calibration.h>
#include <pcl6d/scanner/camera_file.h>
#include <pcl6d/scanner/camera_scanner.h>
#include <pcl6d/scanner/depth_image.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/driven_scanner_projection.h>
#include <pcl6d/scanner/gray_image.h>
#include <pcl6d/scanner/image_files.h>
#include <pcl6d/scanner/light_source.h>
#include <pcl6d/scanner/line_assembly.h>
#include <pcl6d/scanner/measurement_principles.h>
#include <pcl6d/scanner/pinhole_camera.h>
#include <pcl6d/scanner/projection_scanner.h>
#include <pcl6d/scanner/range_error_model.h>
#include <pcl6d/scanner/range_image.h>
#include <pcl6d/scanner/range_projection.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/scanner/ray.h>
#include <pcl6d/scanner/rosette_lidar.h>
#include <pcl6d/scanner/scanner_model.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/scanner/spinning_lidar.h>
#include <pcl6d/scanner/stereo_calibration_file.h>
#include <pcl6d/scanner/stereo_cloud.h>
#include <pcl6d/scanner/stereo_matching.h>
#include <pcl6d/scanner/stereo_rectification.h>
#include <pcl6d/scanner/tof_camera.h>
