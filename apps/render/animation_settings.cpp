// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "render/animation_settings.h"
#include "render/verbs.h"

#include <pcl6d/common/require.h>

#include <filesystem>
#include <set>
#include <sstream>

namespace pcl6d::app {

namespace {
constexpr const char* kUsageText =
    R"( animation RUN --kind KIND -o OUT [options]
Shows a run of pcl_slam6d as a film. OUT is a folder for a PNG file per frame
and a video, if OpenCV has a codec, or one video file (.mp4, .avi,
.mkv, .webm). Growth and relaxation need the run's scans/ and frames/.
)";

/** A size in pixels, "1280x720". */
struct PixelSize {
  int width;
  int height;
};

std::istream&
operator>>(std::istream& stream, PixelSize& size)
{
  char cross = 0;
  if (stream >> size.width >> cross >> size.height && cross != 'x')
    stream.setstate(std::ios::failbit);
  return stream;
}

std::ostream&
operator<<(std::ostream& stream, const PixelSize& size)
{
  return stream << size.width << 'x' << size.height;
}

/** Rules of both sides. */
void
checkSize(const PixelSize& size)
{
  for (const int side : {size.width, size.height})
    require(side >= 200 && side <= 8192, "size", side, "200 to 8192 pixels each");
  require(
      size.width % 2 == 0 && size.height % 2 == 0, "size", size, "even for a video");
}

void
addFilm(OptionTable& table, AnimationSettings& s)
{
  table.group("Film");
  table
      .add("kind KIND",
           &s.kind,
           {{"flythrough", AnimationKind::kFlyThrough},
            {"turntable", AnimationKind::kTurntable},
            {"growth", AnimationKind::kGrowth},
            {"relaxation", AnimationKind::kRelaxation}})
      .required()
      .help("flythrough|turntable|growth|relaxation: along the trajectory, once around "
            "the map, scan by scan, from the given to the final poses, round by round");
  table.add("frames N", &s.frames)
      .within(2, 100000, "2 to 100000")
      .help(
          "number of frames of flythrough and turntable; growth has a frame per scan");
  table.add("steps N", &s.steps)
      .within(1, 1000, "1 to 1000")
      .help("frames from one round of relaxation to the next");
  table.add("points N", &s.points)
      .above(0, "> 0")
      .help("largest number of points drawn");
}
} // namespace

bool
AnimationSettings::isVideo() const
{
  static const std::set<std::string> kVideos = {".avi", ".mkv", ".mp4", ".webm"};
  return kVideos.count(std::filesystem::path(output).extension().string()) > 0;
}

bool
parseAnimationSettings(const std::vector<std::string>& arguments, AnimationSettings& s)
{
  std::optional<double> fps;
  PixelSize size{s.width, s.height};
  OptionTable table(std::string("usage: ") + kRender + kUsageText);
  table.positional("RUN", &s.run);
  table.group("Output");
  table.add("output,o OUT", &s.output).required().help("folder, or video file");
  table.add("size WxH", &size).help("[px] 200 to 8192 each, even");
  table.add("fps N", &fps)
      .above(0, "above 0, up to 240", 240)
      .help("frames per second of the video; by default 25, of growth 8");
  table.add("force", &s.force).help("write into a folder that is not empty");
  s.memory.addTo(table);
  table.add("quiet", &s.quiet).help("print errors only");
  addFilm(table, s);
  if (!table.parse(arguments))
    return false;
  s.width = size.width;
  s.height = size.height;
  s.fps = fps.value_or(s.kind == AnimationKind::kGrowth ? 8 : 25);
  table.check([&] { checkSize(size); });
  return true;
}

} // namespace pcl6d::app
