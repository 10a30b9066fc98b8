// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/scan_line.h>

#include <pcl/filters/filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Base class of filters along scan lines: locates the lines. The rows of an
 * organized cloud (height > 1) are its lines; for an unorganized cloud, in the order
 * of acquisition, setLineLength() sets the number of values a line.
 * \ingroup filters */
template <typename PointT>
class ScanLineFilter : public pcl::Filter<PointT> {
public:
  /** \param[in] length values a line, values without an echo included; the last line
   * may be shorter. For an organized cloud only its width is accepted
   * \throws BadArgument length <= 0 */
  void
  setLineLength(int length)
  {
    require(length > 0, "line_length", length, "> 0");
    line_length_ = length;
  }

protected:
  /** \return the line length of the input \throws BadArgument see lineLengthOf(), or an
   * index is out of range */
  std::size_t
  checkedLineLength() const;

private:
  int line_length_ = 0; ///< 0: not given
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/scan_line_filter.hpp>
