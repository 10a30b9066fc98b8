// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "convert/loss_tally.h"
#include "convert/scan_jobs.h"

#include <pcl6d/io/text.h>
#include <pcl6d/sources/e57_writer.h>

#include <iostream>
#include <optional>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

struct StoppedWriting {}; ///< thrown after a signal

ScanFolderOptions
pointsAsTheyAre(ScanFolderOptions options)
{
  options.keep_coordinates = true;
  return options;
}

/** \brief Writes scans to an E57 file, one station after the other. */
class E57Conversion {
public:
  explicit E57Conversion(const ScanSettings& settings)
  : settings_(settings), bar_(settings.quiet)
  {
    if (fs::is_directory(settings.input) || holdsScans(settings.input))
      source_.emplace(openScans(settings.input, pointsAsTheyAre(settings.folder)));
  }

  int
  run()
  try {
    if (!settings_.without_effect.empty())
      bar_.warn(settings_.without_effect);
    const std::size_t count = source_ ? source_->folder().size() : 1;
    std::vector<ScanCloud> read(count); // for the tally of losses, without points
    const auto losses = writeE57(
        settings_.output,
        count,
        [&](std::size_t i) {
          if (interrupt_.requested())
            throw StoppedWriting();
          E57Station station = source_ ? stationOfFolder(i) : stationOfFile();
          const auto& cloud = station.scan.cloud;
          points_ += std::size_t{cloud.width} * cloud.height;
          read[i].dropped = station.scan.dropped;
          read[i].left_out = station.scan.left_out;
          read[i].cloud.data.resize(cloud.data.empty() ? 0 : 1);
          names_.push_back(station.name);
          bar_.show({"converting", i + 1, count});
          return station;
        },
        settings_.writer.coordinate_system);
    for (std::size_t i = 0; i < count; ++i)
      losses_.addScan(names_[i], read[i], losses[i]);
    describe(count);
    return losses_.evaluate(bar_);
  } catch (const StoppedWriting&) {
    return kInterrupted;
  }

private:
  E57Station
  stationOfFolder(std::size_t i) const
  {
    const ScanFolder& folder = source_->folder();
    E57Station station;
    station.name =
        folder.sharesFile(i) ? folder.name(i) : folder.file(i).stem().string();
    if (folder.hasPoses())
      station.pose = source_->pose(i);
    if (folder.sharesFile(i) && !folder.stamps().empty())
      station.stamp = folder.stamps()[i];
    station.scan = folder.readCloud(i);
    return station;
  }

  E57Station
  stationOfFile() const
  {
    E57Station station;
    station.name = fs::path(settings_.input).stem().string();
    station.scan = readScanCloud(settings_.input, readingOf(settings_));
    if (fs::is_regular_file(settings_.input)) // a pipe cannot be read again
      station.pose = findScanPose(settings_.input, settings_.folder.format);
    return station;
  }

  void
  describe(std::size_t count)
  {
    std::cout << text::counted(count, "scan") << ", " << text::counted(points_, "point")
              << (source_ ? ": " + source_->folder().formatName() : std::string())
              << " to e57\n";
    const bool has_poses = source_ && source_->folder().hasPoses();
    if (has_poses)
      std::cout << "poses from " << source_->poseSource() << ", now in the E57 file\n";
    if (source_ && !source_->folder().stamps().empty() &&
        !source_->folder().sharesFile(0))
      losses_.add("dropped the stamps of the poses: E57 counts GPS time");
    losses_.print();
  }

  const ScanSettings& settings_;
  std::optional<RegisteredScans> source_; ///< none: a single scan
  const Interrupt interrupt_;
  ProgressBar bar_;
  std::vector<std::string> names_;
  std::size_t points_ = 0;
  LossTally losses_;
};
} // namespace

int
convertToE57(const ScanSettings& settings)
{
  return E57Conversion(settings).run();
}

} // namespace pcl6d::app
