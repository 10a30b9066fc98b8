// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_layout.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/sources/bag.h>
#include <pcl6d/sources/coordinate_system.h>
#include <pcl6d/sources/open_source.h>

#include <memory>
#include <proj.h>
#include <string>

namespace pcl6d {

using namespace sources;

namespace {
struct DestroyContext {
  void
  operator()(PJ_CONTEXT* context) const
  {
    proj_context_destroy(context);
  }
};
struct DestroyObject {
  void
  operator()(PJ* object) const
  {
    proj_destroy(object);
  }
};
using Context = std::unique_ptr<PJ_CONTEXT, DestroyContext>;
using Object = std::unique_ptr<PJ, DestroyObject>;

/** \return the projected part of a system; null if missing */
Object
projectedPart(const Context& context, const PJ* system)
{
  Object part(proj_clone(context.get(), system));
  if (part && proj_get_type(part.get()) == PJ_TYPE_COMPOUND_CRS)
    part.reset(proj_crs_get_sub_crs(context.get(), system, 0));
  return part && proj_get_type(part.get()) == PJ_TYPE_PROJECTED_CRS ? std::move(part)
                                                                    : nullptr;
}

bool
isInMetres(const Context& context, const Object& projected)
{
  const Object axes(proj_crs_get_coordinate_system(context.get(), projected.get()));
  double metres = 0;
  return axes &&
         proj_cs_get_axis_info(context.get(),
                               axes.get(),
                               0,
                               nullptr,
                               nullptr,
                               nullptr,
                               &metres,
                               nullptr,
                               nullptr,
                               nullptr) != 0 &&
         metres == 1;
}
} // namespace

std::string
wktOfEpsg(int code)
{
  const Context context(proj_context_create());
  proj_log_level(context.get(), PJ_LOG_NONE); // errors are reported by this function
  const Object system(proj_create_from_database(context.get(),
                                                "EPSG",
                                                std::to_string(code).c_str(),
                                                PJ_CATEGORY_CRS,
                                                0,
                                                nullptr));
  require(system != nullptr, "epsg", code, "a coordinate system of the EPSG registry");
  const Object projected = projectedPart(context, system.get());
  require(projected != nullptr,
          "epsg",
          code,
          std::string("a projected system, but is ") + proj_get_name(system.get()));
  require(isInMetres(context, projected),
          "epsg",
          code,
          std::string("a system in metres, which ") + proj_get_name(system.get()) +
              " is not");
  const char* const one_line[] = {"MULTILINE=NO", nullptr};
  const char* wkt = proj_as_wkt(context.get(), system.get(), PJ_WKT1_GDAL, one_line);
  if (wkt == nullptr)
    wkt = proj_as_wkt(context.get(), system.get(), PJ_WKT2_2019, one_line);
  if (wkt == nullptr)
    throw BadArgument("epsg = " + std::to_string(code) +
                      ", but has no well-known text");
  return wkt;
}

std::string
coordinateSystemOf(const std::filesystem::path& file)
{
  const ScanFormat format = scanFormatOfExtension(file);
  if (format == ScanFormat::kLas || format == ScanFormat::kLaz)
    return coordinateSystemOfLas(file);
  if (!isSourceFile(file) || format != ScanFormat::kAuto || isBag(file))
    return {};
  PageReader pages(file);
  return e57CoordinateSystem(pages);
}

std::string
nameOfWkt(const std::string& wkt)
{
  const std::size_t begin = wkt.find('"');
  const std::size_t end = begin == std::string::npos ? begin : wkt.find('"', begin + 1);
  return end == std::string::npos ? wkt : wkt.substr(begin + 1, end - begin - 1);
}

} // namespace pcl6d
