// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/ply/ply_header.h"
#include "text/text_row.h"

#include <memory>
#include <optional>

/** \file The elements of a PLY file. */
namespace pcl6d::io {

/** \brief Reads the elements of a PLY body in sequence; text or binary. */
class PlyBody {
public:
  virtual ~PlyBody() = default;

  /** \brief Goes to the next kind of element. \param[in] element is kept by reference
   * \param[in] offsets [byte] where each property goes; not used for lists
   * \param[in] kept the index of the list property to keep; further lists are skipped */
  void
  start(const PlyElement& element,
        const std::vector<std::size_t>& offsets,
        std::optional<std::size_t> kept = {});

  /** \brief Reads an element, numbers in the machine's byte order.
   * \throws IoFailed naming file, position, value and rule */
  void
  next(std::uint8_t* target);

  /** \return the kept list of the last element; must consist of whole numbers */
  const std::vector<std::int64_t>&
  list() const
  {
    return list_;
  }

  /** \brief Skips all elements of a kind. Elements without properties take no bytes in the file. */
  void
  skipAll(const PlyElement& element);

  /** \throws IoFailed extra data follow that are not declared in the header */
  virtual void
  finish() = 0;

  /** \return "vertex 3 of 8", for messages */
  std::string
  place() const;

protected:
  explicit PlyBody(FileInput& input) : input_(input) {}

  /** \return whether the current element is the first of its kind, with several properties */
  bool
  isFirstOfSeveral() const
  {
    return count_ == 1 && element_->properties.size() > 1;
  }

  FileInput& input_;
  std::vector<Column> columns_; ///< of the element, if without lists
  bool in_order_ = false;       ///< the columns are contiguous

private:
  virtual void
  nextRow() = 0;
  virtual void
  read(std::uint8_t datatype, const PlyProperty& property, std::uint8_t* value) = 0;
  virtual void
  skip(const PlyProperty& property, std::size_t count) = 0;
  /** Reads an element of columns_ at once. \return false if the element must be read property by
   * property */
  virtual bool
  takeRow(std::uint8_t* target) = 0;
  /** \return a number of an integer type */
  std::int64_t
  readWhole(std::uint8_t datatype, const PlyProperty& property);
  void
  readList(std::size_t property);

  const PlyElement* element_ = nullptr;
  std::optional<std::size_t> kept_;
  std::vector<std::int64_t> list_;
  std::vector<std::size_t> offsets_;
  bool has_list_ = false;
  std::size_t count_ = 0; ///< elements read, including the current element
};

/** \param[in] input at the start of the body; kept by reference */
std::unique_ptr<PlyBody>
openPlyBody(FileInput& input, const PlyHeader& header);

} // namespace pcl6d::io
