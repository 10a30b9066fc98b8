// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "render/run_pictures.h"
#include "render/verbs.h"

#include <pcl6d/common/error.h>

#include <iostream>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** \return the missing parts of a run, in one line; empty if complete */
std::string
lackOf(const RunFolder& run)
{
  const auto missing = run.missing();
  constexpr std::size_t kNamed = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(missing.size(), kNamed); ++i)
    text += (text.empty() ? "" : ", ") + missing[i];
  if (missing.size() > kNamed)
    text += " and " + std::to_string(missing.size() - kNamed) + " more files";
  return text;
}

bool
isPictureFile(const fs::path& path)
{
  return path.extension() == ".png" || path.extension() == ".PNG";
}

/** Makes the folder of the pictures, if needed. \return path of a view */
fs::path
prepareOutput(const PictureSettings& s, std::size_t views)
{
  const fs::path output =
      s.output.empty() ? fs::path(s.run) / "pictures" : fs::path(s.output);
  if (isPictureFile(output)) {
    if (views != 1)
      throw UsageError(
          "--output = " + s.output + " is one file, but the options ask for " +
          std::to_string(views) + " views; give a folder or a single --view");
    return output;
  }
  std::error_code error;
  fs::create_directories(output, error);
  if (error || !fs::is_directory(output))
    throw IoFailed(output.string() + ": cannot make this folder");
  return output;
}
} // namespace

int
runPicture(const std::vector<std::string>& arguments)
{
  PictureSettings s;
  if (!parsePictureSettings(arguments, s))
    return kDone;
  const MemoryBudget memory(s.memory, s.output.empty() ? s.run : s.output);
  const RunFolder run(s.run);
  if (const std::string lack = lackOf(run); !lack.empty())
    std::cerr << kRender << ": " << s.run << " lacks " << lack << '\n';
  RunPictures pictures(run, s);
  const auto views = s.views.empty() ? pictures.suitableViews() : s.views;
  const fs::path output = prepareOutput(s, views.size());
  bool drawn = false;
  for (const std::string& view : views) {
    const fs::path file = isPictureFile(output) ? output : output / (view + ".png");
    try {
      writePng(file, pictures.draw(view));
    } catch (const BadArgument& e) { // an empty scene for the view
      if (!s.views.empty())
        throw IoFailed(s.run + ": " + view + ": " + e.what());
      std::cerr << kRender << ": warning: no picture of " << view << ": " << e.what()
                << '\n';
      continue;
    }
    drawn = true;
    std::cout << file.string() << '\n';
  }
  if (!drawn)
    throw IoFailed(s.run + ": nothing to draw");
  return kDone;
}

} // namespace pcl6d::app
