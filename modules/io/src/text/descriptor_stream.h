// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

/** \file Writing to a file that was opened by the system's own call, with all that it can
 * ask for. */
namespace pcl6d::io {

/** \brief An open file, closed at the end of its scope. */
class Descriptor {
public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor&
  operator=(Descriptor&& other) noexcept
  {
    std::swap(number_, other.number_);
    return *this;
  }

  int
  number() const
  {
    return number_;
  }

  bool
  isOpen() const
  {
    return number_ >= 0;
  }

  /** \return false if something of what was written got lost; errno says why */
  bool
  close();

private:
  int number_;
};

/** \brief The bytes of a stream on their way to a file. */
class DescriptorBuffer : public std::streambuf {
public:
  /** \param[in] file stays open, and belongs to the caller */
  explicit DescriptorBuffer(int file);

  /** \return what the system said when a write failed (an errno); 0 if none did */
  int
  error() const
  {
    return error_;
  }

protected:
  int_type
  overflow(int_type c) override;
  std::streamsize
  xsputn(const char* bytes, std::streamsize count) override;
  int
  sync() override;

private:
  bool
  write(const char* bytes, std::size_t count);
  bool
  flushBuffer();

  int file_;
  int error_ = 0;
  std::vector<char> buffer_;
};

} // namespace pcl6d::io
