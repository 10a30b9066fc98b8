// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "text/text_row.h"

#include <pcl6d/io/scan_writer.h>

#include <memory>

/** \file How each format writes points. */
namespace pcl6d::io {

/** \brief Turns points into the content of a file, block by block. */
class ScanEncoder {
public:
  virtual ~ScanEncoder() = default;

  /** \return what stands ahead of the points */
  virtual std::string
  header() const
  {
    return {};
  }

  /** \brief Appends the points [begin, end) of the block. */
  virtual void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) = 0;

  /** \brief Appends what stands behind the points. */
  virtual void
  finish(std::string& content);

  /** \return what the file does not hold, in words */
  const std::vector<std::string>&
  losses() const
  {
    return losses_;
  }

protected:
  std::vector<std::string> losses_;
};

/** \param[in] path kept for messages */
std::unique_ptr<ScanEncoder>
makePcdEncoder(const std::filesystem::path& path,
               const ScanShape& shape,
               PcdEncoding encoding);

std::unique_ptr<ScanEncoder>
makePlyEncoder(const ScanShape& shape, bool ascii);

/** \param[in] format kUos, kUosr, kXyz or kKitti */
std::unique_ptr<ScanEncoder>
makeFloatEncoder(const ScanShape& shape, ScanFormat format);

/** \return what is lost in a format that holds only points: their order in rows, and the
 * pose */
std::vector<std::string>
lossesOfShape(const ScanShape& shape);

/** \return the field of that name, or null */
const pcl::PCLPointField*
findField(const std::vector<pcl::PCLPointField>& fields, const std::string& name);

/** \brief Appends the numbers as text, one row per point. */
void
appendText(const pcl::PCLPointCloud2& block,
           std::size_t begin,
           std::size_t end,
           const std::vector<Column>& columns,
           std::string& content);

/** \brief Appends the numbers as they are in memory, without gaps. */
void
appendBytes(const pcl::PCLPointCloud2& block,
            std::size_t begin,
            std::size_t end,
            const std::vector<Column>& columns,
            std::string& content);

} // namespace pcl6d::io
