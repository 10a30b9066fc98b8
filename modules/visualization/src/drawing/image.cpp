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
pixelOf(const Image& image, int column, int row)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(column);
}

bool
fitsItsBytes(const Image& image)
{
  if (image.width <= 0 || image.height <= 0)
    return false;
  const std::size_t pixels = pixelOf(image, 0, image.height);
  return image.rgb.size() == 3 * pixels &&
         (image.alpha.empty() || image.alpha.size() == pixels);
}

/** VTK counts rows from below. */
vtkNew<vtkImageData>
toVtk(const Image& image)
{
  const bool opaque = image.alpha.empty();
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, opaque ? 3 : 4);
  for (int row = 0; row < image.height; ++row) {
    auto* out = static_cast<std::uint8_t*>(
        data->GetScalarPointer(0, image.height - 1 - row, 0));
    const std::size_t begin = pixelOf(image, 0, row);
    const std::size_t end = pixelOf(image, 0, row + 1);
    for (std::size_t i = begin; i < end; ++i) {
      out = std::copy_n(&image.rgb[3 * i], 3, out);
      if (!opaque)
        *out++ = image.alpha[i];
    }
  }
  return data;
}
} // namespace

Colour
Image::at(int column, int row) const
{
  if (column < 0 || row < 0 || column >= width || row >= height)
    throw BadArgument("pixel (" + std::to_string(column) + ", " + std::to_string(row) +
                      ") is outside the picture");
  const std::size_t i = 3 * pixelOf(*this, column, row);
  return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

void
writePng(const std::filesystem::path& path, const Image& image)
{
  if (!fitsItsBytes(image))
    throw BadArgument("picture of " + std::to_string(image.width) + " x " +
                      std::to_string(image.height) + " pixels with " +
                      std::to_string(image.rgb.size()) + " bytes");
  const auto data = toVtk(image);
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
