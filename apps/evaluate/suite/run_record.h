// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/child_process.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief Record of a finished program: the content of run.json. */
struct RunRecord {
  nlohmann::ordered_json inputs; ///< everything that affects the result
  ProcessEnd end;
  double time_limit = 0; ///< [s]
  std::string message;   ///< error message of a failed run

  /** \return whether the run has a result: exit code 0 (done) or 3 (unreliable) */
  bool
  hasResult() const;

  /** \return "reliable", "not reliable", "failed (exit 1)", "timed out" or
   * "killed (signal 9)" */
  std::string
  verdict() const;

  /** \return whether a new run with these inputs would give an equal result; false for
   * a timed-out run if the time limit is now larger */
  bool
  countsFor(const nlohmann::ordered_json& inputs_now, double time_limit_now) const;
};

/** \brief Writes run.json, atomically. \throws IoFailed writing failed */
void
writeRunRecord(const std::filesystem::path& file, const RunRecord& record);

/** \return content of run.json; empty if missing or broken */
std::optional<RunRecord>
readRunRecord(const std::filesystem::path& file);

/** \return the last error line of a log, without the program's name; else the last line */
std::string
errorIn(const std::filesystem::path& log);

/** \return a program of ours, in the folder of this program */
std::filesystem::path
programBeside(const std::string& name);

/** \return version and a hash of the bytes of programs and libraries that affect results */
nlohmann::ordered_json
describePrograms();

/** \return a hash of name, size and time of a file, or of the files in a folder */
std::string
hashOfFiles(const std::filesystem::path& path);

} // namespace pcl6d::app
