// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/image.h>

#include <filesystem>
#include <memory>
#include <string>

namespace pcl6d::app {

/** \brief A video written frame by frame, with the first codec of OpenCV for the
 * extension of its name. */
class VideoFile {
public:
  /** \param[in] name of the file in messages
   * \throws IoFailed no codec, or the file cannot be written */
  VideoFile(const std::filesystem::path& path,
            const std::string& name,
            int width,
            int height,
            double fps);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile&
  operator=(const VideoFile&) = delete;

  void
  add(const Image& image);

  /** \brief Ends the file. \throws IoFailed frames are missing in the file: the disk
   * may be full */
  void
  close();

private:
  struct Writer;
  std::filesystem::path path_;
  std::string name_;
  std::unique_ptr<Writer> writer_;
};

} // namespace pcl6d::app
