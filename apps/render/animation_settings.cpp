// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "render/animation_settings.h"
#include "render/verbs.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>

#include <filesystem>
#include <set>
#include <sstream>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

constexpr const char* kUsageText =
    " animation RUN --kind KIND -o OUT [options]\n"
    "Shows a run of pcl_slam6d as a film. OUT is a folder, which gets a PNG file per\n"
    "frame and a video if there is a codec for it, or one video file (.mp4, .avi,\n"
    ".mkv, .webm). Growth and relaxation need the run's scans/ and frames/.\n";

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

AnimationKind
kindFromName(const std::string& name)
{
  constexpr Named<AnimationKind> kKinds[] = {
      {AnimationKind::kFlyThrough, "flythrough"},
      {AnimationKind::kTurntable, "turntable"},
      {AnimationKind::kGrowth, "growth"},
      {AnimationKind::kRelaxation, "relaxation"}};
  if (const auto kind = findNamed(kKinds, name))
    return *kind;
  throw UsageError("--kind = " + name + ", but must be " +
                   listed(kKinds, WordList::kOr));
}

void
check(const AnimationSettings& s)
{
  checkOptions([&] {
    for (const int side : {s.width, s.height})
      require(side >= 200 && side <= 8192, "size", side, "200 to 8192 pixels each");
    require(s.width % 2 == 0 && s.height % 2 == 0,
            "size",
            std::to_string(s.width) + "x" + std::to_string(s.height),
            "even, as video wants it");
    require(s.frames >= 2 && s.frames <= 100000, "frames", s.frames, "2 to 100000");
    require(s.steps >= 1 && s.steps <= 1000, "steps", s.steps, "1 to 1000");
    require(s.fps > 0 && s.fps <= 240, "fps", s.fps, "above 0, up to 240");
    require(s.points > 0, "points", s.points, "> 0");
  });
}

double
usualRate(AnimationKind kind)
{
  return kind == AnimationKind::kGrowth ? 8 : 25;
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
  std::string kind;
  PixelSize size{s.width, s.height};
  CommandLine line(std::string("usage: ") + kRender + kUsageText);
  line.positional("RUN", &s.run);
  line.group("Output").add_options()(
      "output,o",
      po::value(&s.output)->value_name("OUT")->required(),
      "folder, or video file")(
      "size", valueOf(size)->value_name("WxH"), "[px] 200 to 8192 each, even")(
      "fps",
      po::value(&s.fps)->value_name("N"),
      "frames per second of the video; by default 25, of growth 8")(
      "force", po::bool_switch(&s.force), "write into a folder that holds other files")(
      "quiet", po::bool_switch(&s.quiet), "print errors only");
  line.group("Film").add_options()(
      "kind",
      po::value(&kind)->value_name("KIND")->required(),
      "flythrough|turntable|growth|relaxation: along the trajectory, once around the "
      "map, scan by scan, from the given poses to the final ones round by round")(
      "frames",
      valueOf(s.frames)->value_name("N"),
      "how many, of flythrough and turntable; growth has one per scan")(
      "steps",
      valueOf(s.steps)->value_name("N"),
      "frames from one round of relaxation to the next")(
      "points", valueOf(s.points)->value_name("N"), "at most so many are drawn");
  if (!line.parse(arguments))
    return false;
  s.kind = kindFromName(kind);
  s.width = size.width;
  s.height = size.height;
  if (!line.given("fps"))
    s.fps = usualRate(s.kind);
  check(s);
  return true;
}

} // namespace pcl6d::app
