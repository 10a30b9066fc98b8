// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A file of records that grows by its end, and may be cut there at any moment: each
 * record has its length and a checksum before it.
 *
 * Opening it reads all records up to the first that is cut or damaged, and drops the rest.
 * It is locked while it is open, where the file system knows locks. What was appended
 * survives the end of the process and of the machine. \ingroup run */
class RecordFile {
public:
  /** \brief Opens the file, or makes it.
   * \throws IoFailed it cannot be opened or made, is a link, is of another kind or version,
   * or another process has it open */
  explicit RecordFile(const std::filesystem::path& path);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile&
  operator=(const RecordFile&) = delete;

  /** \return the records that were found when it was opened */
  const std::vector<std::string>&
  records() const
  {
    return records_;
  }

  /** \return [bytes] what was cut or damaged then, and dropped */
  std::size_t
  dropped() const
  {
    return dropped_;
  }

  /** \throws IoFailed it cannot be written, as on a full disk; the file ends with the record
   * before then */
  void
  append(const std::string& record);

  /** \brief Removes the file; nothing can be appended any more. */
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
