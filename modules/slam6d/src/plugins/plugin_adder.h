// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/plugins.h>

#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** The registry passed to a plug-in. Adds each part with a guard to the parts added before. */
class PluginAdder : public PluginRegistry {
public:
  /** \param[in] file of the plug-in \param[in] before parts added by other plug-ins */
  PluginAdder(const std::filesystem::path& file, const Plugins::Parts& before)
  : file_(file), parts_(before)
  {}
  virtual ~PluginAdder() = default;

  void
  addMinimiser(const std::string& name, RigidMinimiser step) override;
  void
  addPlaneMinimiser(const std::string& name, PlaneMinimiser step) override;
  void
  addSearch(const std::string& name, SearchMaker search) override;
  void
  addFilter(const std::string& name, ScanFilter filter) override;
  void
  addReader(const std::string& name,
            const std::string& extension,
            ScanReader reader) override;

  /** \return all parts, including the parts added before */
  const Plugins::Parts&
  parts() const
  {
    return parts_;
  }

  /** \return "minimiser mine, reader csv"; "nothing" */
  std::string
  description() const
  {
    return description_.empty() ? "nothing" : description_;
  }

private:
  template <typename Part>
  void
  add(const std::string& kind,
      const std::string& name,
      const std::vector<std::string>& own_names,
      Part part,
      PluginParts<Part>& parts);
  std::string
  who(const std::string& kind, const std::string& name) const;

  std::filesystem::path file_;
  Plugins::Parts parts_;
  std::string description_;
};

} // namespace pcl6d::slam6d
