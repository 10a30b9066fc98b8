// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/calibration_file.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/scanner/camera_file.h>

#include <vector>

namespace pcl6d {
using namespace scanner;

namespace {
/** Names of the entries of a camera. */
struct CameraEntries {
  const char* matrix;
  const char* distortion;
};
constexpr CameraEntries kOwnEntries = {"M1", "D1"};
constexpr CameraEntries kSampleEntries = {"camera_matrix", "distortion_coefficients"};

CameraEntries
entriesOf(const CalibrationFile& file)
{
  const CameraEntries entries =
      file.has(kSampleEntries.matrix) ? kSampleEntries : kOwnEntries;
  file.requireEntries({entries.matrix, entries.distortion});
  return entries;
}

/** A file of OpenCV in the making. */
class CalibrationText {
public:
  explicit CalibrationText(const std::filesystem::path& path)
  {
    const std::string extension = path.extension().string();
    if (extension != ".yml" && extension != ".yaml" && extension != ".xml" &&
        extension != ".json")
      throw IoFailed(path.string() +
                     ": a camera file ends with .yml, .yaml, .xml or .json");
    storage_.open(extension, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  }

  void
  add(const std::string& name, int value)
  {
    storage_ << name << value;
  }

  void
  add(const std::string& name, int rows, std::vector<double> values)
  {
    storage_ << name << cv::Mat(values, true).reshape(1, rows);
  }

  /** \param[in] number of the camera: "1" */
  void
  add(const std::string& number, const CameraIntrinsics& lens)
  {
    add("M" + number, 3, {lens.fx, lens.skew, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1});
    std::vector<double> d = {lens.k[0], lens.k[1], lens.p[0], lens.p[1], lens.k[2]};
    if (lens.k[3] != 0 || lens.k[4] != 0 || lens.k[5] != 0)
      d.insert(d.end(), lens.k.begin() + 3, lens.k.end());
    add("D" + number, 1, d);
  }

  void
  write(const std::filesystem::path& path)
  {
    const std::string text = storage_.releaseAndGetString();
    writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
  }

private:
  cv::FileStorage storage_;
};
} // namespace

CameraIntrinsics
readCamera(const std::filesystem::path& path)
{
  const CalibrationFile file(path);
  const CameraEntries entries = entriesOf(file);
  return file.camera(entries.matrix,
                     entries.distortion,
                     file.size("image_width"),
                     file.size("image_height"));
}

CameraIntrinsics
readCamera(const std::filesystem::path& path, int width, int height)
{
  const CalibrationFile file(path);
  const CameraEntries entries = entriesOf(file);
  file.requireSize("image_width", width);
  file.requireSize("image_height", height);
  return file.camera(entries.matrix, entries.distortion, width, height);
}

void
writeCamera(const std::filesystem::path& path, const CameraIntrinsics& camera)
{
  camera.validate();
  CalibrationText text(path);
  text.add("image_width", camera.width);
  text.add("image_height", camera.height);
  text.add("1", camera);
  text.write(path);
}

void
writeStereoCalibration(const std::filesystem::path& path,
                       const StereoCalibration& calibration)
{
  calibration.validate();
  CalibrationText text(path);
  text.add("image_width", calibration.left.width);
  text.add("image_height", calibration.left.height);
  text.add("1", calibration.left);
  text.add("2", calibration.right);
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R =
      calibration.T_right_left.linear();
  const Eigen::Vector3d t = calibration.T_right_left.translation();
  text.add("R", 3, {R.data(), R.data() + 9});
  text.add("T", 3, {t.data(), t.data() + 3});
  text.write(path);
}

} // namespace pcl6d
