// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/haar_cascade.h>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes a cascade in the format of cv::CascadeClassifier of OpenCV 4 (XML,
 * type opencv-cascade-classifier, features HAAR), whole or not at all. The subject goes
 * into an element `pcl6d`, ignored by OpenCV.
 * \throws BadArgument see HaarCascade::validate() \throws IoFailed the file cannot be
 * written \ingroup object_localization */
void
writeCascade(const std::filesystem::path& path, const HaarCascade& cascade);

/** \brief Reads a cascade file of OpenCV 4, also one trained elsewhere; numbers are
 * kept to the last bit.
 * \throws IoFailed naming file and rule: missing, not XML (with the line), another kind
 * of cascade (LBP, or the format of OpenCV 1), or HaarCascade::validate() */
HaarCascade
readCascade(const std::filesystem::path& path);

} // namespace pcl6d
