// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A file of appended records, whose writing may be interrupted at any moment: each record
 * is preceded by its length and a checksum.
 *
 * Opening reads all records up to the first incomplete or damaged record, and drops the rest. The
 * open file is locked if the file system supports locks. Appended records survive the end of the
 * process and of the machine. \ingroup run */
class RecordFile {
public:
  /** \brief Opens or creates the file.
   * \throws IoFailed the file cannot be opened or created, is a link, is of another kind or
   * version, or is open in another process */
  explicit RecordFile(const std::filesystem::path& path);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile&
  operator=(const RecordFile&) = delete;

  /** \return the records found when the file was opened */
  const std::vector<std::string>&
  records() const
  {
    return records_;
  }

  /** \return [bytes] dropped when the file was opened */
  std::size_t
  dropped() const
  {
    return dropped_;
  }

  /** \throws IoFailed the record cannot be written, e.g. on a full disk; the file then ends with
   * the previous record */
  void
  append(const std::string& record);

  /** \brief Removes the file; append() is no longer possible. */
  void
  remove();

private:
  std::size_t
  readRecords(const std::string& content);

  std::filesystem::path path_;
  int file_ = -1;
  std::size_t size_ = 0; ///< [bytes] of whole records
  std::size_t dropped_ = 0;
  std::vector<std::string> records_;
};

} // namespace pcl6d
