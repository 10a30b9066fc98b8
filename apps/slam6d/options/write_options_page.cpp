// SPDX-License-Identifier: BSD-3-Clause
// write_options_page FILE writes share/doc/options.md; with --check, compares the file.
#include "slam6d/options/options_page.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>

#include <exception>
#include <iostream>
#include <ostream>
#include <string>

int
main(int argc, char** argv)
try {
  const bool checks = argc == 3 && std::string(argv[1]) == "--check";
  if (argc != 2 && !checks) {
    std::cerr << "usage: write_options_page [--check] FILE\n";
    return 2;
  }
  const std::string file = argv[argc - 1], page = pcl6d::app::optionsPage();
  if (!checks) {
    pcl6d::writeFileAtomically(file, [&](std::ostream& stream) { stream << page; });
    return 0;
  }
  if (pcl6d::text::readFile(file) == page)
    return 0;
  std::cerr << file << ": not up to date: cmake --build build/release --target "
            << "options_page writes it\n";
  return 1;
} catch (const std::exception& e) {
  std::cerr << "write_options_page: " << e.what() << '\n';
  return 1;
}
