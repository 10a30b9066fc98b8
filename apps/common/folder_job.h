// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"

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

  bool quiet;
  Interrupt interrupt;
  ProgressBar bar;
  std::optional<OutputFolder> out;
};

} // namespace pcl6d::app
