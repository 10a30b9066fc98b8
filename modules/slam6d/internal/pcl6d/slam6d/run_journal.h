// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/run/record_file.h>
#include <pcl6d/slam6d/task_memory.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Results of tasks in a file: a run that was killed continues with them at its next start.
 * The file is created with the first result. \code
 * RunJournal journal("out/.pcl6d-journal", {{"voxel", "0.1"}});
 * slam.setMemory(&journal);
 * if (slam.optimize())
 * journal.remove();
 * \endcode \ingroup slam6d */
class RunJournal : public TaskMemory {
public:
  /** Inputs of the results besides the scans: options by name. */
  using Conditions = std::vector<std::pair<std::string, std::string>>;

  /** \param[in] names of the scans, for messages; may be empty
   * \throws IoFailed as RecordFile; or the journal was written under different conditions, the
   * first of which is named in the message */
  RunJournal(const std::filesystem::path& path,
             const Conditions& conditions,
             std::vector<std::string> names = {});

  /** \return the number of scans matched by an interrupted run */
  std::size_t
  numMatched() const
  {
    return matched_.size();
  }

  /** \throws IoFailed the journal has the scan with different points, poses or parameters: the scan
   * has changed since */
  std::optional<ScanResult>
  matched(std::size_t scan, std::uint64_t inputs) override;
  void
  keepMatched(std::size_t scan,
              std::uint64_t inputs,
              const ScanResult& result) override;
  std::optional<Slam6DResult>
  relaxed(std::uint64_t inputs) override;
  void
  keepRelaxed(std::uint64_t inputs, const Slam6DResult& result) override;

  /** \brief Removes the file, when the run is complete. */
  void
  remove()
  {
    if (file_)
      file_->remove();
  }

private:
  void
  open();
  void
  take(const std::string& record);
  void
  keep(const std::string& record);

  std::filesystem::path path_;
  Conditions conditions_;
  std::vector<std::string> names_;
  std::optional<RecordFile> file_;
  std::map<std::size_t, std::pair<std::uint64_t, ScanResult>> matched_;
  std::map<std::uint64_t, std::string> relaxed_; ///< still packed
};

} // namespace pcl6d
