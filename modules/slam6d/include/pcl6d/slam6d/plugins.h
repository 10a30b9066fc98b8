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

/** \brief The parts of one kind added by plug-ins, by name. */
template <typename Part>
class PluginParts {
public:
  /** \return the part, or null if no plug-in has added this name */
  const Part*
  find(const std::string& name) const
  {
    const auto found = parts_.find(name);
    return found == parts_.end() ? nullptr : &found->second;
  }

  /** \return the names in alphabetical order */
  std::vector<std::string>
  names() const
  {
    std::vector<std::string> names;
    for (const auto& part : parts_)
      names.push_back(part.first);
    return names;
  }

  /** \return false if the name exists already */
  bool
  add(const std::string& name, Part part)
  {
    return parts_.emplace(name, std::move(part)).second;
  }

private:
  std::map<std::string, Part> parts_;
};

/** \brief Loads plug-ins, and keeps their parts.
 *
 * A library is loaded only from the given path, without a search, and stays loaded until the
 * process ends. Its code runs with all rights of the process, before any check: load only trusted
 * libraries. Exceptions of parts become ComputeFailed. Returned values are checked: a motion that
 * is not rigid or a point outside the cloud is an error. Messages name the part and the file.
 * \code
 * pcl6d::Plugins plugins;
 * plugins.load("build/libmy_parts.so");
 * options.metric = pcl6d::Metric::kPoint;
 * options.minimiser = *plugins.minimisers().find("mine");
 * \endcode \ingroup slam6d */
class Plugins {
public:
  /** \brief A loaded plug-in. */
  struct Loaded {
    std::filesystem::path file; ///< absolute, without symbolic links
    std::string name;           ///< for people
    std::string adds;           ///< for people: "minimiser mine, reader csv"
    std::uint64_t fingerprint;  ///< of the bytes of the file
  };

  /** \brief Loads a library and adds its parts: either every part, or no part. A file already
   * loaded, even by another path, has no effect.
   * \throws IoFailed naming the file: missing, no shared library, no plug-in, built for another
   * program (ABI), or throwing while adding parts. Exceptions of static objects cannot be caught:
   * std::terminate()
   * \throws BadArgument naming the file: a name exists already, or is invalid */
  void
  load(const std::filesystem::path& file);

  /** \return the plug-ins in the order of loading */
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

  /** The parts of all kinds. */
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
