// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

/** \file Output stream for a file opened by the system call, with any of its flags. */
namespace pcl6d::io {

/** \brief An open file descriptor, closed at the end of the scope. */
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

  /** \return false if written data were lost; errno has the reason */
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

  /** \return errno of a failed write; 0 without failures */
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
  /** Seeks to an offset from the start of a file; fails for a pipe. */
  pos_type
  seekpos(pos_type place, std::ios_base::openmode which) override;

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
