// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/natural_order.h>
#include <pcl6d/io/text.h>
#include <pcl6d/scanner/image_files.h>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <mutex>
#include <vector>

namespace pcl6d {
namespace {
[[noreturn]] void
fail(const std::filesystem::path& path, const std::string& message)
{
  throw IoFailed(path.string() + ": " + message);
}

/** \brief Keeps OpenCV's messages off std::cerr: its decoders print errors that are
 * thrown as exceptions as well. One instance at a time, as std::cerr is global. */
class QuietErrors {
public:
  QuietErrors() : alone_(mutex()), before_(std::cerr.rdbuf(nullptr)) {}
  ~QuietErrors()
  {
    std::cerr.rdbuf(before_);
    std::cerr.clear(); // writing without a buffer has set its bad bit
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors&
  operator=(const QuietErrors&) = delete;

private:
  static std::mutex&
  mutex()
  {
    static std::mutex one;
    return one;
  }

  const std::lock_guard<std::mutex> alone_;
  std::streambuf* const before_;
};

/** \brief Decodes from memory, as imread() gives no reason for a failure and prints
 * warnings. */
cv::Mat
readImage(const std::filesystem::path& path, int flags)
{
  constexpr std::size_t kMostPixels = 100000000;
  const std::string content = text::readFile(path);
  const std::vector<char> bytes(content.begin(), content.end());
  cv::Mat image;
  try {
    const QuietErrors quiet;
    if (!bytes.empty())
      image = cv::imdecode(bytes, flags);
  } catch (const cv::Exception& e) {
    fail(path, "is no image readable by OpenCV: " + e.err);
  }
  if (image.empty())
    fail(path, "is no image that OpenCV can read");
  if (image.total() > kMostPixels)
    fail(path,
         "has " + std::to_string(image.cols) + " x " + std::to_string(image.rows) +
             " pixels, but must have at most 1e8");
  return image;
}

[[noreturn]] void
failKind(const std::filesystem::path& path,
         const cv::Mat& image,
         const std::string& wanted)
{
  fail(path,
       "has " + std::to_string(image.channels()) + " channels of " +
           std::to_string(8 * image.elemSize1()) + " bits, but " + wanted);
}

bool
isImageName(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  for (char& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* const known :
       {".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp", ".pgm", ".webp"})
    if (extension == known)
      return true;
  return false;
}
} // namespace

cv::Mat
readGrayImage(const std::filesystem::path& path)
{
  return readImage(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
}

cv::Mat
readDepthImage(const std::filesystem::path& path)
{
  cv::Mat image = readImage(path, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_16UC1 && image.type() != CV_32FC1)
    failKind(
        path, image, "a depth image has 1 of 16 bits, or of 32 bits floating point");
  return image;
}

cv::Mat
readAmplitudeImage(const std::filesystem::path& path)
{
  cv::Mat image = readImage(path, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_8UC1 && image.type() != CV_16UC1)
    failKind(path, image, "an amplitude image has 1 of 8 or 16 bits");
  return image;
}

std::vector<std::filesystem::path>
imagesOf(const std::filesystem::path& folder)
{
  std::vector<std::filesystem::path> images;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code none; // a link to nothing
    if (!isImageName(it->path()) || it->is_directory(none))
      continue;
    if (!it->is_regular_file(none))
      fail(it->path(), "is no file, or a broken link");
    images.push_back(it->path());
  }
  if (error)
    fail(folder, "cannot be read: " + error.message());
  if (images.empty())
    fail(folder, "holds no picture (.png .tif .tiff .jpg .jpeg .bmp .pgm .webp)");
  std::sort(images.begin(), images.end(), [](const auto& a, const auto& b) {
    return naturalLess(a.filename().string(), b.filename().string());
  });
  return images;
}

void
writePng(const std::filesystem::path& path, const cv::Mat& image)
{
  const int type = image.type();
  if (image.empty() || (type != CV_8UC1 && type != CV_16UC1 && type != CV_8UC3))
    throw BadArgument("image is empty or of type " + std::to_string(type) +
                      ", but must be CV_8UC1, CV_16UC1 or CV_8UC3");
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
  });
}

} // namespace pcl6d
