// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app.h"
#include "common/output/output_folder.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"

#include <pcl6d/common/error.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Working state of a verb that fills a folder: watches signals and claims the
 * folder. No file reaches its final path before publish(). */
struct FolderJob {
  /** \param[in] warning shown first; may be empty
   * \param[in] rules of the folder; an empty folder name: no output folder
   * \throws IoFailed as OutputFolder */
  FolderJob(bool is_quiet, const std::string& warning, OutputRules rules)
  : quiet(is_quiet), bar(is_quiet)
  {
    if (!warning.empty())
      bar.warn(warning);
    if (!rules.folder.empty())
      out.emplace(std::move(rules));
  }

  /** \brief Publishes the files, calls tell, and then prints the names of the files
   * unless quiet. */
  void
  publish(const std::function<void()>& tell = [] {})
  {
    const auto written = out->publish();
    if (quiet)
      return;
    tell();
    for (const auto& path : written)
      std::cout << "  " << path.string() << '\n';
    std::cout << std::flush;
  }

  /** \brief Draws a picture into the published folder: publishing goes first, as
   * drawing may end the process. Prints the name, unless quiet.
   * \return false: the picture failed; a warning has told the reason */
  bool
  draw(const std::string& name,
       const std::function<void(const std::filesystem::path&)>& drawing)
  {
    const auto picture = out->folder() / name;
    try {
      drawing(picture);
    } catch (const BadArgument& e) { // the map has no visible points
      bar.warn("no " + name + ": " + e.what());
      return true;
    } catch (...) {
      bar.warn("no " + name + ": " + wordsOfCurrent());
      return false;
    }
    if (!quiet)
      std::cout << "  " << picture.string() << std::endl;
    return true;
  }

  bool quiet;
  Interrupt interrupt;
  ProgressBar bar;
  std::optional<OutputFolder> out;
};

} // namespace pcl6d::app
