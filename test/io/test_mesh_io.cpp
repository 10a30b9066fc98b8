// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"

#include <pcl6d/io/mesh_io.h>

#include <Eigen/Geometry>

#include <cmath>

namespace {
using pcl6d::readMesh;
using pcl6d::TriangleMesh;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kTetrahedronObj = "# a tetrahedron\n"
                                        "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\n"
                                        "vn 0 0 1\nusemtl stone\n"
                                        "f 1 3 2\nf 1/1 2/2 4/4\nf 1//1 4//1 3//1\n"
                                        "f -3 -2 -1\n";
constexpr const char* kTetrahedronPly =
    "ply\nformat ascii 1.0\nelement vertex 4\n"
    "property float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n2 0 0\n0 3 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

double
volume(const TriangleMesh& mesh)
{
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

std::string
stlText(const TriangleMesh& mesh)
{
  std::string text = "solid thing\n";
  for (const auto& t : mesh.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const auto i : t) {
      text += "      vertex";
      for (int axis = 0; axis < 3; ++axis)
        text += " " + std::to_string(mesh.vertices[i][axis]);
      text += "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid thing\n";
}

std::string
stlBinary(const TriangleMesh& mesh)
{
  std::string bytes = "solid, though it is binary";
  bytes.resize(80);
  const auto append = [&bytes](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i)
      append(0.f);
    for (const auto i : t)
      for (int axis = 0; axis < 3; ++axis)
        append(static_cast<float>(mesh.vertices[i][axis]));
    append(std::uint16_t{0});
  }
  return bytes;
}
} // namespace

TEST(ReadMesh, ReadsTheSameBodyFromEveryFormat)
{
  const TempFolder folder;
  writeText(folder / "body.obj", kTetrahedronObj);
  const TriangleMesh obj = readMesh(folder / "body.obj");
  EXPECT_NEAR(volume(obj), 4, 1e-12);
  writeText(folder / "body.PLY", kTetrahedronPly);
  writeText(folder / "text.stl", stlText(obj));
  writeText(folder / "binary.stl", stlBinary(obj));
  for (const char* name : {"body.PLY", "text.stl", "binary.stl"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = readMesh(folder / name);
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(mesh.vertices.size(), 4u); // also of STL, which repeats them
    EXPECT_NEAR(volume(mesh), 4, 1e-12);
  }
}

TEST(ReadMesh, CutsPolygons)
{
  const TempFolder folder;
  writeText(folder / "house.obj",
            "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(readMesh(folder / "house.obj").triangles.size(), 3u);
}

TEST(ReadMesh, ScalesAndTurns)
{
  const TempFolder folder;
  writeText(folder / "body.obj", kTetrahedronObj);
  pcl6d::MeshOptions options;
  options.scale = 0.001; // millimetres
  options.up = pcl6d::UpAxis::kY;
  const TriangleMesh mesh = readMesh(folder / "body.obj", options);
  EXPECT_LT((mesh.vertices[2] - Eigen::Vector3d(0, 0, 0.003)).norm(), 1e-15);
  EXPECT_LT((mesh.vertices[3] - Eigen::Vector3d(0, -0.004, 0)).norm(), 1e-15);
  EXPECT_GT(volume(mesh), 0); // not mirrored
  options.scale = 0;
  EXPECT_THROW(readMesh(folder / "body.obj", options), pcl6d::BadArgument);
}

TEST(ReadMesh, NamesWhatIsWrong)
{
  const TempFolder folder;
  const auto expectRefused = [&folder](const std::string& name,
                                       const std::string& content,
                                       const std::string& message) {
    const auto path = folder / name;
    writeText(path, content);
    expectIoFailed(path, message, [&] { readMesh(path); });
  };
  expectRefused("a.obj", "v 0 0\n", "line 1: '' is not a number");
  expectRefused("b.obj", "v 0 0 zero\n", "line 1: 'zero' is not a number");
  expectRefused(
      "c.obj", "v 0 0 0\nf 1 1 2\n", "line 2: vertex 2, but there are 1 ahead of it");
  expectRefused(
      "d.obj", "v 0 0 0\nf 1 1\n", "line 2: a face with fewer than 3 corners");
  expectRefused("e.obj", "v 0 0 0\n", "a mesh without triangles");
  expectRefused("f.obj",
                "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n",
                "triangle 2: area is zero, but must be > 0");
  expectRefused(
      "g.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "vertex 1 is not finite");
  expectRefused("h.stl",
                "solid x\nfacet normal 0 0 1\nvertex 0 0 0\nendfacet\n",
                "line 4: a facet with 1 corner, must be 3");
  expectRefused("i.stl", "short", "neither a text nor a binary STL file");
  expectRefused("j.dae",
                "",
                "extension '.dae' is no format of meshes, must be .ply, "
                ".obj or .stl");
  expectRefused("k.ply", "plx\n", "not a PLY file that can be read");
  std::string cut(84, '\0');
  cut[80] = 2; // triangles
  expectRefused(
      "l.stl", cut + std::string(60, '\0'), "the file ends ahead of triangle 2 of 2");
}

TEST(ReadMesh, RefusesAPlyFileWhoseFacesPointBeyondItsVertices)
{
  const TempFolder folder;
  std::string text = kTetrahedronPly;
  text.replace(text.rfind("3 1 2 3"), 7, "3 1 2 9");
  writeText(folder / "bad.ply", text);
  expectIoFailed(folder / "bad.ply", "triangle 4: vertex 9, but there are 4", [&] {
    readMesh(folder / "bad.ply");
  });
}

TEST(ReadMesh, ReadsAMillionTriangles)
{
  const TempFolder folder;
  constexpr int kSide = 708; // cells
  TriangleMesh mesh;
  for (int i = 0; i <= kSide; ++i)
    for (int k = 0; k <= kSide; ++k)
      mesh.vertices.emplace_back(i, k, (i * k) % 3);
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t k = 0; k < kSide; ++k) {
      const std::uint32_t corner = i * (kSide + 1) + k;
      mesh.triangles.push_back({corner, corner + kSide + 1, corner + 1});
      mesh.triangles.push_back({corner + 1, corner + kSide + 1, corner + kSide + 2});
    }
  writeText(folder / "large.stl", stlBinary(mesh));
  const TriangleMesh read = readMesh(folder / "large.stl");
  EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
  EXPECT_GT(read.triangles.size(), 1000000u);
  EXPECT_EQ(read.vertices.size(), mesh.vertices.size());
}
