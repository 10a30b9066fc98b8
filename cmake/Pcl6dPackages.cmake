# SPDX-License-Identifier: BSD-3-Clause
# The packages of the whole suite, each found once.
# In the order in which they build on each other: PCL links no component that comes later.
find_package(PCL 1.12 REQUIRED COMPONENTS
  common io kdtree search sample_consensus filters features registration segmentation)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(Boost 1.71 REQUIRED COMPONENTS program_options filesystem)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(EXPAT 2.4 REQUIRED) # the XML of E57; before 2.4 without a bound on entities
find_package(BZip2 REQUIRED) # the recordings of robots, with the next three
find_package(Lz4 REQUIRED)
find_package(OctoMap REQUIRED) # maps for planners
find_package(GDAL QUIET) # GeoTIFF, if it is there
find_package(PROJ REQUIRED CONFIG) # names of coordinate systems
find_package(Zstd REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(nlohmann_json 3.9 REQUIRED)
find_package(embree 3 REQUIRED)
if(PCL6D_MPI)
  find_package(MPI QUIET COMPONENTS C)
endif()
find_package(OpenCV 4 REQUIRED COMPONENTS
  core imgproc imgcodecs calib3d objdetect videoio)
find_package(VTK 9 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonMath FiltersCore FiltersSources IOImage
  InteractionStyle RenderingCore RenderingFreeType RenderingOpenGL2 RenderingUI)
