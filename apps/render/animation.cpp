// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/output/output_folder.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "render/run_animation.h"
#include "render/verbs.h"
#include "render/video_file.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/frames_io.h>

#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr const char* kVideoName = "animation.mp4";

std::string
frameName(std::size_t number)
{
  std::ostringstream name;
  name << "frame" << std::setw(5) << std::setfill('0') << number << ".png";
  return name.str();
}

/** Draws the frames and passes them on. \return false if interrupted */
bool
play(const RunAnimation& animation,
     const AnimationSettings& s,
     const std::function<void(std::size_t, const Image&)>& take)
{
  const Interrupt interrupt;
  ProgressBar bar(s.quiet);
  for (std::size_t i = 0; i < animation.size(); ++i) {
    if (interrupt.requested())
      return false;
    take(i, animation.draw(i));
    bar.show({"drawing", i + 1, animation.size()});
  }
  return true;
}

int
writeVideo(const RunAnimation& animation, const AnimationSettings& s)
try {
  writeFileAtomicallyBy(s.output, [&](const fs::path& path) {
    VideoFile video(path, s.output, s.width, s.height, s.fps);
    if (!play(animation, s, [&](std::size_t, const Image& image) { video.add(image); }))
      throw Interrupted();
    video.close();
  });
  std::cout << s.output << '\n';
  return kDone;
} catch (const Interrupted&) {
  return kInterrupted;
}

/** A folder is of use without the video, too. */
std::unique_ptr<VideoFile>
videoIn(const OutputFolder& out, const AnimationSettings& s)
{
  std::unique_ptr<VideoFile> video;
  try {
    video = std::make_unique<VideoFile>(
        out / kVideoName, s.output + '/' + kVideoName, s.width, s.height, s.fps);
  } catch (const IoFailed& e) {
    ProgressBar(s.quiet).warn(std::string("no video: ") + e.what());
    out.discard(kVideoName);
  }
  return video;
}

int
writeFrames(const RunAnimation& animation, const AnimationSettings& s)
{
  OutputFolder out({s.output,
                    {s.run},
                    kRender,
                    "",
                    std::regex("frame[0-9]{5,}\\.png|animation\\.mp4"),
                    s.force});
  auto video = videoIn(out, s);
  const auto take = [&](std::size_t i, const Image& image) {
    writePng(out / frameName(i + 1), image);
    if (video)
      video->add(image);
  };
  if (!play(animation, s, take))
    return kInterrupted;
  if (video)
    video->close();
  out.publish();
  std::cout << s.output << ": " << animation.size() << " frames"
            << (video ? std::string(" and ") + kVideoName : "") << '\n';
  return kDone;
}
} // namespace

int
runAnimation(const std::vector<std::string>& arguments)
{
  AnimationSettings s;
  if (!parseAnimationSettings(arguments, s))
    return kDone;
  const MemoryBudget memory(s.memory, s.output);
  const RunFolder run(s.run);
  const RunAnimation animation(run, s);
  return s.isVideo() ? writeVideo(animation, s) : writeFrames(animation, s);
}

} // namespace pcl6d::app
