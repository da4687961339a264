// Files that are cut, or that tell of other things than they have: each is refused with its fault, or read as a whole.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/load_model.h"
#include "load_refusal.h"
#include "temp_folder.h"

namespace hl::test_cut_files {
namespace {

using test::fileWith;
using test::loadRefusal;

bool refuses(const std::string& name, const std::string& content, const std::string& part) {
  const std::string refusal = loadRefusal(fileWith(name, content));
  if (refusal.find(part) != std::string::npos) return true;
  ADD_FAILURE() << name << ": '" << refusal << "' does not say '" << part << "'";
  return false;
}

// All corners of all triangles.
std::vector<Vec3> cornersOf(const Model& model) {
  std::vector<Vec3> corners;
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) corners.push_back(model.positions[index]);
  }
  return corners;
}

// A tetrahedron's corners and faces.
const std::vector<Vec3> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string textOfCorners() {
  std::string text;
  for (const Vec3& corner : kCorners) text += fmt::format("{} {} {}\n", corner.x(), corner.y(), corner.z());
  return text;
}

std::string textOfFaces() {
  std::string text;
  for (const auto& face : kFaces) text += fmt::format("3 {} {} {}\n", face[0], face[1], face[2]);
  return text;
}

template <typename Value>
void put(std::string& bytes, Value value, bool big_endian = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big_endian == (std::endian::native == std::endian::little)) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

void putVec(std::string& bytes, const Vec3& v, bool big_endian = false) {
  for (const double x : {v.x(), v.y(), v.z()}) put(bytes, static_cast<float>(x), big_endian);
}

std::string binaryStl(const std::string& title) {
  std::string stl = title + std::string(80 - title.size(), ' ');
  put(stl, std::uint32_t{4});
  for (const auto& face : kFaces) {
    putVec(stl, Vec3::Zero());
    for (const int corner : face) putVec(stl, kCorners[static_cast<std::size_t>(corner)]);
    put(stl, std::uint16_t{0});
  }
  return stl;
}

std::string textStl() {
  std::string stl = "solid tetrahedron\n";
  for (const auto& face : kFaces) {
    stl += "facet normal 0 0 1\n outer loop\n";
    for (const int corner : face) {
      const Vec3& v = kCorners[static_cast<std::size_t>(corner)];
      stl += fmt::format("  vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    stl += " endloop\nendfacet\n";
  }
  return stl + "endsolid tetrahedron\n";
}

std::string plyHeader(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 4\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string binaryPly(bool big_endian) {
  std::string ply = plyHeader(big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const Vec3& corner : kCorners) putVec(ply, corner, big_endian);
  for (const auto& face : kFaces) {
    ply += '\7';
    ply += '\3';
    for (const int corner : face) put(ply, std::int32_t{corner}, big_endian);
  }
  return ply;
}

std::string textPly() {
  std::string ply = plyHeader("ascii") + textOfCorners();
  for (const auto& face : kFaces) ply += fmt::format("7 3 {} {} {}\n", face[0], face[1], face[2]);
  return ply;
}

struct Whole {
  const char* name;
  std::string content;
};

class CutFiles : public testing::TestWithParam<Whole> {};

TEST_P(CutFiles, IsRefusedOrReadAsAWhole) {
  const auto& [name, content] = GetParam();
  const std::vector<Vec3> whole = cornersOf(loadModel(fileWith(name, content)));
  ASSERT_EQ(whole.size(), 12u);
  int refused = 0;
  for (std::size_t bytes = 1; bytes < content.size(); bytes += 7) {
    const std::string path = fileWith(name, content.substr(0, bytes));
    const std::string refusal = loadRefusal(path);
    EXPECT_TRUE(!refusal.empty() || cornersOf(loadModel(path)) == whole) << bytes << " bytes";
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find("crashed"), std::string::npos) << bytes << " bytes: " << refusal;
    refused += refusal.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, static_cast<int>(content.size() / 7) - 3);
}

INSTANTIATE_TEST_SUITE_P(Formats, CutFiles,
                         testing::Values(Whole{"cut.off", "OFF\n4 4 6\n" + textOfCorners() + textOfFaces()},
                                         Whole{"cut_text.stl", textStl()}, Whole{"cut.stl", binaryStl("title")},
                                         Whole{"cut_solid.stl", binaryStl("solid title")},
                                         Whole{"cut_text.ply", textPly()}, Whole{"cut_little.ply", binaryPly(false)},
                                         Whole{"cut_big.ply", binaryPly(true)}),
                         [](const auto& param) {
                           std::string name = param.param.name;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(PlainOff, EveryFormOfItsHeaderIsRead) {
  const std::string body = textOfCorners() + textOfFaces();
  std::string coloured, with_normals, weighted;
  for (const Vec3& v : kCorners) {
    coloured += fmt::format("{} {} {} 255 0 0 255\n", v.x(), v.y(), v.z());
    with_normals += fmt::format("{} {} {} 0 0 1\n", v.x(), v.y(), v.z());
    weighted += fmt::format("{} {} {} 2\n", 2 * v.x(), 2 * v.y(), 2 * v.z());
  }
  const std::vector<std::string> forms{"OFF\n4 4 6\n" + body,
                                       "OFF 4 4 6\n" + body,
                                       "OFF\n# a comment\n\n4 4 6 # counts\n" + body,
                                       "\xef\xbb\xbfOFF\r\n4 4 6\r\n" + body,
                                       "4 4 6\n" + body,
                                       "OFF\n4\n4\n6\n" + body,
                                       "OFF\n4 4\n" + body,
                                       "OFF\n4 4 6\n# corners\n" + textOfCorners() + " \n# faces\n" + textOfFaces(),
                                       "OFF\n4 4 6 " + body,
                                       "nOFF\n3\n4 4 6\n" + body,
                                       "COFF\n4 4 6\n" + coloured + textOfFaces(),
                                       "NOFF\n4 4 6\n" + with_normals + textOfFaces(),
                                       "4OFF\n4 4 6\n" + weighted + textOfFaces()};
  const std::vector<Vec3> whole = cornersOf(loadModel(fileWith("form.off", forms[0])));
  for (const std::string& form : forms) EXPECT_EQ(cornersOf(loadModel(fileWith("form.off", form))), whole) << form;
}

TEST(PlainOff, WhatContradictsItselfIsRefused) {
  const std::string body = textOfCorners() + textOfFaces();
  refuses("a.off", "OFF\n4 5 6\n" + body, "it is cut: its header tells of 5 faces, and 4 follow");
  refuses("a.off", "OFF\n9 4 6\n" + body, "it is cut: its header tells of 9 vertices, and 8 follow");
  refuses("a.off", "OFF\n4000000000 4000000000 6\n" + body, "it is cut: its header tells of 4000000000 vertices");
  refuses("a.off", "OFF\n4 4 6\n" + textOfCorners() + "3 0 1 4\n" + textOfFaces(),
          "line 7: a face has the vertex '4', and there are 4, from 0");
  refuses("a.off", "OFF\n4 4 6\n" + textOfCorners() + "3 0 1 -1\n" + textOfFaces(), "a face has the vertex '-1'");
  refuses("a.off", "OFF\n4 4 6\n0 0\n" + body, "line 3: a vertex has 2 numbers, and needs 3");
  refuses("a.off", "OFF\n4 4 6\n" + textOfCorners() + "4 0 1 2\n" + textOfFaces(), "line 7: a face has 3 corners");
  refuses("a.off", "OFF BINARY\n", "is a binary OFF file");
  const Model more = loadModel(fileWith("more.off", "OFF\n4 3 6\n" + body));
  EXPECT_EQ(more.triangles.size(), 3u);
  ASSERT_EQ(more.warnings.size(), 1u);
  EXPECT_EQ(more.warnings[0], "what follows its 3 faces, from line 10 on, is left out");
}

// A comb with teeth, which is not convex: its reader leaves out faces of more than nine corners.
TEST(PlainOff, AFaceOfManyCornersIsRead) {
  const std::string off =
      "OFF\n13 2 0\n0 0 0\n5 0 0\n5 2 0\n4 2 0\n4 1 0\n3 1 0\n3 2 0\n2 2 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 1\n"
      "12 0 1 2 3 4 5 6 7 8 9 10 11 0.5 0.5 0.5\n3 0 1 12\n";
  const Model model = loadModel(fileWith("comb.off", off));
  double area = 0;
  for (const auto& [a, b, c] : model.triangles)
    area += (model.positions[b] - model.positions[a]).cross(model.positions[c] - model.positions[a]).norm() / 2;
  EXPECT_NEAR(area, 8 + 2.5, 1e-9);
}

TEST(PlainStl, WhatContradictsItselfIsRefused) {
  const std::string whole = binaryStl("title");
  refuses("a.stl", whole.substr(0, whole.size() - 1),
          "it is cut: its header tells of 4 triangles, and it has the bytes of 3");
  refuses("a.stl", binaryStl("solid").substr(0, 90), "it is cut: its header tells of 4 triangles");
  std::string many = whole.substr(0, 88);  // 85899346 triangles need 88 bytes, modulo 2 to the 32
  for (const std::size_t i : {0u, 1u, 2u, 3u}) many[80 + i] = static_cast<char>(85899346u >> (8 * i));
  refuses("a.stl", many, "it is cut: its header tells of 85899346 triangles");
  std::string text = textStl();
  refuses("a.stl", text.substr(0, text.find("endsolid")), "it is cut: its last line is not 'endsolid'");
  text.insert(text.find("endloop"), "vertex 1 1 1\n");
  refuses("a.stl", text, "line 9: 'endfacet' comes after 4 vertices of a facet");
}

TEST(PlainStl, WhatIsBehindTheTrianglesIsLeftOutWithAWarning) {
  const Model model = loadModel(fileWith("behind.stl", binaryStl("solid title") + "colours"));
  EXPECT_EQ(model.triangles.size(), 4u);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0], "its header tells of 4 triangles: the 7 bytes behind them are left out");
}

TEST(PlainStl, TextsOfSeveralSolidsAreRead) {
  const std::string text = textStl();
  EXPECT_EQ(loadModel(fileWith("two.stl", text + "solid\nendsolid\n" + text)).triangles.size(), 8u);
  EXPECT_EQ(
      loadModel(fileWith("named.stl", "solid a facet of it\n" + text.substr(text.find("facet")))).triangles.size(), 4u);
}

// The size of a random header, against a writer that counts its bytes.
TEST(CheckPly, WalksElementsOfAllKinds) {
  std::mt19937 random(5);
  const std::vector<std::pair<const char*, std::size_t>> kinds{
      {"char", 1}, {"uint8", 1}, {"short", 2}, {"uint16", 2}, {"int32", 4}, {"uint", 4}, {"float", 4}, {"float64", 8}};
  for (int round = 0; round < 60; ++round) {
    const bool big_endian = random() % 2 == 0;
    std::string header = std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") +
                         " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    std::string others, body;
    std::vector<std::pair<bool, std::size_t>> properties;
    for (int i = 0; i < static_cast<int>(random() % 4); ++i) {
      const auto& [name, size] = kinds[random() % kinds.size()];
      const bool list = random() % 2 == 0;
      others += fmt::format("property {}{} q{}\n", list ? "list ushort " : "", name, i);
      properties.emplace_back(list, size);
    }
    for (const Vec3& corner : kCorners) putVec(body, corner, big_endian);
    for (const auto& face : kFaces) {
      body += '\3';
      for (const int corner : face) put(body, std::int32_t{corner}, big_endian);
      for (const auto& [list, size] : properties) {
        const auto count = static_cast<std::uint16_t>(list ? random() % 300 : 1);
        if (list) put(body, count, big_endian);
        body += std::string(count * size, '\1');
      }
    }
    header += "element face 4\nproperty list uchar int vertex_indices\n" + others + "end_header\n";
    EXPECT_EQ(loadModel(fileWith("walk.ply", header + body)).triangles.size(), 4u) << header;
    if (!refuses("walk.ply", header + body.substr(0, body.size() - 1 - random() % 5),
                 "it is cut: its header tells of 4"))
      ADD_FAILURE() << header;
  }
}

// As some programs write vertices without faces.
TEST(CheckPly, AListThatIsNowhereIsNoCut) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property list uchar uint vertex_indices\nend_header\n" +
      textOfCorners();
  EXPECT_EQ(loadModel(fileWith("nowhere.ply", ply)).points.size(), 4u);
}

TEST(CheckPly, LinesMayEndInTwoLetters) {
  std::string header = plyHeader("binary_little_endian"), ply = binaryPly(false);
  const std::string body = ply.substr(header.size());
  for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos; at += 2) header.replace(at, 1, "\r\n");
  EXPECT_EQ(loadModel(fileWith("two.ply", header + body)).triangles.size(), 4u);
  refuses("two.ply", header + body.substr(0, body.size() - 1), "and it has 3");
}

}  // namespace
}  // namespace hl::test_cut_files
