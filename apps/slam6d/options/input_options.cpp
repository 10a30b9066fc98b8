// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/bag_options.h"
#include "common/options/option_table.h"
#include "slam6d/options/input_options.h"
#include "slam6d/options/plugin_words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <map>
#include <tuple>
#include <utility>

namespace pcl6d::app {

namespace {
void
takeDeskew(Settings& s, const std::string& word)
{
  if (word == "auto")
    s.deskew = Deskew::kAuto;
  else if (word == "no")
    s.deskew = Deskew::kNone;
  else if (word == "yes" || word == kDeskewOdometry)
    s.deskew = Deskew::kOdometry;
  else if (word == kDeskewEstimate)
    s.deskew = Deskew::kEstimate;
  else
    throw BadArgument("word = " + word +
                      ", but must be auto, odometry, estimate, yes or no");
}

void
takeTracking(Settings& s, const std::string& word)
{
  if (word == "auto")
    s.track = Tracking::kAuto;
  else if (word == "on")
    s.track = Tracking::kOn;
  else if (word == "off")
    s.track = Tracking::kOff;
  else
    throw BadArgument("word = " + word + ", but must be auto, on or off");
}

void
takeEvery(Settings& s, const std::string& word)
{
  s.takes_keyframes = word == "auto";
  int number = 1;
  if (!s.takes_keyframes && (!text::parseNumber(word, number) || number < 1))
    throw BadArgument("word = " + word + ", but must be auto or a number >= 1");
  s.folder.every = number;
}
void
takeStart(Settings& s, const std::string& word)
{
  static const std::map<std::string, std::pair<Tracking, InitialGuess>> starts = {
      {"poses", {Tracking::kOff, InitialGuess::kOdometry}},
      {"sequence", {Tracking::kOn, InitialGuess::kOdometry}},
      {"overlap", {Tracking::kOff, InitialGuess::kOverlap}},
      {"features", {Tracking::kOff, InitialGuess::kFeatures}},
      {"any-order", {Tracking::kOff, InitialGuess::kGlobal}}};
  const auto found = starts.find(word);
  if (found == starts.end() && word != "auto")
    throw BadArgument("word = " + word +
                      ", but must be auto, poses, sequence, overlap, features or "
                      "any-order");
  s.start = word;
  if (found == starts.end())
    return;
  s.auto_guess = false;
  std::tie(s.track, s.slam.initial_guess) = found->second;
}

void
describePlugins(OptionList& list, Settings& s)
{
  list.add("plugin FILE", s.plugin_files)
      .as(OptionRole::kInput)
      .mayRepeat()
      .ifNotGiven("none")
      .withHelp("shared library with further words for --format, --filter, "
                "--minimiser, --plane-minimiser and --search (share/doc/plugins.md); "
                "its code runs with your rights; once for each file");
}

void
describeFolder(OptionList& list, Settings& s)
{
  const auto has_folder = [&s] { return !s.joins; };
  const std::string of_folder = "of SCAN_DIR";
  list.add("first", s.folder.first)
      .as(OptionRole::kInput)
      .within(from0())
      .countsIf(has_folder, of_folder)
      .withHelp("index of the first scan to take, in the order of the folder");
  list.add("last", s.folder.last)
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .ifNotGiven("end")
      .withHelp("index of the last scan to take (default: the end)");
  list.addWord("every N", s.folder.every, reader(s, takeEvery))
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .withDefault("auto")
      .withHelp("take each n-th scan; auto: each scan, or the keyframes, with enough "
                "new space, of tracked sweeps (--track) and of recordings with poses; "
                "sweeps in between keep the motion relative to keyframes");
  list.add(std::string(kPosesOption) + " FILE", s.folder.poses_file)
      .as(OptionRole::kInputFile)
      .calledField("poses_file")
      .countsIf(has_folder, of_folder)
      .withHelp("initial poses, KITTI or TUM rows, a row per scan of the folder "
                "(default: *.pose, odometry.txt, poses.txt, PCD VIEWPOINT or identity, "
                "the first found)");
}

void
describeStart(OptionList& list, Settings& s)
{
  const auto has_folder = [&s] { return !s.joins; };
  const std::string of_folder = "of SCAN_DIR";
  list.addWord("start WORD", s.start, reader(s, takeStart))
      .as(OptionRole::kSession)
      .countsIf(has_folder, of_folder)
      .withDefault("auto")
      .withHelp("auto|poses|sequence|overlap|features|any-order: where matching "
                "starts; sets --track and --initial-guess together. poses: of the "
                "folder; sequence: each scan is tracked from the scan before; "
                "any-order: every scan against every scan");
  list.addWord("track WORD", s.track, reader(s, takeTracking))
      .as(OptionRole::kMethod)
      .countsIf(has_folder, of_folder)
      .withDefault("auto")
      .impliedWord("on")
      .withHelp("auto|on|off: initial poses by tracking the scans in file order, like "
                "the sweeps of a drive; auto: in folders of more than 60 scans without "
                "poses, or with poses as close together as those of sweeps, if three "
                "in four can be tracked. With stamps and times of points, the scans "
                "are deskewed along these poses");
}

void
describeFormat(OptionList& list, Settings& s)
{
  const auto has_folder = [&s] { return !s.joins; };
  const std::string of_folder = "of SCAN_DIR";
  list.addWord("format", s.folder.format, reader(s, takeFormat))
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .withDefault(toString(s.folder.format))
      .withHelp("auto|pcd|ply|uos|kitti|xyz|las|laz|ptx|pts|csv|txt, or a format of a "
                "plug-in");
  list.addWord(
          "columns LIST",
          s.folder.columns,
          [&s](const std::string& word) { s.folder.columns = columnsFromText(word); })
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .ifNotGiven("by heading")
      .withHelp("columns of csv, txt, pts and xyz, for example x,y,z,,i (an empty "
                "column is not read): x y z intensity|i r g b nx ny nz ring time "
                "(default: by the heading of the file)");
  list.addChoice("bin-layout", s.folder.bin_layout, binLayoutFromName)
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .withHelp(
          "auto|xyz|xyzi|xyzir|xyzit|xyzirt|nclt|helipr-avia|helipr-aeva|helipr-ouster|"
          "helipr-velodyne: layout of a point in a .bin file (xyzi: KITTI, xyzir: "
          "nuScenes; auto: by the data set, else by size and values)");
}

void
describeRecording(OptionList& list, Settings& s)
{
  const auto has_folder = [&s] { return !s.joins; };
  const std::string of_folder = "of SCAN_DIR";
  list.add("topic NAME", s.folder.bag.topic)
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .ifNotGiven("the only one")
      .withHelp(kTopicHelp);
  list.add("odometry TOPIC", s.folder.bag.odometry)
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .ifNotGiven("auto")
      .withHelp(kOdometryHelp);
  list.add("imu TOPIC", s.folder.bag.imu)
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .ifNotGiven("no")
      .withHelp(kImuHelp);
  list.addChoice("time", s.folder.bag.time, bagTimeFromName)
      .as(OptionRole::kInput)
      .countsIf(has_folder, of_folder)
      .withHelp(kTimeHelp);
}

void
describeDeskew(OptionList& list, Settings& s, const OptionList& slam)
{
  list.stage(OptionStage::kDeskew);
  list.addWord("deskew WORD", s.deskew, reader(s, takeDeskew))
      .countsIf([&s] { return !s.joins; }, "of SCAN_DIR")
      .withDefault("auto")
      .impliedWord("yes")
      .withHelp("scans were taken while moving: correct each point by its time (field "
                "t or time). odometry, or no word: along the initial poses; needs time "
                "stamps (times.txt, or TUM rows). estimate: by the motion estimated "
                "from the scans; needs neither poses nor stamps. auto: tracked sweeps, "
                "unless their points are corrected already; no: never");
  list.addWord("interpolation",
               s.interpolation,
               [&s](const std::string& word) {
                 s.interpolation = motionInterpolationFromName(word);
               })
      .withDefault("linear")
      .countsIf([&s] { return s.deskew == Deskew::kOdometry; }, "of --deskew")
      .withHelp(
          "linear|cubic: how --deskew moves between two poses; cubic follows bends "
          "better");
  list.append(slam.of(&s.slam.motion.knots))
      .countsIf([&s] { return s.deskew == Deskew::kEstimate; }, "of --deskew estimate");
}

void
describeRuns(OptionList& list, Settings& s)
{
  list.stage(OptionStage::kRead);
  list.add("continue RUN_DIR", s.continued)
      .as(OptionRole::kInputFile)
      .withHelp("goes on with a finished run: registered scans keep their poses, and "
                "options of the run stay valid unless given anew; adds the files of "
                "SCAN_DIR with new names; -o is RUN_DIR by default");
  list.add("join", s.joins)
      .as(OptionRole::kInput)
      .withHelp("the arguments are two finished runs of one site, RUN_A RUN_B (or "
                "more), in place of SCAN_DIR: the runs become one, in the world of "
                "RUN_A, relaxed together; the runs may have different frames");
}
} // namespace

void
describeInput(OptionList& list, Settings& s, const OptionList& slam)
{
  list.stage(OptionStage::kRead);
  list.group("Input");
  describePlugins(list, s);
  describeFolder(list, s);
  describeStart(list, s);
  describeFormat(list, s);
  describeRecording(list, s);
  describeDeskew(list, s, slam);
  describeRuns(list, s);
}

} // namespace pcl6d::app
