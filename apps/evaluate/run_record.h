// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/child_process.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief What is known of a program that has ended: the content of run.json. */
struct RunRecord {
  nlohmann::ordered_json inputs; ///< all that its result depends on
  ProcessEnd end;
  double time_limit = 0; ///< [s]
  std::string message;   ///< its error, if it failed

  /** \return whether it left a result: exit code 0 (done) or 3 (not to be trusted) */
  bool
  hasResult() const;

  /** \return "trusted", "not trusted", "failed (exit 1)", "timed out" or
   * "killed (signal 9)" */
  std::string
  verdict() const;

  /** \return whether running again, with these inputs, would give the same: a run whose
   * time was over may have more of it now */
  bool
  countsFor(const nlohmann::ordered_json& inputs_now, double time_limit_now) const;
};

/** \brief Writes run.json, atomically. \throws IoFailed it cannot be written */
void
writeRunRecord(const std::filesystem::path& file, const RunRecord& record);

/** \return what run.json holds; nothing if it is missing or broken */
std::optional<RunRecord>
readRunRecord(const std::filesystem::path& file);

/** \return the last line of a log that tells an error, without the program's name; else
 * the last line */
std::string
errorIn(const std::filesystem::path& log);

/** \return a program of ours, which lies beside this one */
std::filesystem::path
programBeside(const std::string& name);

/** \return version and a hash of the bytes of programs and libraries that results depend
 * on */
nlohmann::ordered_json
describePrograms();

/** \return a hash of name, size and time of a file, or of all files in a folder */
std::string
hashOfFiles(const std::filesystem::path& path);

} // namespace pcl6d::app
