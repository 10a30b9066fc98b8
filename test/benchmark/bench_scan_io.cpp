// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"
#include "room_cloud.h"
#include "support/temp_folder.h"

#include <pcl6d/io/scan_writer.h>

#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <memory>

namespace pcl6d::benchmarks {

namespace {
namespace fs = std::filesystem;
using Blob = pcl::PCLPointCloud2;

constexpr std::size_t kPoints = 1000000;
constexpr int kDigits = 9; // of a float, so that PCL's text keeps its bits, too

/** \brief A way to store a scan. */
struct Way {
  std::string name;
  ScanFormat format;
  PcdEncoding encoding = PcdEncoding::kBinary;
};
const std::vector<Way> kWays = {
    {"pcd_ascii", ScanFormat::kPcd, PcdEncoding::kAscii},
    {"pcd_binary", ScanFormat::kPcd, PcdEncoding::kBinary},
    {"pcd_compressed", ScanFormat::kPcd, PcdEncoding::kBinaryCompressed},
    {"ply_ascii", ScanFormat::kPly, PcdEncoding::kAscii},
    {"ply_binary", ScanFormat::kPly, PcdEncoding::kBinary},
    {"kitti", ScanFormat::kKitti},
    {"uos", ScanFormat::kUos},
    {"uosr", ScanFormat::kUosr},
    {"xyz", ScanFormat::kXyz},
    {"las", ScanFormat::kLas},
    {"laz", ScanFormat::kLaz},
};

/** \brief A scan in memory and, written by us, as a file. */
struct Data {
  explicit Data(const Way& chosen) : way(chosen)
  {
    const auto points = roomCloud(kPoints, Eigen::Isometry3d::Identity(), 1);
    pcl::PointCloud<pcl::PointXYZI> cloud;
    for (const auto& p : *points) {
      pcl::PointXYZI point;
      point.getVector3fMap() = p.getVector3fMap();
      point.intensity = p.getVector3fMap().norm() / 60;
      cloud.push_back(point);
    }
    pcl::toPCLPointCloud2(cloud, blob);
    write(file);
  }
  void
  write(const fs::path& path) const
  {
    writeScan(path, blob, Eigen::Isometry3d::Identity(), {way.format, way.encoding});
  }
  Way way;
  test::TempFolder folder;
  fs::path file = folder / "scan";
  fs::path other = folder / "other";
  Blob blob;
  Blob ours, theirs; ///< as read
};

void
writeByPcl(const Data& data, const fs::path& path)
{
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
  if (data.way.format == ScanFormat::kPly) {
    pcl::PLYWriter writer;
    data.way.encoding == PcdEncoding::kAscii
        ? writer.writeASCII(path, data.blob, origin, turn, kDigits, false)
        : writer.writeBinary(path, data.blob, origin, turn, false);
    return;
  }
  pcl::PCDWriter writer;
  if (data.way.encoding == PcdEncoding::kAscii)
    writer.writeASCII(path, data.blob, origin, turn, kDigits);
  else if (data.way.encoding == PcdEncoding::kBinary)
    writer.writeBinary(path, data.blob, origin, turn);
  else
    writer.writeBinaryCompressed(path, data.blob, origin, turn);
}

void
readByPcl(const Data& data, const fs::path& path, Blob& blob)
{
  if (data.way.format == ScanFormat::kPly)
    pcl::PLYReader().read(path, blob);
  else
    pcl::PCDReader().read(path, blob);
}

/** The fields lie at other places, but their values are the same. */
void
checkSamePoints(benchmark::State& state, const Blob& a, const Blob& b)
{
  pcl::PointCloud<pcl::PointXYZI> cloud_a, cloud_b;
  pcl::fromPCLPointCloud2(a, cloud_a);
  pcl::fromPCLPointCloud2(b, cloud_b);
  bool same = cloud_a.size() == cloud_b.size() && !cloud_a.empty();
  for (std::size_t i = 0; same && i < cloud_a.size(); ++i)
    same = cloud_a[i].getVector3fMap() == cloud_b[i].getVector3fMap() &&
           cloud_a[i].intensity == cloud_b[i].intensity;
  if (!same)
    state.SkipWithError("the points differ");
}

PeerJob
readJob(const Way& way)
{
  const auto data = std::make_shared<Data>(way);
  return {[=] { data->ours = readScanCloud(data->file, way.format).cloud; },
          [=] { readByPcl(*data, data->file, data->theirs); },
          [=](benchmark::State& state) {
            state.counters["megabytes"] =
                static_cast<double>(fs::file_size(data->file)) / 1e6;
            checkSamePoints(state, data->ours, data->theirs);
          }};
}

PeerJob
writeJob(const Way& way)
{
  const auto data = std::make_shared<Data>(way);
  return {[=] { data->write(data->file); },
          [=] { writeByPcl(*data, data->other); },
          [=](benchmark::State& state) {
            Blob written;
            readByPcl(*data, data->other, written);
            checkSamePoints(
                state, readScanCloud(data->file, way.format).cloud, written);
          }};
}

void
readOurs(benchmark::State& state, const Way& way)
{
  const Data data(way);
  for (auto _ : state)
    benchmark::DoNotOptimize(readScanCloud(data.file, way.format).cloud.data.data());
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(fs::file_size(data.file)));
}

void
writeOurs(benchmark::State& state, const Way& way)
{
  const Data data(way);
  for (auto _ : state)
    data.write(data.file);
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(fs::file_size(data.file)));
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const std::string size = "/" + std::to_string(kPoints);
  for (const Way& way : kWays) {
    benchmark::RegisterBenchmark(
        ("speed_read_" + way.name + size).c_str(), readOurs, way)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(
        ("speed_write_" + way.name + size).c_str(), writeOurs, way)
        ->Unit(benchmark::kMillisecond);
    const bool ply = way.format == pcl6d::ScanFormat::kPly;
    if (!ply && way.format != pcl6d::ScanFormat::kPcd)
      continue;
    const std::string reader = ply ? "pcl::PLYReader" : "pcl::PCDReader";
    const std::string writer = ply ? "pcl::PLYWriter" : "pcl::PCDWriter";
    addPeerCase(
        {"read_" + way.name + size, reader, 1, 7, [=] { return readJob(way); }});
    if (way.name != "ply_ascii") // pcl::PLYWriter keeps 6 digits, whatever is asked for
      addPeerCase(
          {"write_" + way.name + size, writer, 1, 7, [=] { return writeJob(way); }});
  }
  return runPeerCases(argc, argv);
}
