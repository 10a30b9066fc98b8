// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/ply_header.h"
#include "text/text_row.h"

#include <memory>

/** \file The elements of a PLY file. */
namespace pcl6d::io {

/** \brief Reads the elements of a PLY body one after the other; text or binary. */
class PlyBody {
public:
  virtual ~PlyBody() = default;

  /** \brief Goes to the next kind of element. \param[in] element is kept by reference
   * \param[in] offsets [byte] where each property goes; lists are skipped */
  void
  start(const PlyElement& element, const std::vector<std::size_t>& offsets);

  /** \brief Reads an element, numbers in the machine's byte order.
   * \throws IoFailed naming file, place, value and rule */
  void
  next(std::uint8_t* target);

  /** \throws IoFailed something follows that the header does not tell of */
  virtual void
  finish() = 0;

protected:
  explicit PlyBody(FileInput& input) : input_(input) {}

  /** \return "vertex 3 of 8" */
  std::string
  place() const;

  FileInput& input_;
  std::vector<Column> columns_; ///< of the element, if it has no list
  bool in_order_ = false;       ///< the columns follow each other without gaps

private:
  virtual void
  nextRow() = 0;
  virtual void
  read(std::uint8_t datatype, const PlyProperty& property, std::uint8_t* value) = 0;
  virtual void
  skip(const PlyProperty& property, std::size_t count) = 0;
  /** Reads an element of columns_ at once. \return false if it has to be read property
   * by property */
  virtual bool
  takeRow(std::uint8_t* target) = 0;
  void
  skipList(const PlyProperty& property);

  const PlyElement* element_ = nullptr;
  std::vector<std::size_t> offsets_;
  bool has_list_ = false;
  std::size_t count_ = 0; ///< elements read, with the one at hand
};

/** \param[in] input stands at the body; it is kept by reference */
std::unique_ptr<PlyBody>
openPlyBody(FileInput& input, const PlyHeader& header);

} // namespace pcl6d::io
