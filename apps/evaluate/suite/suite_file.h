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
 * true for an option without a value. Later values replace earlier values; false and
 * null remove an option. */
using SuiteOptions = nlohmann::ordered_json;

/** \brief Damage of scans and their initial poses before a run, to test whether the run
 * detects the damage. Indices count scans of the folder. */
struct SuiteDamage {
  /** \brief The odometry leaps. */
  struct Jump {
    std::size_t scan = 0; ///< first scan behind the jump
    double metres = 0;    ///< forward, along x of the scan before
  };

  std::string name;            ///< empty: nothing is done
  SuiteOptions options;        ///< of pcl_slam6d
  nlohmann::ordered_json text; ///< remaining fields, unchanged
  double odometry_noise = 1;   ///< factor of the error of each step
  double odometry_scale = 1; ///< factor of every position, as for feet taken as metres
  double turn = 0;           ///< [deg] of each scan's axes about z, against its pose
  std::optional<Jump> jump;
  bool no_poses = false;
  std::optional<std::pair<std::size_t, std::size_t>> swap; ///< scans to swap
  /** a scan to replace by the scan of equal index in the next data set */
  std::optional<std::size_t> foreign;
  std::optional<std::size_t> points; ///< number of points kept of a scan, evenly chosen
  std::vector<std::pair<std::size_t, std::size_t>> links; ///< given to pcl_slam6d

  bool
  changesPoses() const
  {
    return odometry_noise != 1 || odometry_scale != 1 || turn != 0 || jump;
  }
  /** \return whether the damage changes files */
  bool
  changesFiles() const
  {
    return changesPoses() || no_poses || swap || foreign || points || !links.empty();
  }
};

/** \brief Scans for every method. */
struct SuiteData {
  std::string name;        ///< "parking seed 3, scans swapped"
  std::string entry;       ///< name of the entry in the file: "parking"
  std::string base;        ///< name without damage: "parking seed 3"
  std::string scene;       ///< to simulate; empty: the scans are in a folder
  SuiteOptions simulation; ///< options of pcl_slam6d_simulate
  std::string folder;      ///< folder of scans, if not simulated
  std::string reference;   ///< trajectory file; empty: no errors are measured
  SuiteOptions options;    ///< of pcl_slam6d for these data
  SuiteDamage damage;
  std::string foreign; ///< `base` of the data set that provides the foreign scan

  /** \return the data set without damage */
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

/** \brief Content of a suite file. */
struct Suite {
  std::filesystem::path file; ///< absolute
  std::string name;           ///< name of the file, without its extension
  std::string title;
  std::string description;
  SuiteOptions defaults;
  double time_limit = 3600; ///< [s] of one run
  int repetitions = 1;
  bool keep_scans = false;      ///< keep scans/ and map.pcd of the runs
  bool evaluates_trust = false; ///< the table tells false verdicts, not errors
  std::vector<SuiteDamage> damages;
  std::vector<SuiteData> data; ///< every entry with every seed and every damage
  std::vector<SuiteMethod> methods;
};

/** \brief Reads a suite; its fields: share/doc/benchmark.md. The meaning of options is
 * not checked here.
 * \throws UsageError naming file, position (a JSON pointer), value and rule: unreadable,
 * no JSON, a duplicate name, an unknown field, a value of another type, an empty suite */
Suite
readSuite(const std::filesystem::path& file);

/** \brief Throws an error of a suite: file, position and fault. */
[[noreturn]] void
refuseSuite(const std::filesystem::path& file,
            const std::string& place,
            const std::string& what);

/** \return the union of both objects; values of `over` take precedence */
SuiteOptions
overlaid(SuiteOptions options, const SuiteOptions& over);

/** \return the options as words of a command line: `--name=value` or `--name` */
std::vector<std::string>
wordsOf(const SuiteOptions& options);

} // namespace pcl6d::app
