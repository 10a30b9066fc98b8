// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/bag_options.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/scan_source.h>

#include <memory>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Several files as a source: files with a single scan in any format, and files of
 * several scans (isSourceFile()), in the given order.
 *
 * A scan has the name of the file, or its name in a file of several scans; repeated names get
 * the number appended: "scan000.pcd (4)". Poses come from the files: `.pose` beside a file, PCD
 * VIEWPOINT, PTX, E57. An identity pose counts if some file of the same format has a pose other
 * than identity. If some scan has no pose, all poses are dropped, and note() reports the fact.
 * Stamps are provided if all scans have a stamp. \ingroup sources */
class FileListSource : public ScanSource {
public:
  /** \param[in] files at least one \param[in] reading options for files with a single scan
   * \param[in] bag options for robots' recordings
   * \throws IoFailed a file is missing, a folder, or broken \throws BadArgument the list is
   * empty */
  explicit FileListSource(const std::vector<std::filesystem::path>& files,
                          const ScanReaderOptions& reading = {},
                          const BagOptions& bag = {});

  /** \return the first file */
  const std::filesystem::path&
  path() const override;
  std::string
  format() const override;
  const std::vector<SourceScan>&
  scans() const override
  {
    return scans_;
  }
  const std::filesystem::path&
  fileOf(std::size_t i) const override;
  std::string
  titleOf(std::size_t i) const override;
  std::string
  poseSource() const override;
  std::string
  note() const override
  {
    return note_;
  }
  ScanCloud
  read(std::size_t i) const override;

private:
  /** \brief Where a scan is. */
  struct Place {
    std::filesystem::path file;
    std::shared_ptr<const ScanSource> source = {}; ///< null: the file is the scan
    std::size_t number = 0;                        ///< of the scan in the source
    std::string format;
  };
  void
  add(const std::filesystem::path& file);
  void
  decidePoses();
  void
  makeNamesUnique();

  ScanReaderOptions reading_;
  BagOptions bag_;
  std::vector<Place> places_;
  std::vector<SourceScan> scans_;
  std::string note_;
};

} // namespace pcl6d
