// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/plugin_adder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>
#include <pcl6d/io/text.h>
#include <pcl6d/slam6d/plugins.h>

#include <algorithm>
#include <dlfcn.h>
#include <string_view>

namespace pcl6d {

namespace fs = std::filesystem;

namespace {
constexpr char kSymbol[] = "pcl6d_plugin";

/** \return the first two numbers of a version; a text without numbers unchanged */
std::string_view
upToMinor(std::string_view version)
{
  const std::size_t dot = version.find('.');
  return dot == std::string_view::npos ? version
                                       : version.substr(0, version.find('.', dot + 1));
}

std::string
valueOf(const PluginFact& fact)
{
  return *fact.text != '\0' ? fact.text : std::to_string(fact.number);
}

/** \return the differences between plug-in and program; "" if compatible */
std::string
differencesOf(const Plugin& plugin)
{
  if (plugin.abi != kPluginAbi)
    return "plug-in interface " + std::to_string(plugin.abi) + " (here " +
           std::to_string(kPluginAbi) + ")";
  std::string differences;
  const std::uint32_t count = std::min(plugin.num_facts, kNumPluginFacts);
  for (std::uint32_t i = 0; i < count; ++i) {
    const PluginFact &theirs = plugin.facts[i], &here = kPluginFacts[i];
    if (upToMinor(theirs.text) != upToMinor(here.text) || theirs.number != here.number)
      differences += (differences.empty() ? "" : ", ") + std::string(here.what) + ' ' +
                     valueOf(theirs) + " (here " + valueOf(here) + ")";
  }
  if (differences.empty() && plugin.num_facts != kNumPluginFacts)
    return "number of facts " + std::to_string(plugin.num_facts) + " (here " +
           std::to_string(kNumPluginFacts) + ")";
  if (!differences.empty() && plugin.compiler)
    differences += "; made by compiler " + std::string(plugin.compiler);
  return differences;
}

std::uint64_t
fingerprintOf(const std::string& bytes)
{
  Fingerprint sum;
  for (const char c : bytes)
    sum.add(static_cast<std::uint32_t>(static_cast<unsigned char>(c)));
  return sum.value();
}

/** \return the reason given by dlopen() or dlsym(), without a leading path */
std::string
loaderSays(const fs::path& file)
{
  const char* said = ::dlerror();
  std::string reason = said ? said : "unknown reason";
  const std::string path = file.string() + ": ";
  return reason.rfind(path, 0) == 0 ? reason.substr(path.size()) : reason;
}

/** Opens a library permanently: its code may run until the process ends.
 * \return the exported plug-in */
const Plugin&
open(const fs::path& file)
{
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!library)
    text::fail(file, "cannot be loaded as a shared library: " + loaderSays(file));
  const void* symbol = ::dlsym(library, kSymbol);
  if (!symbol)
    text::fail(file,
               std::string("is no plug-in of pcl6d: no symbol ") + kSymbol +
                   " (see PCL6D_PLUGIN in pcl6d/slam6d/plugin.h)");
  const auto& plugin = *static_cast<const Plugin*>(symbol);
  const std::string differences = differencesOf(plugin);
  if (!differences.empty())
    text::fail(file,
               "was made for another program: " + differences +
                   "; build the plug-in anew with the headers, libraries and flags of "
                   "this program");
  if (!plugin.add || !plugin.name)
    text::fail(file, "shows a plug-in without name or function");
  return plugin;
}
} // namespace

void
Plugins::load(const fs::path& file)
{
  std::error_code error;
  const fs::path path = fs::canonical(file, error);
  if (error)
    text::fail(file, error.message());
  const auto is_this = [&](const Loaded& one) { return one.file == path; };
  if (std::any_of(loaded_.begin(), loaded_.end(), is_this))
    return;
  if (!fs::is_regular_file(path))
    text::fail(file, "is no file");
  const std::uint64_t fingerprint = fingerprintOf(text::readFile(path));
  const Plugin& plugin = open(path);
  slam6d::PluginAdder adder(path, parts_);
  try {
    plugin.add(adder);
  } catch (const BadArgument& e) { // of the registry, most likely
    throw BadArgument(path.string() + ": " + e.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    text::fail(path, std::string("throws while adding parts: ") + e.what());
  } catch (...) {
    text::fail(path, "throws while adding parts");
  }
  parts_ = adder.parts();
  loaded_.push_back({path, plugin.name, adder.description(), fingerprint});
}

} // namespace pcl6d
