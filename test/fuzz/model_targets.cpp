// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/scanner/camera_file.h>
#include <pcl6d/scanner/stereo_calibration_file.h>

namespace pcl6d::fuzz {

int
cascade(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(
      ".xml", data, size, [](const auto& file) { readCascade(file).validate(); });
}

int
camera(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(
      ".yml", data, size, [](const auto& file) { readCamera(file).validate(); });
}

int
stereo_calibration(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".yml", data, size, [](const auto& file) {
    StereoCalibrationSource source;
    source.intrinsics = file;
    readStereoCalibration(source, 640, 480).validate();
  });
}

} // namespace pcl6d::fuzz
