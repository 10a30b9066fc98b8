// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/registration/plane_minimiser.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/pcl_config.h>

#include <cstdint>
#include <functional>
#include <string>

/** \file
 * What a plug-in of pcl_slam6d includes (share/doc/plugins.md). It is a shared library that
 * adds parts under words of the command line:
 * \code
 * void
 * addParts(pcl6d::PluginRegistry& registry)
 * {
 *   registry.addMinimiser("mine", minimise); // then: --minimiser mine
 * }
 * PCL6D_PLUGIN("my parts", addParts)
 * \endcode */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves out or moves points of a scan: takes the cloud in the scanner's frame [m]
 * and returns what is to be registered and written; any filter of PCL that works on
 * pcl::PCLPointCloud2 fits. Several threads may call it at once, for several scans. */
using ScanFilter = std::function<pcl::PCLPointCloud2(const pcl::PCLPointCloud2&)>;

/** \brief Where a plug-in puts its parts.
 *
 * Names are words of small letters, digits and dashes that begin with a letter, and no words
 * that the option has already. All functions must return the same for the same input,
 * whatever thread calls them: the suite promises the same bits for any number of threads.
 * What they throw ends the run with the plug-in's name in the message.
 * \throws BadArgument by all: the name is no such word or is taken, or there is no function */
class PluginRegistry {
public:
  /** \brief `--minimiser NAME`: the step from the sums of matched points to the motion. */
  virtual void
  addMinimiser(const std::string& name, RigidMinimiser step) = 0;

  /** \brief `--plane-minimiser NAME`: the same of points and planes. */
  virtual void
  addPlaneMinimiser(const std::string& name, PlaneMinimiser step) = 0;

  /** \brief `--search NAME`: how the nearest points are found. What it finds is checked. */
  virtual void
  addSearch(const std::string& name, SearchMaker search) = 0;

  /** \brief `--filter NAME`: what each scan goes through when it is read. */
  virtual void
  addFilter(const std::string& name, ScanFilter filter) = 0;

  /** \brief `--format NAME`: a reader of scans. \param[in] extension of their files, with the
   * dot; it may be one that other formats have */
  virtual void
  addReader(const std::string& name,
            const std::string& extension,
            ScanReader reader) = 0;

protected:
  ~PluginRegistry() = default;
};

/** \brief Something in which a plug-in and the program that loads it must agree. */
struct PluginFact {
  const char* what;
  const char* text;     ///< of versions, the first two numbers count
  std::uint64_t number; ///< a size [bytes] or a setting
};

/** The number of this interface; a change that old plug-ins do not survive adds one. */
constexpr std::uint32_t kPluginAbi = 1;

/** \brief What a plug-in shows as the symbol `pcl6d_plugin`. The first member stays where it
 * is whatever the number; the others may be read if the number is that of the program. */
struct Plugin {
  std::uint32_t abi;
  std::uint32_t num_facts;
  const PluginFact* facts;
  const char* compiler; ///< for people
  const char* name;     ///< for people
  void (*add)(PluginRegistry&);
};

#define PCL6D_TEXT_(number) #number
#define PCL6D_VERSION_TEXT_(a, b, c)                                                   \
  PCL6D_TEXT_(a) "." PCL6D_TEXT_(b) "." PCL6D_TEXT_(c)
#ifdef _LIBCPP_VERSION
#define PCL6D_CXX_LIBRARY_ "libc++"
#define PCL6D_CXX_STRINGS_ 0
#define PCL6D_CXX_DEBUG_ 0
#else
#define PCL6D_CXX_LIBRARY_ "libstdc++"
#define PCL6D_CXX_STRINGS_ _GLIBCXX_USE_CXX11_ABI
#ifdef _GLIBCXX_DEBUG
#define PCL6D_CXX_DEBUG_ 1
#else
#define PCL6D_CXX_DEBUG_ 0
#endif
#endif

/** Of the file that includes this: static, lest a plug-in shows the program its own. */
static constexpr PluginFact kPluginFacts[] = {
    {"version of pcl6d", PCL6D_VERSION, 0},
    {"version of PCL", PCL_VERSION_PRETTY, 0},
    {"version of Eigen",
     PCL6D_VERSION_TEXT_(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION),
     0},
    {"C++ library", PCL6D_CXX_LIBRARY_, 0},
    {"_GLIBCXX_USE_CXX11_ABI", "", PCL6D_CXX_STRINGS_},
    {"_GLIBCXX_DEBUG", "", PCL6D_CXX_DEBUG_},
    {"alignment of Eigen (-march, EIGEN_MAX_ALIGN_BYTES)", "", EIGEN_MAX_ALIGN_BYTES},
    {"size of a pointer", "", sizeof(void*)},
    {"size of pcl::index_t", "", sizeof(pcl::index_t)},
    {"size of pcl::PCLPointCloud2", "", sizeof(pcl::PCLPointCloud2)},
    {"size of pcl6d::PairSums", "", sizeof(PairSums)},
    {"size of pcl6d::PlaneSums", "", sizeof(PlaneSums)},
    {"size of pcl6d::RigidEstimate", "", sizeof(RigidEstimate)},
    {"size of pcl6d::Neighbour", "", sizeof(Neighbour)},
    {"size of pcl6d::Points", "", sizeof(Points)}};

static constexpr std::uint32_t kNumPluginFacts =
    sizeof(kPluginFacts) / sizeof(kPluginFacts[0]);

/** Shows a function of type void (pcl6d::PluginRegistry&) as the plug-in of this library; once,
 * outside all namespaces. `name` is text for people. */
#define PCL6D_PLUGIN(name, add)                                                        \
  extern "C" [[gnu::visibility("default")]] const pcl6d::Plugin pcl6d_plugin;          \
  extern "C" [[gnu::visibility("default")]] const pcl6d::Plugin pcl6d_plugin = {       \
      pcl6d::kPluginAbi,                                                               \
      pcl6d::kNumPluginFacts,                                                          \
      pcl6d::kPluginFacts,                                                             \
      __VERSION__,                                                                     \
      name,                                                                            \
      add};

} // namespace pcl6d
