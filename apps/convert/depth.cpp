// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/output/output_folder.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/io/text.h>
#include <pcl6d/scanner/camera_file.h>
#include <pcl6d/scanner/depth_image.h>
#include <pcl6d/scanner/image_files.h>
#include <pcl6d/scanner/measurement_principles.h>

#include <pcl/conversions.h>

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** fx,fy,cx,cy in one word. */
struct FourIntrinsics {
  std::array<double, 4> values{};
};

std::istream&
operator>>(std::istream& stream, FourIntrinsics& four)
{
  for (std::size_t i = 0; i < four.values.size(); ++i) {
    char comma = ',';
    if (i > 0)
      stream >> comma;
    if (!(stream >> four.values[i]) || comma != ',')
      stream.setstate(std::ios::failbit);
  }
  return stream;
}

std::ostream&
operator<<(std::ostream& stream, const FourIntrinsics& four)
{
  const auto& v = four.values;
  return stream << v[0] << ',' << v[1] << ',' << v[2] << ',' << v[3];
}

CameraIntrinsics
lensOf(const FourIntrinsics& four, int width, int height)
{
  CameraIntrinsics lens;
  lens.width = width;
  lens.height = height;
  lens.fx = four.values[0];
  lens.fy = four.values[1];
  lens.cx = four.values[2];
  lens.cy = four.values[3];
  return lens;
}

struct DepthSettings {
  std::string input, output;
  std::string camera; ///< file; empty: none
  std::optional<FourIntrinsics> intrinsics;
  std::string amplitudes; ///< folder; empty: none
  std::optional<DepthKind> kind;
  std::optional<double> unit, modulation, turn;
  DepthImageOptions image;
  bool quiet = false;
};

void
addImages(OptionTable& table, DepthSettings& s)
{
  table.positional("IMAGES", &s.input);
  table.group("Camera");
  table.add("camera FILE", &s.camera)
      .help("camera file of OpenCV (M1, D1), written by `calibrate`");
  table.add("intrinsics FX,FY,CX,CY", &s.intrinsics)
      .help("[px] of a camera without distortion, in place of a file");
  table.group("Values");
  table
      .add("kind",
           &s.kind,
           {{"axis", std::optional(DepthKind::kAlongAxis)},
            {"radial", std::optional(DepthKind::kRadial)}})
      .help("axis|radial: values are z (stereo, structured light), or distances from "
            "the camera (default: axis; radial for phases)");
  table.add("unit M", &s.unit)
      .above(0, "> 0 and finite", kFinite)
      .help("[m] of one step (default: 0.001 of 16 bits, 1 of floating point)");
  table.add("modulation HZ", &s.modulation)
      .above(0, "> 0 and finite", kFinite)
      .help("[Hz] values are the phases of a time-of-flight camera, repeating after c "
            "/ (2 HZ): 7.49 m at 2e7");
  table.add("turn VALUE", &s.turn)
      .above(0, "> 0 and finite", kFinite)
      .help("value of a whole turn of the phase (default: 65536 of 16 bits, 2 pi of "
            "floating point)");
}

void
addPixels(OptionTable& table, DepthSettings& s)
{
  table.group("Pixels");
  table.add("min-range", &s.image.min_depth).help("[m] smaller values are dropped");
  table.add("max-range", &s.image.max_depth).help("[m] larger values are dropped");
  table.add("max-jump", &s.image.max_jump)
      .help("[m] largest difference between neighbouring pixels; a pixel beyond is "
            "dropped");
  table.add("amplitudes DIR", &s.amplitudes)
      .help("images with the names of the depth images: intensity of the points, 8 or "
            "16 bits");
  table.add("min-amplitude", &s.image.min_amplitude).help("weaker pixels are dropped");
  table.group("Output");
  table.add("output,o OUT", &s.output)
      .required()
      .help("folder of PCD files; a PCD file for a single image");
  table.add("quiet", &s.quiet).help("print warnings and errors only");
}

/** Rules of several options, and of the library. \throws UsageError */
void
checkDepthOptions(DepthSettings& s)
{
  if (s.camera.empty() == !s.intrinsics)
    throw UsageError(s.camera.empty()
                         ? "the camera is not known: give --camera FILE, written by "
                           "`calibrate`, or --intrinsics FX,FY,CX,CY"
                         : "--camera and --intrinsics contradict each other");
  if (s.turn && !s.modulation)
    throw UsageError("--turn needs --modulation");
  if (s.unit && s.modulation)
    throw UsageError("--unit is of depths, --modulation of phases: give only --unit or "
                     "only --modulation");
  s.image.kind =
      s.kind.value_or(s.modulation ? DepthKind::kRadial : DepthKind::kAlongAxis);
  checkOptions(
      [&] {
        s.image.validate();
        if (s.intrinsics)
          lensOf(*s.intrinsics, 1, 1).validate();
      },
      {{"fx", "intrinsics fx"},
       {"fy", "intrinsics fy"},
       {"cx", "intrinsics cx"},
       {"cy", "intrinsics cy"},
       {"min_depth", "min-range"},
       {"max_depth", "max-range"},
       {"max_jump", "max-jump"},
       {"min_amplitude", "min-amplitude"}});
}

bool
parse(const std::vector<std::string>& arguments, DepthSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert +
                    R"( depth IMAGES -o OUT --camera FILE [options]
Makes scans of the depth images of a folder (or of one image): 16 bits or floating
point (PNG, TIFF, ...), or phases of a time-of-flight camera. The scans are organized
PCD files, a row per row of pixels, in the camera's place, x forward, y left, z up;
pcl_slam6d reads the folder.
)");
  addImages(table, s);
  addPixels(table, s);
  if (!table.parse(arguments))
    return false;
  checkDepthOptions(s);
  refuseInputs(s.output, {s.input, s.camera, s.amplitudes});
  return true;
}

std::string
sizeText(const cv::Mat& image)
{
  return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels";
}

/** \brief Converts images of one camera to scans. */
class DepthConversion {
public:
  explicit DepthConversion(const DepthSettings& settings) : s_(settings) {}

  /** \return how many points the scan has */
  std::size_t
  convert(const fs::path& file, const fs::path& scan)
  {
    const cv::Mat image = readDepthImage(file);
    const PinholeCamera& camera = cameraOf(image, file);
    const bool floats = image.depth() == CV_32F;
    DepthImageOptions options = s_.image;
    cv::Mat values = image;
    if (s_.modulation) {
      values = rangesOfPhases(
          image, s_.turn.value_or(floats ? 2 * M_PI : 65536), *s_.modulation);
      options.unit = 1;
    }
    else
      options.unit = s_.unit.value_or(floats ? 1 : 1e-3);
    cv::Mat amplitude;
    if (!s_.amplitudes.empty())
      amplitude = amplitudeOf(file, image);
    const auto cloud = depthImageToCloud(
        values, camera, options, amplitude.empty() ? nullptr : &amplitude);
    const auto count = std::count_if(
        cloud.begin(), cloud.end(), [](const auto& p) { return std::isfinite(p.x); });
    if (count == 0)
      throw ComputeFailed(file.string() + ": no pixel has a depth within " +
                          text::shortest(options.min_depth) + " to " +
                          text::shortest(options.max_depth) + " m");
    pcl::PCLPointCloud2 message;
    pcl::toPCLPointCloud2(cloud, message);
    writeScan(scan, message);
    return static_cast<std::size_t>(count);
  }

private:
  /** The camera, made from the first image. */
  const PinholeCamera&
  cameraOf(const cv::Mat& image, const fs::path& file)
  {
    if (!camera_) {
      camera_.emplace(intrinsicsFor(image));
      first_ = file;
    }
    const CameraIntrinsics& lens = camera_->intrinsics();
    if (image.cols != lens.width || image.rows != lens.height)
      throw IoFailed(file.string() + ": has " + sizeText(image) + ", but " +
                     first_.string() + " has " + std::to_string(lens.width) + " x " +
                     std::to_string(lens.height));
    return *camera_;
  }

  CameraIntrinsics
  intrinsicsFor(const cv::Mat& image) const
  {
    if (!s_.camera.empty())
      return readCamera(s_.camera, image.cols, image.rows);
    return lensOf(*s_.intrinsics, image.cols, image.rows);
  }

  /** The amplitude image of equal name, with any extension. */
  cv::Mat
  amplitudeOf(const fs::path& file, const cv::Mat& image)
  {
    if (amplitudes_.empty())
      amplitudes_ = imagesOf(s_.amplitudes);
    for (const auto& other : amplitudes_) {
      if (other.stem() != file.stem())
        continue;
      cv::Mat amplitude = readAmplitudeImage(other);
      if (amplitude.size() != image.size())
        throw IoFailed(other.string() + ": has " + sizeText(amplitude) + ", but " +
                       file.string() + " has " + sizeText(image));
      return amplitude;
    }
    throw IoFailed(s_.amplitudes + ": holds no image for " + file.string());
  }

  const DepthSettings& s_;
  std::optional<PinholeCamera> camera_;
  fs::path first_;
  std::vector<fs::path> amplitudes_;
};

int
convertDepthFolder(const DepthSettings& s)
{
  const std::vector<fs::path> images = imagesOf(s.input);
  OutputRules rules;
  rules.folder = s.output;
  rules.inputs = {s.input, s.camera, s.amplitudes};
  rules.program = kConvert;
  OutputFolder out(rules);
  const Interrupt interrupt;
  ProgressBar bar(s.quiet);
  DepthConversion conversion(s);
  std::set<std::string> names;
  std::size_t points = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (interrupt.requested())
      return kInterrupted;
    const std::string name = images[i].stem().string() + ".pcd";
    if (!names.insert(name).second)
      throw IoFailed(images[i].string() +
                     ": another image has an equal name except for the extension");
    points += conversion.convert(images[i], out / name);
    bar.show({"converting", i + 1, images.size()});
  }
  out.publish();
  std::printf("%s, %s\n",
              text::counted(images.size(), "scan").c_str(),
              text::counted(points, "point").c_str());
  return kDone;
}
} // namespace

int
runDepth(const std::vector<std::string>& arguments)
{
  DepthSettings s;
  if (!parse(arguments, s))
    return kDone;
  int code = kDone;
  if (fs::is_directory(s.input))
    code = convertDepthFolder(s);
  else
    std::printf(
        "%s\n",
        text::counted(DepthConversion(s).convert(s.input, s.output), "point").c_str());
  if (s.modulation)
    std::printf("ranges repeat after %.4g m\n", ambiguityInterval(*s.modulation));
  flushOutput();
  return code;
}

} // namespace pcl6d::app
