// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/pinhole_camera.h>
#include <pcl6d/scanner/stereo_rectification.h>

#include <filesystem>

/** \file Cameras in files of OpenCV: YAML, XML or JSON, chosen by the extension in
 * writing (.yml, .yaml, .xml, .json). Entries: image_width, image_height [px]; M1, D1,
 * the 3x3 camera matrix and the distortion k1 k2 p1 p2 k3 (k4 k5 k6); for two cameras
 * also M2, D2 and R, T with X2 = R X1 + T [m], read by readStereoCalibration(). */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads the (first) camera of a file; M1 may be called camera_matrix and D1
 * distortion_coefficients, as in OpenCV's sample `calibration`.
 * \throws IoFailed the file cannot be read, or an entry is missing, of another size,
 * not finite or invalid; the message names file and entry \ingroup scanner */
CameraIntrinsics
readCamera(const std::filesystem::path& path);

/** \brief As above, for pictures of a known size; the size in the file is optional.
 * \throws IoFailed also if the file has another size */
CameraIntrinsics
readCamera(const std::filesystem::path& path, int width, int height);

/** \brief Writes a camera atomically with full precision; without D1's k4 k5 k6 if
 * zero. \throws IoFailed the file cannot be written, or has another extension
 * \throws BadArgument see CameraIntrinsics::validate() \ingroup scanner */
void
writeCamera(const std::filesystem::path& path, const CameraIntrinsics& camera);

/** \brief Writes two cameras of one size. \throws IoFailed as writeCamera()
 * \throws BadArgument see StereoCalibration::validate() \ingroup scanner */
void
writeStereoCalibration(const std::filesystem::path& path,
                       const StereoCalibration& calibration);

} // namespace pcl6d
