// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/option_table.h"
#include "common/process/memory_budget.h"
#include "slam6d/input/other_filter.h"
#include "slam6d/options/moving_output.h"

#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/filters/line_filter.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/plugins.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief Method of deskewing. */
enum class Deskew {
  kAuto, ///< tracked sweeps along the tracked motion, unless corrected already; no further scans
  kNone,
  kOdometry, ///< along the initial poses
  kEstimate  ///< as estimated from the scans
};

/** \brief Whether the initial poses are found by tracking the scans as sweeps of a drive. */
enum class Tracking {
  kAuto, ///< in large folders without poses, where the sweeps can be tracked
  kOn,
  kOff
};

/** \name Options used in several files of the program
 * @{ */
constexpr char kPosesOption[] = "poses";
constexpr char kPlanesOption[] = "planes";
constexpr char kReportOption[] = "report";
constexpr char kProjectOption[] = "project";
constexpr char kToleranceOption[] = "tolerance";
constexpr char kNoPictureOption[] = "no-picture";
/** @} */
/** Words of --deskew. */
constexpr char kDeskewOdometry[] = "odometry", kDeskewEstimate[] = "estimate";

/** \brief A length used by a run, under the name of its option. */
struct NamedParameter {
  std::string name;
  std::string unit;
  Parameter parameter;
};

/** \brief The given files of control points. */
struct ControlFiles {
  std::string points;  ///< file of control points; empty: none
  std::string targets; ///< file of their targets
  std::string checks;  ///< names of check points, separated by commas
};

/** \brief The command line of pcl_slam6d. */
struct Settings {
  bool joins = false; ///< finished runs are joined
  /** the scans: a folder or files; empty for joined runs */
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> joined; ///< folders of runs to join; may be empty
  std::string out;
  ScanFolderOptions folder;
  Slam6DOptions slam;
  MemoryOption memory;
  std::vector<std::string> plugin_files; ///< as given
  Plugins plugins;                       ///< loaded from these files
  std::string continued;                 ///< folder of the continued run; empty: none
  std::string graph_in;                  ///< file of given links; empty: none
  ControlFiles control;
  bool auto_guess = true;     ///< the initial guess depends on the available poses
  std::string start = "auto"; ///< sets track and the initial guess together
  Tracking track = Tracking::kAuto;
  /** only the keyframes of tracked sweeps are scans of the map (--every auto) */
  bool takes_keyframes = true;
  Deskew deskew = Deskew::kAuto;
  MotionInterpolation interpolation = MotionInterpolation::kLinear; ///< of kOdometry
  LineFilter filter = LineFilter::kNone; ///< along the lines of each scan
  OtherFilter other_filter;              ///< filter of a plug-in, instead of `filter`
  Moving moving = Moving::kLabel;        ///< treatment of dynamic points
  bool planes = false;                   ///< find and label the planes of the map
  bool live_view = false;                ///< show the map in a window during the run
  bool report = false;                   ///< write report.html
  std::vector<std::string> project;      ///< key=value for the survey report
  int epsg = 0;            ///< code of the coordinate system; 0: not known
  std::string tolerance;   ///< for the survey report; empty: none
  bool no_picture = false; ///< do not draw the map from above
  bool explain = false;    ///< print the plan of the run without running
  bool resume = false;     ///< warn if no interrupted run exists
  bool fresh = false;      ///< drop the results of an interrupted run
  bool force = false;
  bool quiet = false;
  bool verbose = false;
  bool timing = false;                ///< print where the time went
  std::vector<OptionWord> words;      ///< of the summary
  std::vector<OptionWord> conditions; ///< options that change poses
  std::map<std::string, std::string>
      length_reasons;         ///< sources of lengths not given by the user
  std::string without_effect; ///< options without effect; may be empty

  /** \return the input, for people */
  std::string
  inputWords() const;

  /** Resolves --initial-guess auto for a folder.
   * \param[in] has_poses whether initial poses tell where the scans are
   * (ScanFolder::posesDiffer()) */
  void
  resolveGuess(bool has_poses);

  /** Reads the given links. \param[in] indices of the chosen scans in their folder
   * \throws IoFailed the file is broken, or has a scan that is not chosen */
  void
  readLinks(const std::vector<std::size_t>& indices);

  /** Reads the control points and their targets, if given.
   * \throws IoFailed a file is broken, or has a scan that is not chosen
   * \throws BadArgument the points do not fix the map, see ControlOptions::validate() */
  void
  readControl(const ScanFolder& scans);
};

/** \brief Fills the settings from the command line and the config file.
 * \return false if the program is to end (--help)
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseSettings(const std::vector<std::string>& arguments, Settings& settings);

/** \return the parameters already known, under the names of their options; parameters of loops and
 * links are known only after matching, and only with a stage that uses them */
std::vector<NamedParameter>
named(const Slam6DParameters& parameters, const Settings& settings);

} // namespace pcl6d::app
