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

  /** \return the bytes ahead of the points */
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

  /** \brief Appends the bytes behind the points. */
  virtual void
  finish(std::string& content);

  /** \return a final header of equal size, when all points are known; empty if the first header
   * was complete */
  virtual std::string
  finalHeader() const
  {
    return {};
  }

  /** \return whether finalHeader() is not empty: the output must be a seekable file */
  virtual bool
  completesHeader() const
  {
    return false;
  }

  /** \return the losses of the format, in words */
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

/** \brief LAS 1.4, points of format 6 or (with colours) 7, or compressed to LAZ.
 * \param[in] wkt coordinate system, or empty */
std::unique_ptr<ScanEncoder>
makeLasEncoder(const ScanShape& shape, bool compress, const std::string& wkt);

/** \brief PTX with the pose: x y z intensity, with colours also r g b. */
std::unique_ptr<ScanEncoder>
makePtxEncoder(const ScanShape& shape);

/** \return the losses in a format that holds only points: the organization in rows, and the pose
 */
std::vector<std::string>
lossesOfShape(const ScanShape& shape);

/** \return the field by name, or null */
const pcl::PCLPointField*
findField(const std::vector<pcl::PCLPointField>& fields, const std::string& name);

/** \brief Appends the numbers as text, a row per point. */
void
appendText(const pcl::PCLPointCloud2& block,
           std::size_t begin,
           std::size_t end,
           const std::vector<Column>& columns,
           std::string& content);

/** \brief Appends the numbers in memory layout, without gaps. */
void
appendBytes(const pcl::PCLPointCloud2& block,
            std::size_t begin,
            std::size_t end,
            const std::vector<Column>& columns,
            std::string& content);

} // namespace pcl6d::io
