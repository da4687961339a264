// Files of points: what is in them comes out as the formats say, and what is broken gives one line.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/file_ending.h"
#include "io/load_model.h"
#include "io/load_scene.h"
#include "io/lzf.h"
#include "io/read_clouds.h"
#include "surfaces/point_cloud.h"
#include "temp_folder.h"

namespace hl::test_read_clouds {
namespace {

using test::fileWith;

class CloudTaker final : public CloudSink {
 public:
  void header(const CloudHeader& given) override {
    EXPECT_EQ(headers++, 0);
    head = given;
  }
  void points(const CloudPiece& piece) override {
    ASSERT_EQ(headers, 1);
    for (const auto& at : piece.steps)
      positions.push_back(head.lattice->origin + head.lattice->step.cwiseProduct(Vec3(at[0], at[1], at[2])));
    positions.insert(positions.end(), piece.positions.begin(), piece.positions.end());
    normals.insert(normals.end(), piece.normals.begin(), piece.normals.end());
    colours.insert(colours.end(), piece.colours.begin(), piece.colours.end());
  }
  void warn(const std::string& line) override { warnings.push_back(line); }

  CloudHeader head;
  int headers = 0;
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> normals;
  std::vector<Rgb> colours;
  std::vector<std::string> warnings;
};

CloudTaker taken(const std::string& name, const std::string& bytes) {
  const std::string path = fileWith(name, bytes);
  CloudTaker taker;
  readCloud({path, endingOf(path), false}, taker);
  return taker;
}

std::string refusal(const std::string& name, const std::string& bytes) {
  try {
    taken(name, bytes);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

template <typename Number>
std::string bytesOf(Number number, bool swap = false) {
  std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
  if (swap) bytes.assign(bytes.rbegin(), bytes.rend());
  return bytes;
}

const std::vector<Vec3> kPoints{{1, 2, 3}, {-4, 5.5, 6}, {0.25, -8, 9}};

void expectPoints(const CloudTaker& cloud, bool normals) {
  ASSERT_EQ(cloud.positions, kPoints);
  ASSERT_EQ(cloud.normals.size(), normals ? 3U : 0U);
  EXPECT_TRUE(cloud.colours.empty());
  for (const std::uint32_t normal : cloud.normals) EXPECT_LT((unpackNormal(normal) - Vec3::UnitY()).norm(), 1e-4);
}

// A number before and after the coordinates, and normals.
std::string records(bool swap, bool normals) {
  std::string bytes;
  for (const Vec3& p : kPoints) {
    bytes += bytesOf(std::uint8_t{7});
    for (const double x : p) bytes += bytesOf(static_cast<float>(x), swap);
    for (const double n : {0.0, 2.0, 0.0}) bytes += normals ? bytesOf(n, swap) : "";
    bytes += bytesOf(std::uint16_t{9}, swap);
  }
  return bytes;
}

std::string plyHeader(const std::string& format, bool normals) {
  std::string text = "ply\nformat " + format + " 1.0\ncomment by a test\nelement vertex 3\nproperty uchar red\n";
  for (const char* name : {"x", "y", "z"}) text += std::string("property float ") + name + "\n";
  for (const char* name : {"nx", "ny", "nz"}) text += normals ? std::string("property double ") + name + "\n" : "";
  return text + "property ushort quality\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST(ReadClouds, PlyOfPoints) {
  for (const bool normals : {false, true}) {
    expectPoints(taken("a.ply", plyHeader("binary_little_endian", normals) + records(false, normals)), normals);
    expectPoints(taken("a.ply", plyHeader("binary_big_endian", normals) + records(true, normals)), normals);
  }
  expectPoints(taken("a.ply", plyHeader("ascii", false) + "7 1 2 3 9\n7 -4 5.5 6 9\r\n7 .25 -8 9 9\n"), false);
  EXPECT_TRUE(isPlyOfPoints(fileWith("a.ply", plyHeader("ascii", false))));
  EXPECT_FALSE(isPlyOfPoints(fileWith("a.ply",
                                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                      "element face 1\nproperty list uchar int v\nend_header\n")));
}

const std::vector<Rgb> kColours{{255, 0, 128}, {1, 2, 3}, {0, 254, 255}};

// Of three points at 0 0 0, 1 0 0 and 2 0 0; `value` makes a number of a part of a colour.
template <typename Value>
std::string colouredPly(const std::string& type, const Value& value) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n";
  for (const char* name : {"x", "y", "z"}) bytes += std::string("property float ") + name + "\n";
  for (const char* name : {"red", "green", "blue"}) bytes += "property " + type + " " + name + "\n";
  bytes += "property uchar alpha\nend_header\n";
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    for (const float x : {static_cast<float>(i), 0.0F, 0.0F}) bytes += bytesOf(x);
    for (const std::uint8_t part : kColours[i]) bytes += bytesOf(value(part));
    bytes += '\xff';
  }
  return bytes;
}

TEST(ReadClouds, PlyHasColours) {
  EXPECT_EQ(taken("a.ply", colouredPly("uchar", [](std::uint8_t part) { return part; })).colours, kColours);
  const auto wide = [](std::uint8_t part) { return static_cast<std::uint16_t>(257 * part); };
  EXPECT_EQ(taken("a.ply", colouredPly("ushort", wide)).colours, kColours);
  EXPECT_EQ(taken("a.ply", colouredPly("float", [](std::uint8_t part) { return part / 255.0F; })).colours, kColours);
  const auto no_colour = [](std::uint8_t part) { return static_cast<std::int32_t>(part); };
  EXPECT_TRUE(taken("a.ply", colouredPly("int", no_colour)).colours.empty());
  const auto wild = [](std::uint8_t part) { return part == 0 ? NAN : part == 255 ? INFINITY : -1.0F; };
  EXPECT_EQ(taken("a.ply", colouredPly("float", wild)).colours[0], (Rgb{255, 0, 0}));
}

// An element before the vertices, of two numbers with a list after each: of no number, and of some.
std::string listsBefore(const std::string& format, bool swap, std::uint8_t length) {
  std::string ply = plyHeader(format, false);
  ply.insert(ply.find("element vertex"),
             "element view 2\nproperty short a\nproperty list uchar double b\nproperty int c\n"
             "property list ushort short d\n");
  for (int i = 0; i < 2; ++i) {
    if (format == "ascii") {
      ply += "1 0 2 3 7 8 9\n";
      continue;
    }
    ply += bytesOf(std::int16_t{1}, swap) + std::string(1, static_cast<char>(length));
    for (std::uint8_t n = 0; n < length; ++n) ply += bytesOf(1.0, swap);
    ply += bytesOf(std::int32_t{2}, swap) + bytesOf(std::uint16_t{3}, swap);
    for (std::int16_t n = 0; n < 3; ++n) ply += bytesOf(n, swap);
  }
  return ply;
}

TEST(ReadClouds, PlyMayHaveListsBeforeItsVertices) {
  for (const std::uint8_t length : {0, 1, 200}) {
    expectPoints(taken("a.ply", listsBefore("binary_little_endian", false, length) + records(false, false)), false);
    expectPoints(taken("a.ply", listsBefore("binary_big_endian", true, length) + records(true, false)), false);
  }
  expectPoints(taken("a.ply", listsBefore("ascii", false, 0) + "7 1 2 3 9\n7 -4 5.5 6 9\r\n7 .25 -8 9 9\n"), false);
  const std::string whole = listsBefore("binary_little_endian", false, 3);
  for (std::size_t lost = 1; lost < 40; ++lost)
    EXPECT_EQ(refusal("a.ply", whole.substr(0, whole.size() - lost)), "ends before its last sample");
}

TEST(ReadClouds, BrokenPlyIsRefused) {
  const std::string whole = plyHeader("binary_little_endian", true) + records(false, true);
  EXPECT_EQ(refusal("a.ply", whole.substr(0, whole.size() - 1)), "ends before its last sample");
  EXPECT_EQ(refusal("a.ply", plyHeader("ascii", false) + "7 1 2 3 9\n"), "ends before its last sample");
  EXPECT_EQ(refusal("a.ply", plyHeader("ascii", false) + "7 1 x 3 9\n"),
            "is not a PLY file: 'x' is no number for a point");
  EXPECT_EQ(refusal("a.ply", plyHeader("morse", false)), "is no sound PLY file: its format is 'morse'");
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nend_header\n1\n"),
            "has points without x, y and z");
  EXPECT_EQ(refusal("a.ply", "ply\nelement vertex 3\n"), "is no sound PLY file: its header has no line end_header");
}

std::string pcdHeader(const std::string& data, bool normals) {
  std::string text = "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y z" +
                     std::string(normals ? " normal_x normal_y normal_z" : "") + " label\nSIZE 1 4 4 4" +
                     (normals ? " 8 8 8" : "") + " 2\nTYPE U F F F" + (normals ? " F F F" : "") + " U\nCOUNT 1 1 1 1" +
                     (normals ? " 1 1 1" : "") + " 1\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA " +
                     data + "\n";
  return text;
}

std::string colouredPcd(const std::string& name, char type, const std::string& data) {
  return "FIELDS x y z " + name + "\nSIZE 4 4 4 4\nTYPE F F F " + type +
         "\nCOUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA " + data + "\n";
}

// One number, or a float with the bits of one.
TEST(ReadClouds, PcdHasColours) {
  std::string bytes, whole, real;
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    const std::uint32_t packed = 0x3f000000U | packRgb(kColours[i]);  // the highest byte does not count
    float same_bits = 0;
    std::memcpy(&same_bits, &packed, sizeof packed);
    for (const float x : {static_cast<float>(i), 0.0F, 0.0F}) bytes += bytesOf(x);
    bytes += bytesOf(packed);
    whole += std::to_string(i) + " 0 0 " + std::to_string(packed) + "\n";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%zu 0 0 %.9g\n", i, static_cast<double>(same_bits));
    real += text.data();
  }
  for (const std::string name : {"rgb", "rgba"}) {
    for (const char type : {'F', 'U'})
      EXPECT_EQ(taken("a.pcd", colouredPcd(name, type, "binary") + bytes).colours, kColours) << name << type;
    EXPECT_EQ(taken("a.pcd", colouredPcd(name, 'U', "ascii") + whole).colours, kColours) << name;
    EXPECT_EQ(taken("a.pcd", colouredPcd(name, 'F', "ascii") + real).colours, kColours) << name;
  }
  EXPECT_TRUE(taken("a.pcd", colouredPcd("label", 'U', "binary") + bytes).colours.empty());
}

// Runs as they are, and one copy: five of the same letter.
std::string lzf(const std::string& bytes) {
  std::string packed;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string run = bytes.substr(at, 32);
    packed += static_cast<char>(run.size() - 1);
    packed += run;
  }
  return packed;
}

TEST(ReadClouds, Pcd) {
  for (const bool normals : {false, true})
    expectPoints(taken("a.pcd", pcdHeader("binary", normals) + records(false, normals)), normals);
  expectPoints(taken("a.pcd", pcdHeader("ascii", false) + "7 1 2 3 9\n7 -4 5.5 6 9\n7 .25 -8 9 9\n"), false);
  EXPECT_EQ(taken("a.pcd", pcdHeader("ascii", false) + "7 nan nan nan 9\n7 1 2 3 9\n7 inf 1 1 9\n").positions.size(),
            1U);
}

// Unpacked, all numbers of a field follow each other.
TEST(ReadClouds, PackedPcd) {
  std::string fields(3, '\7');
  for (int axis = 0; axis < 3; ++axis) {
    for (const Vec3& p : kPoints) fields += bytesOf(static_cast<float>(p[axis]));
  }
  fields += std::string(6, '\0');
  const std::string packed = lzf(fields);
  const auto sizes = [&](std::size_t all) {
    return bytesOf(static_cast<std::uint32_t>(packed.size())) + bytesOf(static_cast<std::uint32_t>(all));
  };
  const std::string header = pcdHeader("binary_compressed", false);
  expectPoints(taken("a.pcd", header + sizes(fields.size()) + packed), false);
  EXPECT_EQ(refusal("a.pcd", header + sizes(1000) + packed), "is no sound PCD file: it has 1000 bytes for 3 points");
  EXPECT_EQ(refusal("a.pcd", header + sizes(fields.size()) + packed.substr(0, 20)), "ends before its last sample");
}

TEST(ReadClouds, LzfCopiesWhatCameBefore) {
  const std::string packed{'\2', 'a',    'b',  'c', '\x60',
                           '\2', '\xe0', '\1', '\0'};  // 3 + 2 back by 3; 7 + 1 + 2 back by 1
  std::string out(3 + 5 + 10, ' ');
  unpackLzf(packed, out);
  EXPECT_EQ(out, "abcabcabbbbbbbbbbb");
  for (std::size_t i = 0; i < packed.size(); ++i)
    EXPECT_THROW(unpackLzf(std::string_view(packed).substr(0, i), out), Error);
  std::string small(17, ' ');
  EXPECT_THROW(unpackLzf(packed, small), Error);
  EXPECT_THROW(unpackLzf(std::string{'\x20', '\0'}, out), Error) << "nothing came before";
}

TEST(ReadClouds, BrokenPcdIsRefused) {
  EXPECT_EQ(refusal("a.pcd", pcdHeader("binary", false) + records(false, false).substr(1)),
            "ends before its last sample");
  EXPECT_EQ(refusal("a.pcd", "FIELDS x y z\nSIZE 4 4\n"), "is no sound PCD file: SIZE needs a word for each of FIELDS");
  EXPECT_EQ(refusal("a.pcd", "FIELDS x y z\n"), "is no sound PCD file: its header has no line DATA");
  EXPECT_EQ(refusal("a.pcd", "FIELDS a b\nPOINTS 3\nDATA ascii\n"), "has points without x, y and z");
  EXPECT_EQ(refusal("a.pcd", "FIELDS x y z\nPOINTS many\n"), "is no sound PCD file: 'many' is no number");
  EXPECT_EQ(refusal("a.pcd", "FIELDS x y z\nPOINTS 1\nDATA zip\n"),
            "is no sound PCD file: its DATA is 'zip', not ascii, binary or binary_compressed");
}

struct Las {
  int minor = 2, format = 0;
  std::size_t record_bytes = 20;
  bool packed = false;
  std::vector<std::array<std::int32_t, 3>> points{{100, 200, 300}, {-1, 0, 1}, {2147483647, -2147483647 - 1, 5}};

  std::string bytes() const {
    const std::size_t size = minor >= 4 ? 375 : 227, first = size + 54;  // a record between
    std::string all(first, '\0');
    const auto put = [&](std::size_t at, const auto& value) { std::memcpy(all.data() + at, &value, sizeof value); };
    std::memcpy(all.data(), "LASF", 4);
    put(24, std::uint8_t{1});
    put(25, static_cast<std::uint8_t>(minor));
    put(94, static_cast<std::uint16_t>(size));
    put(96, static_cast<std::uint32_t>(first));
    put(104, static_cast<std::uint8_t>(format + (packed ? 128 : 0)));
    put(105, static_cast<std::uint16_t>(record_bytes));
    put(107, static_cast<std::uint32_t>(minor >= 4 ? 0 : points.size()));
    put(131, std::array<double, 6>{0.01, 0.01, 0.001, 500'000, 4'100'000, 0});
    if (minor >= 4) put(247, static_cast<std::uint64_t>(points.size()));
    for (const auto& point : points) {
      const std::size_t at = all.size();
      all.append(record_bytes, '\0');
      put(at, point);
    }
    return all;
  }
};

TEST(ReadClouds, LasOfAllFormats) {
  constexpr std::array<std::size_t, 11> kRecordBytes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  for (int format = 0; format < 11; ++format) {
    Las las;
    las.minor = format < 4 ? format : 4;
    las.format = format;
    las.record_bytes = kRecordBytes[static_cast<std::size_t>(format)] + (format % 2 == 0 ? 0 : 5);
    const CloudTaker cloud = taken("a.las", las.bytes());
    ASSERT_EQ(cloud.positions.size(), 3U) << format;
    EXPECT_LT((cloud.positions[0] - Vec3(500'001, 4'100'002, 0.3)).norm(), 1e-9);
    EXPECT_EQ(cloud.head.turn * Vec3(1, 2, 3), Vec3(1, 3, -2)) << "east, up, south";
  }
}

// At their places in the formats that have colours; of 16 bits, of 8 of them, and of none.
TEST(ReadClouds, LasHasColours) {
  struct Format {
    int number;
    std::size_t bytes, at;
  };
  for (const Format& format : {Format{2, 26, 20}, {3, 34, 28}, {5, 63, 28}, {7, 36, 30}, {8, 38, 30}, {10, 67, 30}}) {
    Las las;
    las.minor = 4;
    las.format = format.number;
    las.record_bytes = format.bytes;
    const std::string plain = las.bytes();
    const auto with = [&](unsigned factor) {
      std::string bytes = plain;
      for (std::size_t i = 0; i < kColours.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto part = static_cast<std::uint16_t>(factor * kColours[i][k]);
          std::memcpy(&bytes[plain.size() - (3 - i) * format.bytes + format.at + 2 * k], &part, sizeof part);
        }
      }
      return bytes;
    };
    EXPECT_EQ(taken("a.las", with(257)).colours, kColours) << format.number;
    EXPECT_EQ(taken("a.las", with(256)).colours, kColours) << format.number;
    EXPECT_EQ(taken("a.las", with(1)).colours, kColours) << format.number;
    EXPECT_TRUE(taken("a.las", with(0)).colours.empty()) << "where all are black there are none";
    EXPECT_EQ(taken("a.las", with(257)).positions, taken("a.las", plain).positions);
  }
}

TEST(ReadClouds, BrokenLasIsRefused) {
  const std::string whole = Las().bytes();
  EXPECT_EQ(refusal("a.las", whole.substr(0, whole.size() - 1)), "ends before its last sample");
  EXPECT_EQ(refusal("a.las", whole.substr(0, 100)), "ends before its last sample");
  EXPECT_EQ(refusal("a.las", "LAZY" + whole.substr(4)), "is not a LAS file");
  Las packed, odd;
  packed.packed = true;
  EXPECT_EQ(refusal("a.las", packed.bytes()),
            "is packed LAS, which cannot be read: unpack it, as in laszip -i a.laz -o a.las");
  odd.format = 11;
  EXPECT_EQ(refusal("a.las", odd.bytes()), "has points of format 11 in 20 bytes: formats 0 to 10 can be read");
  std::string flat = whole;
  std::memset(flat.data() + 131, 0, 8);
  EXPECT_EQ(refusal("a.las", flat), "is no sound LAS file: its scale is not above 0, or its offset is no number");
}

TEST(ReadClouds, DeletedPointsOfLasAreLeftOut) {
  std::string bytes = Las().bytes();
  bytes[227 + 54 + 20 + 15] = '\x80';
  const CloudTaker cloud = taken("a.las", bytes);
  EXPECT_EQ(cloud.positions.size(), 2U);
  EXPECT_EQ(cloud.warnings, std::vector<std::string>{"left out 1 points that are marked as withheld"});
}

TEST(ReadClouds, Xyz) {
  expectPoints(taken("a.xyz", "3\n# x y z\n1 2 3\n-4,5.5,6\n\n.25;-8;9;255\n"), false);
  expectPoints(taken("a.xyz", "1 2 3 0 1 0\n-4 5.5 6 0 1 0\n.25 -8 9 0 1 0\n"), true);
  expectPoints(taken("a.xyz", "\xef\xbb\xbf\"X\", \"Y\", \"Z\"\n1, 2, 3\n-4, 5.5, 6\n.25, -8, 9\n"), false);
  expectPoints(taken("a.xyz", "// by a scanner\n//X Y Z\n\n3\n1 2 3\n-4 5.5 6\n.25 -8 9\n"), false);
  expectPoints(taken("a.xyz", "# metres\nx y z\n1 2 3\n-4 , 5.5 , 6\n.25 -8 9\n"), false);
  EXPECT_EQ(refusal("a.xyz", "1,2,3\n4,,5,6\n"), "is no list of points: line 2 is '4,,5,6', and a point is x y z");
  EXPECT_EQ(refusal("a.xyz", "1,2,3\n,4,5,6\n"), "is no list of points: line 2 is ',4,5,6', and a point is x y z");
  EXPECT_EQ(refusal("a.xyz", "id,x,y\n0,1,2\n"), "is no list of points: line 1 is 'id,x,y', and a point is x y z");
  EXPECT_EQ(refusal("a.xyz", "id,x,y,z\n0,1,2\n"), "is no list of points: line 2 is '0,1,2', and a point is x y z");
  EXPECT_EQ(refusal("a.xyz", "3\nwater\nO 0 0 0\n"), "is no list of points: line 2 is 'water', and a point is x y z");
}

void expectColours(const CloudTaker& cloud, const std::vector<Rgb>& colours, bool normals = false) {
  ASSERT_EQ(cloud.positions, kPoints);
  EXPECT_EQ(cloud.normals.size(), normals ? 3U : 0U);
  EXPECT_EQ(cloud.colours, colours);
}

const std::vector<Rgb> kTextColours{{255, 0, 12}, {0, 1, 0}, {7, 200, 99}};

TEST(ReadClouds, WhatColumnsOfTextHoldIsSeenFromTheirNumbers) {
  expectColours(taken("a.xyz", "1 2 3 255 0 12\n-4 5.5 6 0 1 0\n.25 -8 9 7 200 99"), kTextColours);
  expectColours(taken("a.pts", "3\n1 2 3 -1870 255 0 12\n-4 5.5 6 310 0 1 0\n.25 -8 9 0 7 200 99"), kTextColours);
  const std::string normals[]{" 0 0 1", " 0.6 0 0.8", " 0 -1 0"};
  const std::string colours[]{" 255 0 12", " 0 1 0", " 7 200 99"};
  const std::string places[]{"\n1 2 3", "\n-4 5.5 6", "\n.25 -8 9"};
  std::string before, after;
  for (std::size_t i = 0; i < 3; ++i) {
    before += places[i] + colours[i] + normals[i];
    after += places[i] + normals[i] + colours[i];
  }
  expectColours(taken("a.xyz", before), kTextColours, true);
  expectColours(taken("a.xyz", after), kTextColours, true);
  // Which three of four numbers are meant is not known; what is all 0, above 255 or has a fraction is no colour.
  for (const std::string rest : {" 1 2 3 4", " 0 0 0", " 1 2 256", " 1 2 0.5", " 1 2 -1", " 1 2"})
    expectPoints(taken("a.xyz", places[0] + rest + places[1] + rest + places[2] + rest), false);
  // One line is shorter.
  expectPoints(taken("a.xyz", "1 2 3 255 0 12\n-4 5.5 6\n.25 -8 9 7 200 99"), false);
}

TEST(ReadClouds, ColumnsOfTextAreWhatTheirNamesSay) {
  const std::string colours = "0,1,2,3,255,0,12\n1,-4,5.5,6,0,1,0\n2,.25,-8,9,7,200,99\n";
  expectColours(taken("a.xyz", "id,x,y,z,Red,Green,Blue\n" + colours), kTextColours);
  expectColours(taken("a.xyz", "\"ID\";\"X\";\"Y\";\"Z\";\"R\";\"G\";\"B\"\n" + colours), kTextColours);
  expectPoints(taken("a.xyz", "id,x,y,z,class,returns,angle\n" + colours), false);
  expectColours(taken("a.xyz",
                      "//X Y Z R G B Nx Ny Nz\n3\n1 2 3 255 0 12 0 0 1\n-4 5.5 6 0 1 0 0 0 1\n.25 -8 9 7 200 "
                      "99 0 0 1\n"),
                kTextColours, true);
  // Of the numbers of the colours, too, which are 0 to 1 or of 16 bits.
  expectColours(taken("a.xyz", "x y z r g b\n1 2 3 1 0 0.2\n-4 5.5 6 0 1 0\n.25 -8 9 0.5 0.1 0\n"),
                {{255, 0, 51}, {0, 255, 0}, {128, 26, 0}});
  expectColours(taken("a.xyz", "x y z r g b\n1 2 3 65535 0 257\n-4 5.5 6 0 514 0\n.25 -8 9 0 0 771\n"),
                {{255, 0, 1}, {0, 2, 0}, {0, 0, 3}});
  // No names: x, y and z are not the first of them.
  expectPoints(taken("a.xyz", "# here z is up, x east and y north\n1 2 3\n-4 5.5 6\n.25 -8 9\n"), false);
  EXPECT_EQ(refusal("a.xyz", "x y z x\n1 2 3 4\n"), "is no list of points: line 1 is 'x y z x', and a point is x y z");
}

TEST(ReadClouds, TextMayHaveDecimalCommas) {
  expectPoints(taken("a.xyz", "1,0 2,0 3\n-4 5,5 6\n0,25 -8 9,0\n"), false);
  expectPoints(taken("a.xyz", "X;Y;Z\n1;2;3\n-4;5,5;6\n0,25;-8;9\n"), false);
  expectColours(taken("a.xyz", "1 2 3 255 0 12\n-4 5,5 6 0 1 0\n0,25 -8 9 7 200 99\n"), kTextColours);
  expectPoints(taken("a.xyz", "1,2,3\n-4,5.5,6\n.25,-8,9\n"), false);
  EXPECT_EQ(refusal("a.xyz", "1,5 2,5 3,5\n1 2,5,5 3\n"),
            "is no list of points: line 2 is '1 2,5,5 3', and a point is x y z");
}

std::string loadRefusal(const std::string& path) {
  try {
    loadScene(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Through the child process, as users have it.
TEST(ReadClouds, AFileBecomesACloud) {
  const SceneModel scene =
      loadModelScene(fileWith("far.las", Las{2, 0, 20, false, {{0, 0, 0}, {100, 0, 0}, {0, 100, 50}}}.bytes()));
  ASSERT_EQ(scene.surfaces.size(), 1U);
  const auto& cloud = dynamic_cast<const PointCloud&>(*scene.surfaces[0].source);
  EXPECT_EQ(cloud.points()->size(), 3U);
  EXPECT_EQ(cloud.error_m(), 0);
  EXPECT_LT(cloud.bounds().centre().norm(), 1e-9);
  EXPECT_LT((cloud.bounds().size() - Vec3(1, 0.05, 1)).norm(), 1e-9);
  ASSERT_EQ(scene.model.warnings.size(), 1U);
  EXPECT_EQ(scene.model.warnings[0],
            "lies far from the origin of its file: its middle, 500000.5 4100000.5 0.025 there, is put at the origin");
}

TEST(ReadClouds, ItsColoursComeAlong) {
  const std::string path = fileWith("a.ply", colouredPly("uchar", [](std::uint8_t part) { return part; }));
  const SceneModel scene = loadModelScene(path);
  const auto& cloud = dynamic_cast<const PointCloud&>(*scene.surfaces.at(0).source);
  ASSERT_TRUE(cloud.hasColours());
  const CloudPoints& points = *cloud.points();
  ASSERT_EQ(points.size(), 3U);
  for (std::size_t block = 0; block < points.blocks(); ++block) {
    for (std::size_t i = 0; i < points.countIn(block); ++i) {
      const std::size_t slot = CloudPoints::kPerBlock * block + i;
      EXPECT_EQ(points.colour(slot), kColours[static_cast<std::size_t>(std::lround(cloud.corners(slot)[0].x()))]);
    }
  }
}

TEST(ReadClouds, WhatCannotBeReadSaysWhatToDo) {
  const std::string laz = fileWith("a.laz", "LASF"), e57 = fileWith("a.e57", "ASTM-E57");
  EXPECT_EQ(loadRefusal(laz), laz + ": is packed LAS, which cannot be read: unpack it, as in laszip -i a.laz -o a.las");
  EXPECT_EQ(loadRefusal(e57), e57 + ": is E57, which cannot be read: convert it to PLY or LAS, as CloudCompare does");
  for (const char* ending : {".txt", ".csv"}) {
    const std::string table = fileWith(std::string("table") + ending, "0 0 0\n");
    EXPECT_EQ(loadRefusal(table), table + ": files ending in '" + ending +
                                      "' cannot be read; a list of points, x y z on each line, can if it is renamed to "
                                      "end in .xyz");
  }
  const std::string none = fileWith("none.xyz", "# nothing\n");
  EXPECT_EQ(loadRefusal(none), none + ": there are no points in it");
}

// Of 30 x 30 points, so far apart, in a file of text.
std::string gridOfPoints(double apart, double from) {
  std::string text;
  for (int i = 0; i < 900; ++i)
    text += fmt::format("{:.17g} {:.17g} 0\n", from + apart * (i % 30), from + apart * (i / 30));
  return text;
}

TEST(ReadClouds, PointsThatAreTooNearEachOtherAreNotToldToBeStray) {
  const std::string tiny = loadRefusal(fileWith("tiny.xyz", gridOfPoints(1e-19, 0)));
  EXPECT_NE(tiny.find("899 of its 900 points would be one with others"), std::string::npos) << tiny;
  EXPECT_NE(tiny.find("m, and all of them lie within 2.9e-18 m around 1.45e-18 1.45e-18 0: check that they are in "
                      "metres, and near the origin"),
            std::string::npos)
      << tiny;
  const std::string stray = loadRefusal(fileWith("stray.xyz", gridOfPoints(1e-6, 0) + "5e5 0 0\n"));
  EXPECT_NE(stray.find("as the point 500000 0 0 lies so far from the rest"), std::string::npos) << stray;
  EXPECT_TRUE(stray.ends_with("; remove the stray points")) << stray;
}

TEST(ReadClouds, PlyOfPointsWithListsIsAMeshThatSaysSo) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty list uchar int seen\nproperty float y\n"
      "property float z\n";
  const std::string points = fileWith("lists.ply", head + "end_header\n1 2 7 8 2 3\n4 0 5 6\n");
  const std::string why =
      "its vertices have a list among their properties: they are the points of a mesh, and no cloud; save them without "
      "lists for one";
  const SceneModel scene = loadModelScene(points);
  EXPECT_EQ(scene.model.points.size(), 2U);
  EXPECT_EQ(scene.model.warnings, std::vector<std::string>{why});
  EXPECT_TRUE(loadModel(points).warnings.empty()) << "as a mesh it is what is asked for";
  const std::string faces =
      fileWith("faces.ply", head +
                                "element face 1\nproperty list uchar int vertex_indices\nend_header\n1 0 2 3\n"
                                "4 0 5 6\n2 0 1\n");
  EXPECT_TRUE(loadModelScene(faces).model.warnings.empty());
  const std::string in_scene =
      loadRefusal(fileWith("listed.hl.json", R"({"objects": [{"cloud": {"file": "lists.ply"}}]})"));
  EXPECT_NE(in_scene.find("lists.ply: is no cloud of points: " + why), std::string::npos) << in_scene;
}

// A file that was not made here, from the package assimp-testmodels.
TEST(ReadClouds, ARealPlyOfPoints) {
  const std::string path = "/usr/share/assimp/models/PLY/points.ply";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const SceneModel scene = loadModelScene(path);
  ASSERT_EQ(scene.surfaces.size(), 1U);
  EXPECT_EQ(dynamic_cast<const PointCloud&>(*scene.surfaces[0].source).points()->size(), 4U);
  EXPECT_EQ(loadModel(path).points.size(), 4U) << "as a mesh its points are primitives of it";
}

}  // namespace
}  // namespace hl::test_read_clouds
