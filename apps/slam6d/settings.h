// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/memory_budget.h"
#include "common/option_table.h"
#include "slam6d/moving_output.h"
#include "slam6d/other_filter.h"

#include <pcl6d/filters/line_filter.h>
#include <pcl6d/filters/motion_correction.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/plugins.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief How the motion of the scanner during each scan is undone. */
enum class Deskew {
  kNone,
  kOdometry, ///< along the initial poses
  kEstimate  ///< as the scans themselves show it
};

/** \brief The command line of pcl_slam6d. */
struct Settings {
  std::string input;               ///< the scans; empty where runs are joined
  std::vector<std::string> joined; ///< folders of runs that become one; empty: none
  std::string out;
  ScanFolderOptions folder;
  Slam6DOptions slam;
  MemoryOption memory;
  std::vector<std::string> plugin_files; ///< as given
  Plugins plugins;                       ///< of these files, when they are loaded
  std::string continued;                 ///< folder of a run that goes on; empty: none
  std::string graph_in;                  ///< file of given links; empty: none
  bool auto_guess = true; ///< the initial guess follows from the poses that are there
  Deskew deskew = Deskew::kNone;
  MotionInterpolation interpolation = MotionInterpolation::kLinear; ///< of kOdometry
  LineFilter filter = LineFilter::kNone; ///< along the lines of each scan
  OtherFilter other_filter;              ///< in its place, that of a plug-in
  Moving moving = Moving::kLabel;        ///< what becomes of points that moved
  bool planes = false;                   ///< find and label the planes of the map
  bool live_view = false;                ///< show the map in a window while it grows
  bool report = false;                   ///< write report.html
  bool no_picture = false;               ///< do not draw the map from above
  bool no_verification = false;          ///< do not judge the map in the end
  bool no_recovery = false;              ///< do not look for lost scans
  bool resume = false;                   ///< say so if there is nothing to go on with
  bool fresh = false;                    ///< drop what an interrupted run has done
  bool force = false;
  bool quiet = false;
  bool verbose = false;
  bool timing = false;                ///< print where the time went
  std::vector<OptionWord> words;      ///< those of the summary
  std::vector<OptionWord> conditions; ///< those that poses follow from
  std::map<std::string, std::string>
      length_reasons;         ///< of lengths that are given, but not by the user
  std::string without_effect; ///< words that were given for nothing; else empty

  /** \return what is read, for people */
  std::string
  inputWords() const;

  /** Decides what --initial-guess auto means for a folder. */
  void
  resolveGuess(bool has_poses);

  /** Reads the given links. \param[in] indices of the chosen scans in their folder
   * \throws IoFailed the file is broken, or speaks of a scan that is not chosen */
  void
  readLinks(const std::vector<std::size_t>& indices);
};

/** \brief Fills the settings from the command line and the config file.
 * \return false when there is nothing more to do (--help)
 * \throws UsageError, boost::program_options::error an option breaks its rule */
bool
parseSettings(const std::vector<std::string>& arguments, Settings& settings);

/** \return the parameters that are known by now, under the names of their options; those of
 * loops and links are known after matching, and only if there is such a stage */
std::vector<std::pair<std::string, Parameter>>
named(const Slam6DParameters& parameters, const Settings& settings);

} // namespace pcl6d::app
