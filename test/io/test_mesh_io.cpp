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
/** A camera, five vertices with colours and lists, and two faces, in binary. */
std::string
roofBytes(bool big)
{
  std::string bytes;
  const auto append = [&](auto value) {
    const std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    bytes += big ? std::string(raw.rbegin(), raw.rend()) : raw;
  };
  const auto appendVertex = [&](double x, double y, std::int16_t z, int tags) {
    append(std::uint8_t{9});
    append(x);
    append(y);
    append(static_cast<std::uint8_t>(tags));
    for (int i = 0; i < tags; ++i)
      append(std::int16_t{7});
    append(z);
  };
  append(7.f);
  appendVertex(0, 0, 0, 0);
  appendVertex(2, 0, 0, 2);
  appendVertex(3, 1.25, 0, 0);
  appendVertex(2, 2, 0, 0);
  appendVertex(0, 2, -4, 1);
  for (const auto& corners : {std::vector<std::uint32_t>{0, 1, 2, 3, 4}, {0, 4, 1}}) {
    append(std::int32_t{5});
    append(static_cast<std::uint16_t>(corners.size()));
    for (const auto corner : corners)
      append(corner);
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

TEST(ReadMesh, ReadsPlyInEveryEncodingAndSkipsWhatItDoesNotKnow)
{
  const std::string elements = "element camera 1\nproperty float f\nelement vertex 5\n"
                               "property uchar red\nproperty double x\n"
                               "property double y\nproperty list uchar short tags\n"
                               "property short z\nelement face 2\n"
                               "property int id\n"
                               "property list ushort uint vertex_index\nend_header\n";
  const std::string text = "7\n1 0 0 0 0\n2 2 0 2 5 6 0\n3 3 1.25 0 0\n4 2 2 0 0\n"
                           "5 0 2 1 9 -4\n0 5 0 1 2 3 4\n1 3 0 4 1\n";
  const TempFolder folder;
  writeText(folder / "a.ply", "ply\nformat ascii 1.0\n" + elements + text);
  for (const bool big : {false, true})
    writeText(folder / (big ? "big.ply" : "little.ply"),
              std::string("ply\nformat binary_") + (big ? "big" : "little") +
                  "_endian 1.0\n" + elements + roofBytes(big));
  const TriangleMesh mesh = readMesh(folder / "a.ply");
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(3, 1.25, 0));
  EXPECT_EQ(mesh.vertices[4], Eigen::Vector3d(0, 2, -4));
  const decltype(mesh.triangles) expected = {
      {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  EXPECT_EQ(mesh.triangles, expected);
  for (const char* const other : {"little.ply", "big.ply"}) {
    const TriangleMesh same = readMesh(folder / other);
    EXPECT_EQ(same.vertices, mesh.vertices) << other;
    EXPECT_EQ(same.triangles, mesh.triangles) << other;
  }
}

TEST(ReadMesh, RefusesFacesOfAPlyFileThatAreNone)
{
  const TempFolder folder;
  const auto refuse = [&](const std::string& face, const std::string& words) {
    std::string text = kTetrahedronPly;
    text.replace(text.find("3 0 1 3"), 7, face);
    writeText(folder / "a.ply", text);
    expectIoFailed(folder / "a.ply", words, [&] { readMesh(folder / "a.ply"); });
  };
  refuse("2 0 1", "face 2 of 4 has fewer than 3 corners");
  refuse("3 0 -1 3", "face 2 of 4: vertex -1, but must be >= 0");
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
  expectRefused("k.ply", "plx\n", "line 1: expected 'ply', got 'plx'");
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
