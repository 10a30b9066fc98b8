// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief Options of a program under their names without dashes: a number, a string, or
 * true for an option without a value. Later ones replace earlier ones; false and null take
 * an option back. */
using SuiteOptions = nlohmann::ordered_json;

/** \brief What is done to scans and their initial poses before a run gets them, so that one
 * sees whether it notices. Indices count scans of the folder. */
struct SuiteDamage {
  /** \brief The odometry leaps. */
  struct Jump {
    std::size_t scan = 0; ///< it and all behind it
    double metres = 0;    ///< forward, along x of the scan before
  };

  std::string name;            ///< empty: nothing is done
  SuiteOptions options;        ///< of pcl_slam6d
  nlohmann::ordered_json text; ///< all other fields, as in the file
  double odometry_noise = 1;   ///< factor of what each step is off by
  double odometry_scale = 1;   ///< factor of all positions, as feet taken for metres
  double turn = 0;             ///< [deg] of each scan's axes about z, against its pose
  std::optional<Jump> jump;
  bool no_poses = false;
  std::optional<std::pair<std::size_t, std::size_t>> swap; ///< scans that change places
  /** a scan that is replaced by the one of the same index of the next data set */
  std::optional<std::size_t> foreign;
  std::optional<std::size_t> points; ///< that are left of a scan, evenly chosen
  std::vector<std::pair<std::size_t, std::size_t>> links; ///< given to pcl_slam6d

  bool
  changesPoses() const
  {
    return odometry_noise != 1 || odometry_scale != 1 || turn != 0 || jump;
  }
  /** \return whether there are other files than without it */
  bool
  changesFiles() const
  {
    return changesPoses() || no_poses || swap || foreign || points || !links.empty();
  }
};

/** \brief Scans that all methods get. */
struct SuiteData {
  std::string name;        ///< "parking seed 3, scans swapped"
  std::string entry;       ///< its name in the file: "parking"
  std::string base;        ///< its name without damage: "parking seed 3"
  std::string scene;       ///< to simulate; empty: the scans are in a folder
  SuiteOptions simulation; ///< options of pcl_slam6d_simulate
  std::string folder;      ///< with scans, if they are not simulated
  std::string reference;   ///< trajectory file; empty: no errors are measured
  SuiteOptions options;    ///< of pcl_slam6d for these data
  SuiteDamage damage;
  std::string foreign; ///< `base` of the data set that a foreign scan comes from

  /** \return the same without damage */
  SuiteData
  undamaged() const
  {
    SuiteData data = *this;
    data.name = base;
    data.damage = {};
    return data;
  }
};

/** \brief A set of options of pcl_slam6d. */
struct SuiteMethod {
  std::string name;
  SuiteOptions options;
};

/** \brief What a suite file says. */
struct Suite {
  std::filesystem::path file; ///< absolute
  std::string name;           ///< of the file, without its extension
  std::string title;
  std::string description;
  SuiteOptions defaults;
  double time_limit = 3600; ///< [s] of one run
  int repetitions = 1;
  bool keep_scans = false;   ///< keep scans/ and map.pcd of the runs
  bool judges_trust = false; ///< the table tells false verdicts, not errors
  std::vector<SuiteDamage> damages;
  std::vector<SuiteData> data; ///< every entry with every seed and every damage
  std::vector<SuiteMethod> methods;
};

/** \brief Reads a suite; its fields: share/doc/benchmark.md. What options mean is not
 * checked here.
 * \throws UsageError naming file, place (a JSON pointer), value and rule: unreadable, no
 * JSON, a name twice, an unknown field, a value of another kind, nothing to run */
Suite
readSuite(const std::filesystem::path& file);

/** \brief An error of a suite: file, place and what is wrong. */
[[noreturn]] void
refuseSuite(const std::filesystem::path& file,
            const std::string& place,
            const std::string& what);

/** \return one object with the options of both, those of `over` where both have one */
SuiteOptions
overlaid(SuiteOptions options, const SuiteOptions& over);

/** \return the options as words of a command line: `--name=value` or `--name` */
std::vector<std::string>
wordsOf(const SuiteOptions& options);

} // namespace pcl6d::app
