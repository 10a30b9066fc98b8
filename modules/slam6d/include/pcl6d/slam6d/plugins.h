// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/slam6d/plugin.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The parts of one kind that plug-ins have added, by their words. */
template <typename Part>
class PluginParts {
public:
  /** \return the part, or null if no plug-in has added one of this name */
  const Part*
  find(const std::string& name) const
  {
    const auto found = parts_.find(name);
    return found == parts_.end() ? nullptr : &found->second;
  }

  /** \return all words, in alphabetical order */
  std::vector<std::string>
  names() const
  {
    std::vector<std::string> names;
    for (const auto& part : parts_)
      names.push_back(part.first);
    return names;
  }

  /** \return false if there is such a name already */
  bool
  add(const std::string& name, Part part)
  {
    return parts_.emplace(name, std::move(part)).second;
  }

private:
  std::map<std::string, Part> parts_;
};

/** \brief Loads plug-ins, and holds what they add.
 *
 * A library is loaded from the path that is given alone, never looked for, and stays until
 * the process ends. Its code then runs with all rights of the process, from before it can be
 * checked: load what you trust. What its parts throw comes out as ComputeFailed, and what they
 * return is checked: a motion that is not rigid and a point that does not exist are errors
 * as well. Messages name the part and the file.
 * \code
 * pcl6d::Plugins plugins;
 * plugins.load("build/libmy_parts.so");
 * options.metric = pcl6d::Metric::kPoint;
 * options.minimiser = *plugins.minimisers().find("mine");
 * \endcode \ingroup slam6d */
class Plugins {
public:
  /** \brief A plug-in that is there. */
  struct Loaded {
    std::filesystem::path file; ///< absolute, without symbolic links
    std::string name;           ///< for people
    std::string adds;           ///< for people: "minimiser mine, reader csv"
    std::uint64_t fingerprint;  ///< of the bytes of the file
  };

  /** \brief Loads a library and takes in its parts: all of them, or none. A file that is
   * there already, under whatever path, changes nothing.
   * \throws IoFailed naming the file: it is missing, no shared library, no plug-in, made for
   * another program (ABI), or throws while it adds its parts. What its static objects throw
   * cannot be caught: std::terminate()
   * \throws BadArgument naming the file: one of its names is taken, or no word */
  void
  load(const std::filesystem::path& file);

  /** \return in the order in which they were loaded */
  const std::vector<Loaded>&
  loaded() const
  {
    return loaded_;
  }

  const PluginParts<RigidMinimiser>&
  minimisers() const
  {
    return parts_.minimisers;
  }
  const PluginParts<PlaneMinimiser>&
  planeMinimisers() const
  {
    return parts_.plane_minimisers;
  }
  const PluginParts<SearchMaker>&
  searches() const
  {
    return parts_.searches;
  }
  const PluginParts<ScanFilter>&
  filters() const
  {
    return parts_.filters;
  }
  const PluginParts<std::shared_ptr<const OtherScanFormat>>&
  formats() const
  {
    return parts_.formats;
  }

  /** All parts, of whatever kind. */
  struct Parts {
    PluginParts<RigidMinimiser> minimisers;
    PluginParts<PlaneMinimiser> plane_minimisers;
    PluginParts<SearchMaker> searches;
    PluginParts<ScanFilter> filters;
    PluginParts<std::shared_ptr<const OtherScanFormat>> formats;
  };

private:
  Parts parts_;
  std::vector<Loaded> loaded_;
};

} // namespace pcl6d
