// SPDX-License-Identifier: BSD-3-Clause
#include "render/video_file.h"

#include <pcl6d/common/error.h>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <fstream>
#include <map>
#include <vector>

namespace pcl6d::app {

namespace fs = std::filesystem;

namespace {
/** The codecs of a kind of file, those that play nearly everywhere first. */
const std::vector<std::string>&
codecsFor(const std::string& extension)
{
  static const std::map<std::string, std::vector<std::string>> kCodecs = {
      {".avi", {"MJPG", "XVID"}},
      {".mkv", {"X264", "mp4v", "MJPG"}},
      {".mp4", {"avc1", "mp4v"}},
      {".webm", {"VP80", "VP90"}}};
  return kCodecs.at(extension);
}
} // namespace

struct VideoFile::Writer {
  cv::VideoWriter video;
};

VideoFile::VideoFile(const fs::path& path,
                     const std::string& name,
                     int width,
                     int height,
                     double fps)
: path_(path), name_(name), writer_(std::make_unique<Writer>())
{
  if (!std::ofstream(path))
    throw IoFailed(name + ": cannot be written");
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  for (const auto& codec : codecsFor(path.extension()))
    if (writer_->video.open(
            path.string(),
            cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]),
            fps,
            cv::Size(width, height)))
      return;
  throw IoFailed(name + ": this OpenCV has no codec for " + path.extension().string());
}

VideoFile::~VideoFile() = default;

void
VideoFile::add(const Image& image)
{
  const cv::Mat rgb(
      image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  writer_->video.write(bgr);
}

void
VideoFile::close()
{
  writer_->video.release();
  std::error_code error;
  if (fs::file_size(path_, error) == 0 || error)
    throw IoFailed(name_ + ": cannot be written");
}

} // namespace pcl6d::app
