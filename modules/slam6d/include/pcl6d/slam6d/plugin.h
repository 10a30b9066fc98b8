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
 * Interface for plug-ins of pcl_slam6d (share/doc/plugins.md). A plug-in is a shared library that
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

/** \brief Removes or moves points of a scan: takes the cloud in the scanner's frame [m] and returns
 * the cloud to be registered and written. Every PCL filter on pcl::PCLPointCloud2 fits. Called
 * concurrently for several scans. */
using ScanFilter = std::function<pcl::PCLPointCloud2(const pcl::PCLPointCloud2&)>;

/** \brief Receives the parts of a plug-in.
 *
 * Names are words of small letters, digits and dashes, begin with a letter, and differ from the
 * existing words of the option. All functions must return equal results for equal input in every
 * thread: the suite promises the same bits for any number of threads. An exception from a part
 * ends the run with the plug-in's name in the message.
 * \throws BadArgument by all functions: invalid or existing name, or null function */
class PluginRegistry {
public:
  /** \brief `--minimiser NAME`: the step from the sums of matched points to the motion. */
  virtual void
  addMinimiser(const std::string& name, RigidMinimiser step) = 0;

  /** \brief `--plane-minimiser NAME`: the step for pairs of points and planes. */
  virtual void
  addPlaneMinimiser(const std::string& name, PlaneMinimiser step) = 0;

  /** \brief `--search NAME`: the search for nearest points. The found points are checked. */
  virtual void
  addSearch(const std::string& name, SearchMaker search) = 0;

  /** \brief `--filter NAME`: a filter of each scan when read. */
  virtual void
  addFilter(const std::string& name, ScanFilter filter) = 0;

  /** \brief `--format NAME`: a reader of scans. \param[in] extension of the files, with the dot;
   * may equal the extension of another format */
  virtual void
  addReader(const std::string& name,
            const std::string& extension,
            ScanReader reader) = 0;

protected:
  ~PluginRegistry() = default;
};

/** \brief A property that must be equal in a plug-in and in the program. */
struct PluginFact {
  const char* what;
  const char* text;     ///< of versions, the first two numbers count
  std::uint64_t number; ///< a size [bytes] or a setting
};

/** Version of this interface; incremented by each change that breaks compiled plug-ins. */
constexpr std::uint32_t kPluginAbi = 1;

/** \brief The exported symbol `pcl6d_plugin`. The position of the first member is the same in all
 * versions; the members after it are valid only if abi equals the program's. */
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

/** Properties of the including file. Static, to keep a plug-in from exporting the program's
 * copy. */
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

/** Exports a function of type void (pcl6d::PluginRegistry&) as the plug-in of this library. To be
 * used once, outside all namespaces. `name` is text for people. */
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
