// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/measurement_principles.h>
#include <pcl6d/scanner/tof_camera.h>

#include <cmath>

namespace pcl6d {
namespace {
constexpr double kNoPixel = std::numeric_limits<double>::quiet_NaN();

// Whether a pixel is apart from both neighbours at (+-rows, +-cols).
bool
isApart(const RangeScan& scan, int row, int col, int rows, int cols, double max_jump)
{
  for (const int side : {-1, 1}) {
    const int r = row + side * rows;
    const int c = col + side * cols;
    if (r < 0 || r >= scan.num_lines || c < 0 || c >= scan.samples_per_line)
      return false;
    // A neighbour without return is no second surface.
    if (!(std::abs(scan.at(r, c).range - scan.at(row, col).range) > max_jump))
      return false;
  }
  return true;
}

bool
isFlying(const RangeScan& scan, int row, int col, double max_jump)
{
  return isApart(scan, row, col, 0, 1, max_jump) ||
         isApart(scan, row, col, 1, 0, max_jump);
}
} // namespace

void
TofGate::validate() const
{
  require(min_amplitude >= 0, "min_amplitude", min_amplitude, ">= 0");
  require(max_offset > 0, "max_offset", max_offset, "> 0");
  require(max_jump > 0, "max_jump", max_jump, "> 0");
}

TofCamera::TofCamera(const CameraIntrinsics& camera,
                     double modulation,
                     double frame_period)
: CameraScanner(camera, frame_period), modulation_(modulation)
{
  require(modulation > 0 && std::isfinite(modulation),
          "modulation",
          modulation,
          "> 0 and finite");
}

double
TofCamera::ambiguityInterval() const
{
  return pcl6d::ambiguityInterval(modulation_);
}

RangeScan
TofCamera::rangeScan(const std::array<std::vector<double>, 4>& images,
                     const TofGate& gate) const
{
  gate.validate();
  RangeScan scan{numLines(), samplesPerLine(), {}};
  scan.samples.resize(static_cast<std::size_t>(scan.num_lines) *
                      static_cast<std::size_t>(scan.samples_per_line));
  for (const auto& image : images)
    require(image.size() == scan.samples.size(),
            "pixels of an image",
            image.size(),
            std::to_string(scan.samples.size()));
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    const WaveSamples wave =
        waveFromFourSamples({images[0][i], images[1][i], images[2][i], images[3][i]});
    const bool is_good =
        wave.amplitude >= gate.min_amplitude && wave.offset <= gate.max_offset;
    scan.samples[i].range =
        is_good ? rangeFromPhase(wave.phase, modulation_) : kNoPixel;
    scan.samples[i].intensity = wave.amplitude;
  }
  if (std::isfinite(gate.max_jump))
    dropFlyingPixels(scan, gate.max_jump);
  return scan;
}

std::size_t
dropFlyingPixels(RangeScan& scan, double max_jump)
{
  require(max_jump > 0, "max_jump", max_jump, "> 0");
  std::vector<std::size_t> flying;
  std::size_t index = 0;
  for (int row = 0; row < scan.num_lines; ++row)
    for (int col = 0; col < scan.samples_per_line; ++col, ++index)
      if (isFlying(scan, row, col, max_jump))
        flying.push_back(index);
  for (const std::size_t pixel : flying)
    scan.samples[pixel].range = kNoPixel;
  return flying.size();
}

} // namespace pcl6d
