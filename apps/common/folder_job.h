// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app.h"
#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"

#include <pcl6d/common/error.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief What a verb works with that fills a folder: signals are watched, the folder is
 * claimed, nothing is in its place before publish(). */
struct FolderJob {
  /** \param[in] warning shown first; empty: none
   * \param[in] rules of the folder; one without a name: there is none
   * \throws IoFailed as OutputFolder */
  FolderJob(bool is_quiet, const std::string& warning, OutputRules rules)
  : quiet(is_quiet), bar(is_quiet)
  {
    if (!warning.empty())
      bar.warn(warning);
    if (!rules.folder.empty())
      out.emplace(std::move(rules));
  }

  /** \brief Moves the files to their places, and prints their names after what is told
   * before, unless quiet. */
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

  /** \brief Draws into the folder when all else is in its place: what draws may end the
   * process. Prints the name, unless quiet.
   * \return false: there should be a picture, and is none; the reason was told */
  bool
  draw(const std::string& name,
       const std::function<void(const std::filesystem::path&)>& drawing)
  {
    const auto picture = out->folder() / name;
    try {
      drawing(picture);
    } catch (const BadArgument& e) { // there is nothing that could be seen
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
