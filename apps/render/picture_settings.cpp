// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "render/picture_settings.h"
#include "render/run_pictures.h"
#include "render/verbs.h"

#include <pcl6d/common/angle.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pcl6d::app {

namespace {
int
wholeNumber(const std::string& option, const std::string& word)
{
  int value = 0;
  const char* const end = word.data() + word.size();
  if (std::from_chars(word.data(), end, value).ptr != end || word.empty())
    throw UsageError("--" + option + " = " + word + ", but must be a whole number");
  return value;
}

void
takeSize(const std::string& word, PictureSettings& s)
{
  if (word == "auto")
    return;
  const auto cross = word.find('x');
  if (cross == std::string::npos)
    throw UsageError("--size = " + word + ", but must be like 1920x1080, or auto");
  for (auto [side, text] : {std::pair(&s.width, word.substr(0, cross)),
                            std::pair(&s.height, word.substr(cross + 1))}) {
    *side = wholeNumber("size", text);
    if (**side < 200 || **side > 8192)
      throw UsageError("--size = " + word +
                       ", but each side must be 200 to 8192 pixels");
  }
}

/** Names with commas between, or in several options. */
void
takeViews(const std::vector<std::string>& words, PictureSettings& s)
{
  for (const std::string& word : words)
    for (std::size_t begin = 0; begin <= word.size();) {
      const std::size_t end = std::min(word.find(',', begin), word.size());
      const std::string name = word.substr(begin, end - begin);
      begin = end + 1;
      if (!RunPictures::isView(name))
        throw UsageError("--view = " + name + ", but must be one of " +
                         RunPictures::viewNames());
      if (std::find(s.views.begin(), s.views.end(), name) == s.views.end())
        s.views.push_back(name);
    }
}

void
addOutput(OptionTable& table, PictureSettings& s, std::vector<std::string>& views)
{
  table.group("Output");
  table.add("output,o PATH", &s.output)
      .help("PNG file for one view, or folder; by default RUN/pictures");
  table.add("view NAME,...", &views)
      .help("names of views, see above; by default every view that suits the run");
  table.addWord("size WxH", "auto", [&s](const auto& size) { takeSize(size, s); })
      .help("[px] 200 to 8192 each");
  s.memory.addTo(table);
  table.add("title TEXT", &s.title).help("top left");
}

void
addLook(OptionTable& table, PictureSettings& s)
{
  const auto takeColour = [&s](const std::string& name) {
    if (name != "auto")
      s.colour = pointColourFromName(name);
  };
  const auto takeMap = [&s](const std::string& name) {
    if (name != "auto")
      s.colour_map = colourMapFromName(name);
  };
  table.group("Look");
  table.addWord("colour NAME", "auto", takeColour)
      .help("auto|height|scan|reflectance|residual|label|plain: of points; auto: "
            "suited to the view");
  table.addWord("colour-map NAME", "auto", takeMap)
      .help("auto|viridis|turbo|magma|grey");
  table.add("background NAME", &s.background, backgroundFromName, "dark")
      .help("dark|light");
  table.add("transparent", &s.transparent).help("nothing in its place");
  table.add("points N", &s.points)
      .above(0, "> 0")
      .help("largest number of points drawn, evenly chosen");
}

void
addViews(OptionTable& table, PictureSettings& s)
{
  const auto takeScan = [&s](const std::string& word) {
    if (word != "auto")
      s.scan = wholeNumber("scan", word);
  };
  table.group("Single views");
  table.addAuto("height Z", &s.slice_height)
      .within(-kFinite, kFinite, "finite")
      .help("[m] slice: height in the world; auto: height of the nearest pose");
  table.add("thickness D", &s.slice_thickness)
      .above(0, "> 0")
      .help("[m] slice: of the layer");
  table.addWord("scan N", "auto", takeScan)
      .help("panorama, convergence: index of the scan; auto: the middle scan of the "
            "run, or the scan with the largest correction");
  table.add("viewpoint N", &s.viewpoint)
      .within(1, 4, "1 to 4")
      .help("perspective, objects: the N-th best view, 1 to 4");
  table.addAuto("azimuth DEG", &s.azimuth, kDegree)
      .within(-kFinite, kFinite, "finite")
      .help(
          "perspective, objects, planes: of the camera seen from the map, from x to y");
  table.addAuto("elevation DEG", &s.elevation, kDegree)
      .help("of the camera above the horizon");
  table.add("models DIR", &s.models)
      .help("objects: shapes to draw, CLASS.ply, .obj or .stl [m], or a store "
            "(share/models)");
}
} // namespace

bool
parsePictureSettings(const std::vector<std::string>& arguments,
                     PictureSettings& settings)
{
  OptionTable table(std::string("usage: ") + kRender +
                    R"( picture RUN [-o PATH] [--view NAME,...] [options]
Draws what a run of pcl_slam6d left in the folder RUN, as far as it is there,
into PNG files. Needs no display.
Views:)" + RunPictures::viewTable() +
                    "\n");
  std::vector<std::string> views;
  table.positional("RUN", &settings.run);
  addOutput(table, settings, views);
  addLook(table, settings);
  addViews(table, settings);
  if (!table.parse(arguments))
    return false;
  takeViews(views, settings);
  if (settings.elevation &&
      !(*settings.elevation > 0 && *settings.elevation < M_PI / 2))
    throw UsageError("--elevation must be between 0 and 90 degrees");
  return true;
}

} // namespace pcl6d::app
