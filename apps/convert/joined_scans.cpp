// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/options/option_table.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "convert/joined_layout.h"
#include "convert/loss_tally.h"
#include "convert/scan_jobs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/vector_field.h>

#include <algorithm>
#include <iostream>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr std::size_t kBlock = 1 << 16; // joined points kept in memory

struct Stopped {}; ///< thrown after a signal

/** \brief Joins the scans of a folder, with one scan in memory at a time. */
class JoinedScans {
public:
  explicit JoinedScans(const ScanSettings& settings)
  : settings_(settings)
  , source_(openScans(settings.input, settings.folder))
  , bar_(settings.quiet)
  {
    for (std::size_t i = 0; i < source_.folder().size(); ++i)
      refuseInputs(settings_.output, {source_.folder().file(i).string()});
    refuseInputs(settings.output, {settings.folder.poses_file.string()});
  }

  int
  run()
  try {
    if (!settings_.without_effect.empty())
      bar_.warn(settings_.without_effect);
    survey();
    ScanShape shape;
    shape.fields = layout_.fields();
    shape.point_step = layout_.pointStep();
    shape.width = points_;
    if (isLas()) // has room for every digit
      shape.T_world_scan.translation() = source_.worldOffset();
    const auto losses = writeScanBlocks(settings_.output,
                                        shape,
                                        settings_.writer,
                                        [&](const ScanSink& sink) { handOver(sink); });
    describe(losses);
    const int code = losses_.evaluate(bar_);
    if (code != kDone || points_ > 0)
      return code;
    bar_.warn("no point is within the ranges of the run");
    return kDoubtful;
  } catch (const Stopped&) {
    return kInterrupted;
  }

private:
  bool
  isLas() const
  {
    return settings_.writer.format == ScanFormat::kLas ||
           settings_.writer.format == ScanFormat::kLaz;
  }

  void
  advance(const char* stage, std::size_t i)
  {
    bar_.show({stage, i + 1, source_.folder().size()});
    if (interrupt_.requested())
      throw Stopped();
  }

  /** \return per point whether the run classified the point as part of a surface */
  std::vector<bool>
  surfacesOf(const pcl::PCLPointCloud2& scan) const
  {
    const VectorField place(scan.fields, {"x", "y", "z"});
    std::vector<bool> kept(std::size_t{scan.width} * scan.height);
    for (std::size_t i = 0; i < kept.size(); ++i)
      kept[i] = isWithinRange(place.read(&scan.data[i * scan.point_step]).cast<float>(),
                              source_.minRange(),
                              source_.maxRange());
    return kept;
  }

  /** The first pass: collects the data for the header of the file. */
  void
  survey()
  {
    for (std::size_t i = 0; i < source_.folder().size(); ++i) {
      const ScanCloud scan = source_.folder().readCloud(i);
      const auto kept = surfacesOf(scan.cloud);
      const auto count =
          static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
      points_ += count;
      out_of_range_ += kept.size() - count;
      layout_.addScan(scan.cloud.fields);
      losses_.addScan(source_.folder().name(i), scan, {});
      advance("counting", i);
    }
    layout_.finish();
  }

  /** The second pass. */
  void
  handOver(const ScanSink& sink)
  {
    for (std::size_t i = 0; i < source_.folder().size(); ++i) {
      const ScanCloud scan = source_.folder().readCloud(i);
      Eigen::Isometry3d pose = source_.pose(i);
      pose.translation() -= source_.worldOffset();
      const auto kept = surfacesOf(scan.cloud);
      for (std::size_t begin = 0; begin < kept.size(); begin += kBlock)
        sink(layout_.joined(scan.cloud,
                            kept,
                            begin,
                            std::min(kept.size(), begin + kBlock),
                            pose,
                            source_.index(i)));
      advance("writing", i);
    }
  }

  void
  describe(const std::vector<std::string>& losses)
  {
    const Eigen::Vector3d offset = source_.worldOffset();
    std::cout << text::counted(source_.folder().size(), "scan") << ", "
              << text::counted(points_, "point") << ": "
              << source_.folder().formatName() << " to "
              << toString(settings_.writer.format) << '\n'
              << "poses from " << source_.poseSource() << '\n'
              << "world_offset " << std::to_string(std::llround(offset.x())) << ' '
              << std::llround(offset.y()) << ' ' << std::llround(offset.z())
              << (isLas() ? ": added to the points of the run [m]\n"
                          : ": subtracted from every point [m]\n");
    if (out_of_range_ > 0)
      std::cout << "dropped " << text::counted(out_of_range_, "point")
                << " outside the ranges of the run, " << source_.minRange() << " to "
                << source_.maxRange() << " m\n";
    for (const auto& loss : layout_.losses())
      losses_.add(loss);
    for (const auto& loss : losses)
      losses_.add(loss);
    losses_.print();
  }

  const ScanSettings& settings_;
  const RegisteredScans source_;
  const Interrupt interrupt_;
  ProgressBar bar_;
  JoinedLayout layout_;
  LossTally losses_;
  std::size_t points_ = 0;
  std::size_t out_of_range_ = 0;
};
} // namespace

int
joinScans(const ScanSettings& settings)
{
  return JoinedScans(settings).run();
}

} // namespace pcl6d::app
