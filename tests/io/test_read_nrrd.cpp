// NRRD files: types, encodings and spaces come out as the format says, and what is broken gives one line.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "io/volume_taker.h"
#include "temp_folder.h"

namespace hl::test_read_nrrd {
namespace {

using test::fileWith;
using test::packed;
using test::testSample;
using test::volumeIn;
using test::VolumeTaker;

constexpr std::array<std::size_t, 3> kSide{5, 4, 3};
constexpr bool kLittle = false;

std::string headerWith(const std::string& type, const std::string& rest, const std::string& sizes = "5 4 3") {
  return "NRRD0004\n# by a test\ntype: " + type + "\ndimension: 3\nsizes: " + sizes + "\n" + rest;
}
std::string fileOf(const std::string& rest, const std::string& sizes = "5 4 3") {
  return headerWith("short", "encoding: raw\nendian: little\n" + rest, sizes) + "\n" +
         test::testSamples<std::int16_t>(kSide, kLittle);
}
VolumeTaker taken(const std::string& bytes) { return volumeIn(fileWith("a.nrrd", bytes)); }
std::string refusal(const std::string& bytes) { return test::volumeRefusalOf(fileWith("a.nrrd", bytes)); }

void expectSamples(const VolumeTaker& volume) {
  ASSERT_EQ(volume.header().side, (std::array<std::uint32_t, 3>{5, 4, 3}));
  ASSERT_TRUE(volume.whole());
  for (std::size_t z = 0; z < 3; ++z) {
    for (std::size_t y = 0; y < 4; ++y) {
      for (std::size_t x = 0; x < 5; ++x)
        ASSERT_EQ(volume.at(x, y, z), testSample(x, y, z)) << x << " " << y << " " << z;
    }
  }
}

std::string textSamples() {
  std::string text;
  for (std::size_t n = 0; n < 60; ++n)
    text += std::to_string(testSample(n % 5, n / 5 % 4, n / 20)) + (n % 5 == 4 ? "\n" : " ");
  return text;
}

template <typename Number>
void expectType(const std::string& name, SampleKind kind) {
  for (const bool big : {false, true}) {
    const std::string endian = big ? "endian: big\n" : "endian: little\n";
    const std::string samples = test::testSamples<Number>(kSide, big);
    const VolumeTaker raw = taken(headerWith(name, "encoding: raw\n" + endian + "\n") + samples);
    expectSamples(raw);
    EXPECT_EQ(raw.header().kind, kind) << name;
    expectSamples(taken(headerWith(name, "encoding: gzip\n" + endian + "\n") + packed(samples)));
    expectSamples(taken(headerWith(name, "encoding: ascii\n\n") + textSamples()));
  }
}

TEST(ReadNrrd, EveryTypeInEveryEncoding) {
  for (const char* const name : {"signed char", "int8", "int8_t"}) expectType<std::int8_t>(name, SampleKind::kInt16);
  for (const char* const name : {"uchar", "unsigned char", "uint8"})
    expectType<std::uint8_t>(name, SampleKind::kUint16);
  for (const char* const name : {"short", "Signed Short Int", "int16_t"})
    expectType<std::int16_t>(name, SampleKind::kInt16);
  for (const char* const name : {"ushort", "unsigned short int", "uint16"})
    expectType<std::uint16_t>(name, SampleKind::kUint16);
  for (const char* const name : {"int", "int32"}) expectType<std::int32_t>(name, SampleKind::kFloat32);
  for (const char* const name : {"uint", "unsigned int"}) expectType<std::uint32_t>(name, SampleKind::kFloat32);
  expectType<float>("float", SampleKind::kFloat32);
  expectType<double>("double", SampleKind::kFloat32);
}

TEST(ReadNrrd, SpacesOfPatients) {
  const std::string steps = "space directions: (0,0.5,0) (0,0,0.7) (2,0,0.1)\nspace origin: (9,9,9)\n";
  const std::pair<const char*, Vec3> spaces[] = {{"right-anterior-superior", {1, 1, 1}},
                                                 {"RAS", {1, 1, 1}},
                                                 {"left-anterior-superior", {-1, 1, 1}},
                                                 {"left-posterior-superior", {-1, -1, 1}},
                                                 {"LPS", {-1, -1, 1}}};
  for (const auto& [name, sign] : spaces) {
    const VolumeTaker volume = taken(fileOf("space: " + std::string(name) + "\n" + steps));
    const GridFrame& frame = volume.header().frame;
    EXPECT_LT((frame.axes.col(0) - 1e-3 * Vec3(0, 0, -0.5 * sign.y())).norm(), 1e-18) << name;
    EXPECT_LT((frame.axes.col(1) - 1e-3 * Vec3(0, 0.7, 0)).norm(), 1e-18) << name;
    EXPECT_LT((frame.axes.col(2) - 1e-3 * Vec3(2 * sign.x(), 0.1, 0)).norm(), 1e-18) << name;
    EXPECT_LT(frame.point(2, 1.5, 1).norm(), 1e-18);
    EXPECT_TRUE(volume.warnings().empty());
  }
}

TEST(ReadNrrd, SpacesThatAreNoPatients) {
  const VolumeTaker spaced = taken(fileOf("spacings: 1 2 3\nunits: \"cm\" \"cm\" \"cm\"\n"));
  EXPECT_LT((spaced.header().frame.axes - Mat3(Vec3(0.01, 0.02, 0.03).asDiagonal())).norm(), 1e-17);
  EXPECT_TRUE(spaced.warnings().empty());
  const VolumeTaker turned = taken(fileOf(
      "space dimension: 3\nspace units: \"um\" \"um\" \"um\"\nspace directions: (0, 1, 0) (1, 0, 0) (0, 0, 4)\n"));
  EXPECT_NEAR(turned.header().frame.axes(1, 0), 1e-6, 1e-20);
  EXPECT_NEAR(turned.header().frame.axes(2, 2), 4e-6, 1e-20);
  const VolumeTaker bare = taken(fileOf(""));
  EXPECT_EQ(bare.warnings().size(), 2U);
  EXPECT_EQ(bare.header().frame.axes(2, 2), 1e-3);
}

// A min and a max are of the outer samples where these are nodes, else of the outer sides of cells.
TEST(ReadNrrd, SpacingsFollowFromMinsAndMaxs) {
  const std::string units = "units: \"m\" \"m\" \"m\"\n", sides = "axis mins: 1 -2 3\naxis maxs: 5 2 0\n";
  const auto stepsOf = [&](const std::string& fields) {
    const VolumeTaker volume = taken(fileOf(units + fields));
    EXPECT_TRUE(volume.warnings().empty()) << fields;
    return Vec3(volume.header().frame.axes.diagonal());
  };
  EXPECT_EQ(stepsOf(sides + "centerings: node node node\n"), Vec3(1, 4.0 / 3, -1.5));
  EXPECT_EQ(stepsOf(sides + "centers: cell cell cell\n"), Vec3(0.8, 1, -1));
  EXPECT_EQ(stepsOf(sides + "centerings: cell node ???\n"), Vec3(0.8, 4.0 / 3, -1));
  EXPECT_EQ(stepsOf(sides), Vec3(0.8, 1, -1));
  EXPECT_EQ(stepsOf(sides + "spacings: nan 7 nan\n"), Vec3(0.8, 7, -1));
  EXPECT_EQ(taken(fileOf(units + "axis mins: 1 nan 3\naxis maxs: 5 2 0\n")).warnings(),
            std::vector<std::string>{"says nothing of the distance between its samples: 1"});
  EXPECT_EQ(refusal(fileOf("axis mins: 1 2\n")),
            "is not a sound NRRD file: it has not one axis min and max for each axis");
  EXPECT_EQ(refusal(fileOf("centerings: node\n")), "is not a sound NRRD file: it has not one centering for each axis");
  EXPECT_EQ(refusal(fileOf("axis mins: 1 1 1\naxis maxs: 1 2 2\n")),
            "says no distances and directions between its samples that could be");
}

// The samples of an axis may go backward: each lies where the spacing says.
TEST(ReadNrrd, ASpacingBelowZeroLeadsBackward) {
  const VolumeTaker volume = taken(fileOf("spacings: -1 1 2\nunits: \"m\" \"m\" \"m\"\n"));
  EXPECT_EQ(volume.header().frame.axes.diagonal(), Vec3(-1, 1, 2));
  EXPECT_EQ(volume.header().frame.origin, Vec3(2, -1.5, -2));
  expectSamples(volume);
}

TEST(ReadNrrd, ASpaceThatIsNotKnownIsAWarning) {
  const std::string units = "space units: \"mm\" \"mm\" \"mm\"\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n";
  EXPECT_EQ(taken(fileOf("space: left-handed-martian\n" + units)).warnings(),
            std::vector<std::string>{
                "has a space 'left-handed-martian', which is not known: x, y and z are taken as they are"});
  EXPECT_TRUE(taken(fileOf("space: scanner-xyz\n" + units)).warnings().empty());
}

TEST(ReadNrrd, AnAxisOfOneNumberIsNone) {
  const std::string start = "NRRD0005\ntype: short\ndimension: 4\nencoding: raw\nendian: little\n";
  const std::string samples = test::testSamples<std::int16_t>(kSide, kLittle);
  for (const std::string axes : {"sizes: 1 5 4 3\nspace: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,2)\n",
                                 "sizes: 5 4 3 1\nspace: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,2) none\n",
                                 "sizes: 1 5 4 3\nkinds: scalar domain domain domain\nspacings: nan 1 1 2\n"}) {
    const VolumeTaker volume = taken(start + axes + "\n" + samples);
    expectSamples(volume);
    EXPECT_DOUBLE_EQ(volume.header().frame.axes.col(2).norm(), 2e-3) << axes;
  }
}

TEST(ReadNrrd, TheFirstOfManyVolumes) {
  const std::string samples = test::testSamples<std::int16_t>(kSide, kLittle);
  const std::string start = "NRRD0005\ntype: short\ndimension: 4\nencoding: raw\nendian: little\n";
  const VolumeTaker volume = taken(start +
                                   "sizes: 5 4 3 2\nspace: left-posterior-superior\nkinds: domain domain domain list\n"
                                   "space directions: (1,0,0) (0,1,0) (0,0,1) none\nkey:=value: 3\n\n" +
                                   samples + samples);
  expectSamples(volume);
  EXPECT_EQ(volume.warnings(), std::vector<std::string>{"has 2 volumes: the first is read"});
  const std::string listed = "sizes: 2 5 4 3\nspace: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n\n";
  EXPECT_EQ(refusal(start + listed + samples + samples).find("has more than one number in each place"), 0U);
  EXPECT_EQ(refusal(start + "sizes: 3 5 4 3\nkinds: RGB-color domain domain domain\n\n" + samples + samples + samples)
                .find("has more than one number in each place"),
            0U);
}

TEST(ReadNrrd, SamplesInAnotherFile) {
  const std::string samples = test::testSamples<std::int16_t>(kSide, true);
  const std::string header = headerWith("short", "endian: big\n");
  fileWith("a.raw", "two\nlines\n" + samples);
  const std::string raw = fileWith("a.nhdr", header + "encoding: raw\nline skip: 2\ndata file: a.raw\n");
  expectSamples(volumeIn(raw));
  EXPECT_EQ(test::volumeRefusalOf(raw, true),
            "has its samples in 'a.raw', and a file comes alone: save both as one .nrrd");
  expectSamples(volumeIn(fileWith("b.nhdr", header + "encoding: raw\nbyte skip: -1\ndatafile: ./a.raw\n")));
  expectSamples(volumeIn(fileWith("b.nhdr", header + "encoding: raw\nbyte skip: 10\ndatafile: a.raw\n")));
  fileWith("a.raw.gz", packed("12345" + samples));
  expectSamples(volumeIn(fileWith("c.nhdr", header + "encoding: gzip\nbyte skip: 5\ndata file: a.raw.gz\n")));
  const auto refused = [&](const std::string& rest) {
    return test::volumeRefusalOf(fileWith("d.nhdr", header + rest));
  };
  EXPECT_EQ(refused("encoding: raw\ndata file: none.raw\n"), "names 'none.raw', and there is no such file");
  EXPECT_EQ(refused("encoding: raw\ndata file: a%02d.raw 1 3 1\n"),
            "has its samples in several files: save all as one .nrrd");
  EXPECT_EQ(refused("encoding: raw\nline skip: 1e18\ndata file: a.raw\n"), "ends before its last sample");
  EXPECT_EQ(refused("encoding: raw\nbyte skip: 1e9\ndata file: a.raw\n"), "ends before its last sample");
  EXPECT_EQ(refused("encoding: gzip\nbyte skip: -1\ndata file: a.raw.gz\n"),
            "is not a sound NRRD file: its byte skip is -1, which is for raw samples only");
  EXPECT_EQ(refused("encoding: raw\nbyte skip: -2\ndata file: a.raw\n"),
            "is not a sound NRRD file: its byte skip is -2");
  EXPECT_EQ(refused("encoding: raw\nbyte skip: 0.5\ndata file: a.raw\n"),
            "is not a sound NRRD file: its byte skip is 0.5");
  EXPECT_EQ(refused("encoding: raw\nline skip: -1\ndata file: a.raw\n"),
            "is not a sound NRRD file: its line skip is -1");
}

TEST(ReadNrrd, SamplesAtTheEndOfTheirFile) {
  const std::string samples = test::testSamples<std::int16_t>(kSide, kLittle);
  const std::string header = headerWith("short", "endian: little\nencoding: raw\nbyte skip: -1\n\n");
  expectSamples(taken(header + samples));
  expectSamples(taken(header + "what comes before them" + samples));
  EXPECT_EQ(refusal(header + samples.substr(1)), "ends before its last sample") << "a header is no sample";
  for (const std::string encoding : {"gzip", "ascii"})
    EXPECT_EQ(refusal(headerWith("short", "endian: little\nencoding: " + encoding + "\nbyte skip: -1\n\n")),
              "is not a sound NRRD file: its byte skip is -1, which is for raw samples only");
}

TEST(ReadNrrd, SamplesAreInTheFolderOfTheirHeader) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(test::tempFile("headers"));
  fs::create_directories(folder / "beneath");
  const auto put = [](const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
  };
  const std::string samples = test::testSamples<std::int16_t>(kSide, kLittle);
  const std::string outside = put(fs::path(test::tempFile("outside.raw")), samples);
  put(folder / "a.raw", samples);
  put(folder / "beneath" / "a.raw", samples);
  const auto headerOf = [&](const std::string& name) {
    return put(folder / "a.nhdr", headerWith("short", "endian: little\nencoding: raw\ndata file: " + name + "\n"));
  };
  std::error_code there_already;
  fs::create_symlink("a.raw", folder / "inner.raw", there_already);
  fs::create_symlink(outside, folder / "outer.raw", there_already);
  for (const char* name : {"a.raw", "./a.raw", "beneath/a.raw", "inner.raw"}) expectSamples(volumeIn(headerOf(name)));
  for (const std::string& name : {outside, (folder / "a.raw").string(), std::string("../outside.raw"),
                                  std::string("beneath/../a.raw"), std::string("outer.raw")})
    EXPECT_EQ(test::volumeRefusalOf(headerOf(name)),
              "names '" + name + "', which is not in its folder: put that file beside it");
  EXPECT_EQ(test::volumeRefusalOf(headerOf("beneath")), "names 'beneath', and there is no such file");
}

TEST(ReadNrrd, WhatIsBrokenGivesOneLine) {
  const std::string good = fileOf("space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"), raw = "encoding: raw\n";
  EXPECT_EQ(refusal(good.substr(0, good.size() - 1)), "ends before its last sample");
  EXPECT_EQ(refusal("NRRx"), "ends before its last sample");
  EXPECT_EQ(refusal("Some other text"), "is not a NRRD file");
  EXPECT_EQ(refusal(headerWith("block", raw + "\n")).find("has numbers of type 'block': "), 0U);
  EXPECT_EQ(refusal(headerWith("short", raw + "\n")), "is not a sound NRRD file: it does not say its endian");
  EXPECT_EQ(refusal(headerWith("short", "\n")), "is not a sound NRRD file: it has no encoding");
  EXPECT_EQ(refusal(headerWith("short", "encoding: bzip2\n\n")),
            "is packed as 'bzip2': raw, gzip and ascii can be read");
  EXPECT_EQ(refusal(headerWith("short", "nonsense\n\n")), "is not a sound NRRD file: 'nonsense' is no field");
  EXPECT_EQ(refusal(headerWith("short", "spacings: 1 x 2\n\n")), "is not a sound NRRD file: 'x' is no number");
  EXPECT_EQ(refusal(headerWith("short", raw + "spacings: 1 2\n\n")),
            "is not a sound NRRD file: it has not one spacing for each axis");
  EXPECT_EQ(refusal(fileOf("spacings: 1 0 1\n")), "says no distances and directions between its samples that could be");
  EXPECT_EQ(refusal(fileOf("spacings: 1 nan 1\n")),
            "says no distances and directions between its samples that could be");
  EXPECT_EQ(refusal(fileOf("", "5 4")), "is not a sound NRRD file: it has dimension 3 and 2 sizes");
  EXPECT_EQ(refusal(fileOf("", "1e6 1e6 1e6")), "ends before its last sample");
  EXPECT_EQ(refusal(fileOf("", "5 4 1e30")).find("has 5 x 4 x 1e+30 samples: "), 0U);
  EXPECT_EQ(refusal(headerWith("float", "encoding: ascii\n\n") + textSamples() + "7"),
            "has more samples than the 5 x 4 x 3 of its header");
  EXPECT_EQ(refusal(headerWith("uchar", "encoding: ascii\n\n") + textSamples().substr(0, 100)),
            "ends before its last sample");
  for (const auto& [type, number] :
       {std::pair("short", "70000"), std::pair("short", "9.5"), std::pair("uchar", "256"),
        std::pair("signed char", "-129"), std::pair("uint", "-1"), std::pair("int", "3e9")})
    EXPECT_EQ(refusal(headerWith(type, std::string("encoding: ascii\n\n") + number + " " + textSamples())),
              fmt::format("has a sample of {:g}, which its type does not have", std::stod(number)));
  EXPECT_EQ(refusal(fileOf("sizes: 4 5 3\n")), "is not a sound NRRD file: it has two fields 'sizes'");
  for (const std::string nameless : {"", "data file: \n"})
    EXPECT_EQ(refusal(headerWith("short", "encoding: raw\nendian: little\n" + nameless)),
              "is a header alone, and names no data file");
  EXPECT_EQ(refusal(headerWith("short", "encoding: gzip\nendian: little\n\n") + textSamples()),
            "is not sound gzip: it is broken, or cut off");
}

TEST(ReadNrrd, AnyDamageIsTakenOrRefusedInOneLine) {
  std::mt19937 random(3);
  const std::string files[] = {
      fileOf("space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace units: \"mm\" \"mm\" \"mm\"\n"),
      headerWith("float", "encoding: ascii\nspacings: 1 1 2\n\n") + textSamples(),
      headerWith("ushort", "encoding: gzip\nendian: big\nspacings: 1 1 2\n\n") +
          packed(test::testSamples<std::uint16_t>(kSide, true))};
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = files[i % 3];
    for (int k = 0; k < 1 + i % 5; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    EXPECT_EQ(refusal(bytes).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace hl::test_read_nrrd
