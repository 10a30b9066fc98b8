// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/scanner_presets.h>

#include <optional>

/** \file Spinning lidars and rosettes, modelled after data sheets. */
namespace pcl6d::scanner {

/** [rad] between columns; empty: of the device */
using Resolution = std::optional<double>;

ScannerPreset
avia(const Resolution& resolution);
ScannerPreset
hdl32(const Resolution& resolution);
ScannerPreset
hdl64(const Resolution& resolution);
ScannerPreset
mid360(const Resolution& resolution);
ScannerPreset
os0(const Resolution& resolution);
ScannerPreset
ouster(const Resolution& resolution);
ScannerPreset
pandar(const Resolution& resolution);
ScannerPreset
vlp16(const Resolution& resolution);

} // namespace pcl6d::scanner
