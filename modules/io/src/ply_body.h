// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ply_header.h"

#include <memory>

/** \file The elements of a PLY file. Internal to the module io. */
namespace pcl6d {

/** \brief Reads the elements of a PLY body one after the other; text or binary. */
class PlyBody {
public:
  virtual ~PlyBody() = default;

  /** \brief Goes to the next element. \param[in] place for messages: "vertex 3 of 8" */
  void
  next(const PlyElement& element, std::size_t index);

  /** \brief Reads one number in the machine's byte order.
   * \param[out] value of the property's datatype */
  virtual void
  read(std::uint8_t datatype, const PlyProperty& property, std::uint8_t* value) = 0;

  /** \brief Skips a list. */
  void
  skipList(const PlyProperty& property);

  /** \throws IoFailed something follows that the header does not tell of */
  virtual void
  finish() = 0;

protected:
  explicit PlyBody(const std::filesystem::path& path) : path_(path) {}

  /** \return "vertex 3 of 8" */
  std::string
  place() const;

  const std::filesystem::path& path_;

private:
  virtual void
  nextRow() = 0;
  virtual void
  skip(const PlyProperty& property, std::size_t count) = 0;

  const PlyElement* element_ = nullptr;
  std::size_t index_ = 0;
};

/** \param[in] path, header, content are kept by reference */
std::unique_ptr<PlyBody>
openPlyBody(const std::filesystem::path& path,
            const PlyHeader& header,
            std::string_view content);

} // namespace pcl6d
