// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/bit_stream.h"
#include "e57/page_writer.h"

namespace pcl6d::sources {

/** \brief Writes the section with the points of a scan. */
class RecordWriter {
public:
  /** \brief Writes the header of the section.
   * \param[in] count number of points to be added
   * \param[in] packet_points points in a packet; 0: the maximum */
  RecordWriter(PageWriter& file,
               const std::vector<E57Field>& fields,
               std::uint64_t count,
               std::size_t packet_points = 0);

  /** \return physical, of the section */
  std::uint64_t
  offset() const
  {
    return offset_;
  }

  /** \return the i-th field, which takes one value per point */
  BitEncoder&
  field(std::size_t i)
  {
    return encoders_[i];
  }

  /** \brief Ends a point. */
  void
  endPoint();

private:
  std::uint64_t
  packetsLength() const;
  void
  writePacket(bool is_last);

  PageWriter& file_;
  std::vector<BitEncoder> encoders_;
  std::vector<unsigned> bits_;
  std::uint64_t count_;
  std::size_t packet_points_;
  std::uint64_t added_ = 0;
  std::uint64_t offset_ = 0;
};

} // namespace pcl6d::sources
