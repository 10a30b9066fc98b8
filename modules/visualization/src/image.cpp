// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/visualization/image.h>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace pcl6d {

namespace {
std::size_t
offsetOf(const Image& image, int column, int row)
{
  return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
              static_cast<std::size_t>(column));
}
} // namespace

Colour
Image::at(int column, int row) const
{
  if (column < 0 || row < 0 || column >= width || row >= height)
    throw BadArgument("pixel (" + std::to_string(column) + ", " + std::to_string(row) +
                      ") is outside the picture");
  const std::size_t i = offsetOf(*this, column, row);
  return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

void
writePng(const std::filesystem::path& path, const Image& image)
{
  if (image.width <= 0 || image.height <= 0 ||
      image.rgb.size() != offsetOf(image, 0, image.height))
    throw BadArgument("picture of " + std::to_string(image.width) + " x " +
                      std::to_string(image.height) + " pixels with " +
                      std::to_string(image.rgb.size()) + " bytes");
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int row = 0; row < image.height; ++row) // VTK counts rows from below
    std::copy_n(image.rgb.data() + offsetOf(image, 0, row),
                offsetOf(image, image.width, 0),
                static_cast<std::uint8_t*>(
                    data->GetScalarPointer(0, image.height - 1 - row, 0)));
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray* bytes = writer->GetResult();
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(
                     const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0)),
                 bytes->GetNumberOfValues());
  });
}

} // namespace pcl6d
