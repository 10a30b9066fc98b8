// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/maps/height_map.h>

#ifdef PCL6D_WITH_GDAL
#include <array>
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <limits>
#include <memory>
#endif

namespace pcl6d {

#ifdef PCL6D_WITH_GDAL
namespace {
/** \brief Suppresses GDAL's messages, except in exceptions, until the end of the scope. */
class SilentGdal {
public:
  SilentGdal()
  {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~SilentGdal() { CPLPopErrorHandler(); }
  SilentGdal(const SilentGdal&) = delete;
  SilentGdal&
  operator=(const SilentGdal&) = delete;
};

struct CloseDataset {
  void
  operator()(void* dataset) const
  {
    GDALClose(dataset);
  }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

void
requireGdal(bool kept, const std::filesystem::path& path)
{
  if (kept && CPLGetLastErrorType() < CE_Failure)
    return;
  const std::string reason = CPLGetLastErrorMsg();
  text::fail(path, "cannot be written: " + (reason.empty() ? "GDAL failed" : reason));
}

/** The names of the bands, in their order. */
constexpr std::array<const char*, 3> kBands = {"lowest", "highest", "mean"};

float
heightOf(const HeightMap::Cell& cell, std::size_t band, double offset)
{
  if (cell.points == 0)
    return std::numeric_limits<float>::quiet_NaN();
  const double height = band == 0   ? cell.lowest
                        : band == 1 ? cell.highest
                                    : cell.sum / static_cast<double>(cell.points);
  return static_cast<float>(height + offset);
}

bool
writeBand(GDALRasterBandH band, const HeightMap& map, std::size_t number, double offset)
{
  GDALSetDescription(band, kBands[number]);
  bool is_written = GDALSetRasterNoDataValue(
                        band, std::numeric_limits<double>::quiet_NaN()) == CE_None;
  const auto columns = static_cast<int>(map.raster().columns);
  const auto rows = static_cast<int>(map.raster().rows);
  std::vector<float> line(map.raster().columns);
  for (int row = 0; row < rows && is_written; ++row) {
    const std::size_t first = static_cast<std::size_t>(rows - 1 - row) * line.size();
    for (std::size_t i = 0; i < line.size(); ++i)
      line[i] = heightOf(map.cell(first + i), number, offset);
    is_written = GDALRasterIO(band,
                              GF_Write,
                              0,
                              row,
                              columns,
                              1,
                              line.data(),
                              columns,
                              1,
                              GDT_Float32,
                              0,
                              0) == CE_None;
  }
  return is_written;
}

void
writeDataset(const std::filesystem::path& path,
             const std::filesystem::path& shown,
             const HeightMap& map,
             const Eigen::Vector3d& offset,
             const std::string& coordinate_system)
{
  const SilentGdal silent;
  GDALRegister_GTiff();
  const MapRaster& raster = map.raster();
  char* options[] = {const_cast<char*>("COMPRESS=DEFLATE"),
                     const_cast<char*>("BIGTIFF=IF_SAFER"),
                     nullptr};
  Dataset dataset(GDALCreate(GDALGetDriverByName("GTiff"),
                             path.c_str(),
                             static_cast<int>(raster.columns),
                             static_cast<int>(raster.rows),
                             kBands.size(),
                             GDT_Float32,
                             options));
  requireGdal(dataset != nullptr, shown);
  double transform[6] = {raster.corner.x() + offset.x(),
                         raster.resolution,
                         0,
                         raster.corner.y() + offset.y() +
                             static_cast<double>(raster.rows) * raster.resolution,
                         0,
                         -raster.resolution};
  requireGdal(GDALSetGeoTransform(dataset.get(), transform) == CE_None, shown);
  if (!coordinate_system.empty())
    requireGdal(GDALSetProjection(dataset.get(), coordinate_system.c_str()) == CE_None,
                shown);
  for (std::size_t i = 0; i < kBands.size(); ++i)
    requireGdal(writeBand(GDALGetRasterBand(dataset.get(), static_cast<int>(i) + 1),
                          map,
                          i,
                          offset.z()),
                shown);
  dataset.reset(); // the last rows may fail to arrive
  requireGdal(true, shown);
}
} // namespace

bool
canWriteGeoTiff()
{
  return true;
}

void
writeGeoTiff(const std::filesystem::path& path,
             const HeightMap& map,
             const Eigen::Vector3d& offset,
             const std::string& coordinate_system)
{
  writeFileAtomicallyBy(path, [&](const std::filesystem::path& place) {
    writeDataset(place, path, map, offset, coordinate_system);
  });
}
#else
bool
canWriteGeoTiff()
{
  return false;
}

void
writeGeoTiff(const std::filesystem::path& path,
             const HeightMap& /*map*/,
             const Eigen::Vector3d& /*offset*/,
             const std::string& /*coordinate_system*/)
{
  throw ComputeFailed(path.string() +
                      ": GeoTIFF needs GDAL, but the program was built without GDAL; "
                      "install libgdal-dev and build the program again");
}
#endif

} // namespace pcl6d
