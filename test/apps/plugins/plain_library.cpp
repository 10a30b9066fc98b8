// SPDX-License-Identifier: BSD-3-Clause
// A shared library like any other.
extern "C" int
pcl6dTestPlainLibrary();

extern "C" int
pcl6dTestPlainLibrary()
{
  return 7;
}
