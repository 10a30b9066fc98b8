// SPDX-License-Identifier: BSD-3-Clause
#include "render/video_file.h"

#include <pcl6d/common/error.h>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sys/resource.h>
#include <vector>

namespace pcl6d::app {

namespace fs = std::filesystem;

namespace {
/** The codecs for a file type, the most widely playable first. */
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

/** \return the number of frames stored in a film, counted without decoding */
std::size_t
framesIn(const fs::path& path)
{
  constexpr double kAsTheyAre = -1;
  cv::VideoCapture film(path.string());
  if (!film.isOpened())
    return 0;
  film.set(cv::CAP_PROP_FORMAT, kAsTheyAre);
  std::size_t frames = 0;
  while (film.grab())
    ++frames;
  return frames;
}

/** \return whether a file can grow no more, for lack of space or by a limit: its end
 * may then be missing */
bool
isFull(const fs::path& path)
{
  std::error_code error;
  const auto size = fs::file_size(path, error);
  rlimit limit{};
  const bool has_limit =
      ::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return error || fs::space(path, error).available == 0 || error ||
         (has_limit && size >= limit.rlim_cur);
}
} // namespace

struct VideoFile::Writer {
  cv::VideoWriter video;
  std::size_t frames = 0;
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
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0); // quiet: errors are reported below
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  for (const auto& codec : codecsFor(fs::path(name).extension()))
    if (writer_->video.open(
            path.string(),
            cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]),
            fps,
            cv::Size(width, height)))
      return;
  throw IoFailed(name + ": this OpenCV has no codec for " +
                 fs::path(name).extension().string());
}

VideoFile::~VideoFile() = default;

void
VideoFile::add(const Image& image)
{
  const cv::Mat rgb(
      image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  writer_->video.write(bgr); // does not report a full disk
  ++writer_->frames;
}

void
VideoFile::close()
{
  writer_->video.release();
  const std::size_t written = framesIn(path_);
  if (written < writer_->frames)
    throw IoFailed(name_ + ": cannot be written: holds " + std::to_string(written) +
                   " of " + std::to_string(writer_->frames) +
                   " frames; the disk may be full");
  if (isFull(path_))
    throw IoFailed(name_ + ": cannot be written: the disk is full");
}

} // namespace pcl6d::app
