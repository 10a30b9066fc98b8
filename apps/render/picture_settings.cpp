// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "render/picture_settings.h"
#include "render/run_pictures.h"
#include "render/verbs.h"

#include <pcl6d/common/angle.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

/** Options as they are typed. */
struct Words {
  std::vector<std::string> views;
  std::string colour = "auto";
  std::string colour_map = "auto";
  std::string background = "dark";
  std::string size = "auto";
  std::string scan = "auto";
};

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
takeWords(const Words& words, PictureSettings& s)
{
  takeViews(words.views, s);
  takeSize(words.size, s);
  if (words.scan != "auto")
    s.scan = wholeNumber("scan", words.scan);
  checkOptions([&] {
    if (words.colour != "auto")
      s.colour = pointColourFromName(words.colour);
    if (words.colour_map != "auto")
      s.colour_map = colourMapFromName(words.colour_map);
    s.background = backgroundFromName(words.background);
  });
}

void
checkNumbers(PictureSettings& s)
{
  if (!(s.slice_thickness > 0))
    throw UsageError("--thickness must be > 0");
  if (s.points == 0)
    throw UsageError("--points = 0, but must be > 0");
  if (s.viewpoint < 1 || s.viewpoint > 4)
    throw UsageError("--viewpoint = " + std::to_string(s.viewpoint) +
                     ", but must be 1 to 4");
  for (AutoDouble* angle : {&s.azimuth, &s.elevation})
    angle->value *= kDegree;
  if (!s.elevation.is_auto && !(s.elevation.value > 0 && s.elevation.value < M_PI / 2))
    throw UsageError("--elevation must be between 0 and 90 degrees");
}

void
describe(PictureSettings& s, Words& w, CommandLine& line)
{
  line.group("Output").add_options()(
      "output,o",
      po::value(&s.output)->value_name("PATH"),
      "PNG file for one view, or folder; by default RUN/pictures") //
      ("view",
       po::value(&w.views)->value_name("NAME,..."),
       "by their names, see above; by default all that suit the run")       //
      ("size", valueOf(w.size)->value_name("WxH"), "[px] 200 to 8192 each") //
      ("title", po::value(&s.title)->value_name("TEXT"), "top left");
  line.group("Look").add_options() //
      ("colour",
       valueOf(w.colour)->value_name("NAME"),
       "auto|height|scan|reflectance|residual|label|plain: of points; auto: what suits "
       "the view") //
      ("colour-map",
       valueOf(w.colour_map)->value_name("NAME"),
       "auto|viridis|turbo|magma|grey")                                        //
      ("background", valueOf(w.background)->value_name("NAME"), "dark|light")  //
      ("transparent", po::bool_switch(&s.transparent), "nothing in its place") //
      ("points",
       valueOf(s.points)->value_name("N"),
       "draw at most so many, evenly chosen");
  line.group("Single views")
      .add_options() //
      ("height",
       valueOf(s.slice_height)->value_name("Z"),
       "[m] slice: height in the world; auto: that of the nearest pose") //
      ("thickness",
       valueOf(s.slice_thickness)->value_name("D"),
       "[m] slice: of the layer") //
      ("scan",
       valueOf(w.scan)->value_name("N"),
       "panorama, convergence: index of the scan; auto: in the middle of the run, or "
       "the "
       "one that was corrected most") //
      ("viewpoint",
       valueOf(s.viewpoint)->value_name("N"),
       "perspective, objects: the N-th best one, 1 to 4") //
      ("azimuth",
       valueOf(s.azimuth)->value_name("DEG"),
       "perspective, objects, planes: of the camera seen from the map, from x to y") //
      ("elevation",
       valueOf(s.elevation)->value_name("DEG"),
       "of the camera above the horizon") //
      ("models",
       po::value(&s.models)->value_name("DIR"),
       "objects: shapes to draw, CLASS.ply, .obj or .stl [m], or a store such as "
       "share/models");
}
} // namespace

bool
parsePictureSettings(const std::vector<std::string>& arguments,
                     PictureSettings& settings)
{
  CommandLine line(
      std::string("usage: ") + kRender +
      " picture RUN [-o PATH] [--view NAME,...] [options]\n"
      "Draws what a run of pcl_slam6d left in the folder RUN, as far as it "
      "is there,\ninto PNG files. Needs no display.\nViews:" +
      RunPictures::viewTable() + "\n");
  Words words;
  line.positional("RUN", &settings.run);
  describe(settings, words, line);
  if (!line.parse(arguments))
    return false;
  takeWords(words, settings);
  checkNumbers(settings);
  return true;
}

} // namespace pcl6d::app
