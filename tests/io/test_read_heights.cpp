// Files of heights: what each form says comes out, and what is broken gives one line.
#include "io/read_heights.h"

#include <gtest/gtest.h>
#include <spng.h>
#include <tiffio.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "io/load_model.h"
#include "surfaces/height_field.h"
#include "temp_folder.h"

namespace hl::test_read_heights {
namespace {

using test::fileWith;

std::shared_ptr<const HeightField> fieldIn(const std::string& path) {
  const SceneModel scene = loadModelScene(path);
  EXPECT_EQ(scene.surfaces.size(), 1U);
  return std::dynamic_pointer_cast<const HeightField>(scene.surfaces.at(0).source);
}

std::string refusalOf(const std::string& path) {
  try {
    loadModelScene(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Height in a test's files.
int valueAt(std::uint32_t column, std::uint32_t row) {
  return static_cast<int>(7 * column) - static_cast<int>(3 * row * row);
}

void expectValues(const HeightField& field, std::uint32_t columns, std::uint32_t rows) {
  ASSERT_EQ(field.grid().columns(), columns);
  ASSERT_EQ(field.grid().rows(), rows);
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) ASSERT_EQ(field.grid().at(i, j), valueAt(i, j)) << i << " " << j;
  }
}

struct TiffForm {
  std::uint16_t bits = 16, format = SAMPLEFORMAT_INT, compression = COMPRESSION_NONE;
  bool tiles = false, degrees = false;
  const char* missing = "-9999";
  double scale = 20;                  // to the next row
  std::vector<double> map{};          // tag 34264, in the place of scale and tie
  std::vector<std::uint16_t> keys{};  // GeoTIFF's beside the first, four numbers each
  const char* metadata = nullptr;     // GDAL's
};

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void setPlace(TIFF* tiff, const TiffForm& form) {
  const double scale[3] = {form.degrees ? 0.001 : 30, form.degrees ? 0.002 : form.scale, 0};
  const double tie[6] = {0, 0, 0, 10, 50, 0};
  std::vector<std::uint16_t> keys{1,    1, 0, static_cast<std::uint16_t>(1 + form.keys.size() / 4),
                                  1024, 0, 1, static_cast<std::uint16_t>(form.degrees ? 2 : 1)};
  keys.insert(keys.end(), form.keys.begin(), form.keys.end());
  if (form.map.empty()) {
    TIFFSetField(tiff, 33550, 3, scale);
    TIFFSetField(tiff, 33922, 6, tie);
  } else {
    TIFFSetField(tiff, 34264, 16, form.map.data());
  }
  TIFFSetField(tiff, 34735, static_cast<int>(keys.size()), keys.data());
  TIFFSetField(tiff, 42113, form.missing);
  if (form.metadata != nullptr) TIFFSetField(tiff, 42112, form.metadata);
}

template <typename Sample>
std::string tiffWith(const std::string& name, const TiffForm& form, std::uint32_t columns, std::uint32_t rows) {
  const std::string path = fileWith(name, "");
  static const TIFFFieldInfo kTags[] = {{33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("scale")},
                                        {33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("tie")},
                                        {34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("keys")},
                                        {34264, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("map")},
                                        {42112, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("metadata")},
                                        {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("missing")}};
  TIFF* const tiff = TIFFOpen(path.c_str(), "w");
  TIFFMergeFieldInfo(tiff, kTags, 6);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, columns);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, rows);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, form.bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, form.format);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, form.compression);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  setPlace(tiff, form);
  if (form.tiles) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
    std::vector<Sample> tile(256);
    for (std::uint32_t j = 0; j < rows; j += 16) {
      for (std::uint32_t i = 0; i < columns; i += 16) {
        for (std::uint32_t n = 0; n < 256; ++n) tile[n] = static_cast<Sample>(valueAt(i + n % 16, j + n / 16));
        TIFFWriteTile(tiff, tile.data(), i, j, 0, 0);
      }
    }
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 5);
    std::vector<Sample> row(columns);
    for (std::uint32_t j = 0; j < rows; ++j) {
      for (std::uint32_t i = 0; i < columns; ++i) row[i] = static_cast<Sample>(valueAt(i, j));
      TIFFWriteScanline(tiff, row.data(), j, 0);
    }
  }
  TIFFClose(tiff);
  return path;
}

TEST(ReadHeights, GeoTiffInStripsAndTiles) {
  for (const bool tiles : {false, true}) {
    for (const std::uint16_t compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
      TiffForm form;
      form.tiles = tiles;
      form.compression = compression;
      const auto field = fieldIn(tiffWith<std::int16_t>("a.tif", form, 45, 21));
      expectValues(*field, 45, 21);
      EXPECT_EQ(field->grid().size().kind, SampleKind::kInt16);
      EXPECT_EQ(field->grid().missing(), -9999);
      EXPECT_EQ(field->frame().axes.col(0), Vec3(30, 0, 0));
      EXPECT_EQ(field->frame().axes.col(1), Vec3(0, 0, 20));
      EXPECT_EQ(field->frame().axes.col(2), Vec3(0, 1, 0));
      EXPECT_NEAR(field->bounds().centre().x(), 0, 1e-9);
      EXPECT_NEAR(field->bounds().centre().z(), 0, 1e-9);
      form.bits = 32;
      form.format = SAMPLEFORMAT_IEEEFP;
      expectValues(*fieldIn(tiffWith<float>("b.tiff", form, 45, 21)), 45, 21);
    }
  }
}

// On WGS 84 a degree of latitude has 111.229 km and one of longitude 71.70 km at 50 degrees north.
TEST(ReadHeights, DegreesBecomeMetres) {
  TiffForm form;
  form.degrees = true;
  const SceneModel scene = loadModelScene(tiffWith<std::int16_t>("d.tif", form, 30, 2));
  const auto& field = dynamic_cast<const HeightField&>(*scene.surfaces.at(0).source);
  EXPECT_NEAR(field.frame().axes(0, 0), 71.70, 0.01);
  EXPECT_NEAR(field.frame().axes(2, 1), 2 * 111.229, 0.01);
  ASSERT_EQ(scene.model.warnings.size(), 1U);
  EXPECT_NE(scene.model.warnings[0].find("degrees"), std::string::npos);
  EXPECT_NEAR(degreeAt(0).east_m, 111'319.5, 1);
  EXPECT_NEAR(degreeAt(0).north_m, 110'574, 1);
  EXPECT_NEAR(degreeAt(90).north_m, 111'694, 1);
}

TEST(ReadHeights, OtherTiffsAreRefused) {
  TiffForm form;
  form.bits = 64;
  form.format = SAMPLEFORMAT_UINT;
  EXPECT_NE(refusalOf(tiffWith<std::uint64_t>("c.tif", form, 20, 20)).find("convert it, as gdal_translate"),
            std::string::npos);
}

template <typename Given>
void expectReadAs(SampleKind kind, std::uint16_t format) {
  for (const bool tiles : {false, true}) {
    TiffForm form;
    form.bits = 8 * sizeof(Given);
    form.format = format;
    form.tiles = tiles;
    const auto field = fieldIn(tiffWith<Given>("k.tif", form, 45, 21));
    ASSERT_EQ(field->grid().columns(), 45U);
    EXPECT_EQ(field->grid().size().kind, kind);
    for (std::uint32_t j = 0; j < 21; ++j) {
      for (std::uint32_t i = 0; i < 45; ++i)
        ASSERT_EQ(field->grid().at(i, j), static_cast<float>(static_cast<Given>(valueAt(i, j)))) << i << " " << j;
    }
  }
}

TEST(ReadHeights, SamplesOfOtherKindsAreKeptAsTheNearest) {
  expectReadAs<std::uint8_t>(SampleKind::kUint16, SAMPLEFORMAT_UINT);
  expectReadAs<std::int8_t>(SampleKind::kInt16, SAMPLEFORMAT_INT);
  expectReadAs<std::int32_t>(SampleKind::kFloat32, SAMPLEFORMAT_INT);
  expectReadAs<double>(SampleKind::kFloat32, SAMPLEFORMAT_IEEEFP);
}

TEST(ReadHeights, WhatATiffSaysWronglyIsReported) {
  const auto warningsOf = [](const TiffForm& form) {
    return loadModelScene(tiffWith<std::int16_t>("w.tif", form, 30, 20)).model.warnings;
  };
  TiffForm form;
  EXPECT_TRUE(warningsOf(form).empty());
  form.missing = "hello";
  EXPECT_EQ(warningsOf(form), std::vector<std::string>{"its value for missing samples, 'hello', is no number: none "
                                                       "counts as missing"});
}

// Whatever its tags lose, a file that is cut must not be one without them: its missing samples would be pits.
TEST(ReadHeights, ATiffThatEndsBeforeItsTagsSaysSo) {
  TiffForm form;
  form.missing = "-9999.000";
  form.metadata = "<GDALMetadata><Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.1</Item></GDALMetadata>";
  const std::string tiff = bytesOf(tiffWith<std::int16_t>("whole.tif", form, 20, 20));
  std::uint32_t directory = 0;
  std::memcpy(&directory, tiff.data() + 4, sizeof directory);
  ASSERT_GT(directory, 800U);  // the samples lie before it
  for (std::size_t lost = 1; directory + lost <= tiff.size(); lost += lost < 60 ? 1 : 7) {
    const std::string refusal = refusalOf(fileWith("cut.tif", tiff.substr(0, tiff.size() - lost)));
    EXPECT_NE(refusal.find("cut.tif: is "), std::string::npos) << lost << " " << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  }
}

TEST(ReadHeights, ATagOfAnotherTypeIsRefused) {
  std::string tiff = bytesOf(tiffWith<std::int16_t>("typed.tif", {}, 20, 20));
  const std::uint16_t entry[2] = {33550, TIFF_DOUBLE}, other[2] = {33550, TIFF_SLONG8};
  const std::size_t at = tiff.find({reinterpret_cast<const char*>(entry), sizeof entry});
  ASSERT_NE(at, std::string::npos);
  std::memcpy(tiff.data() + at, other, sizeof other);
  const std::string refusal = refusalOf(fileWith("other.tif", tiff));
  EXPECT_NE(refusal.find("its tag 33550"), std::string::npos) << refusal;
}

TEST(ReadHeights, UnitsOfATiffBecomeMetres) {
  const auto sceneOf = [](const TiffForm& form) {
    return loadModelScene(tiffWith<std::int16_t>("u.tif", form, 30, 20));
  };
  const auto axesOf = [](const SceneModel& scene) {
    return dynamic_cast<const HeightField&>(*scene.surfaces.at(0).source).frame().axes;
  };
  TiffForm form;
  form.keys = {3076, 0, 1, 9003, 4099, 0, 1, 9002};
  SceneModel scene = sceneOf(form);
  EXPECT_NEAR(axesOf(scene)(0, 0), 30 * 1200.0 / 3937, 1e-12);
  EXPECT_NEAR(axesOf(scene)(2, 1), 20 * 1200.0 / 3937, 1e-12);
  EXPECT_NEAR(axesOf(scene)(1, 2), 0.3048, 1e-15);
  EXPECT_TRUE(scene.model.warnings.empty());
  form.keys = {3076, 0, 1, 9002};
  scene = sceneOf(form);
  EXPECT_NEAR(axesOf(scene)(0, 0), 30 * 0.3048, 1e-12);
  EXPECT_EQ(axesOf(scene)(1, 2), 1);
  ASSERT_EQ(scene.model.warnings.size(), 1U);
  EXPECT_NE(scene.model.warnings[0].find("no unit of its heights"), std::string::npos);
  form.keys = {3076, 0, 1, 9036, 4099, 0, 1, 9001};
  scene = sceneOf(form);
  EXPECT_EQ(axesOf(scene)(0, 0), 30);
  ASSERT_EQ(scene.model.warnings.size(), 1U);
  EXPECT_NE(scene.model.warnings[0].find("the unit 9036"), std::string::npos);
  form.keys = {3076, 0, 1, 9001, 4099, 0, 1, 9001};
  EXPECT_TRUE(sceneOf(form).model.warnings.empty());
}

TEST(ReadHeights, ScaleAndOffsetOfGdalAreApplied) {
  TiffForm form;
  form.keys = {3076, 0, 1, 9001, 4099, 0, 1, 9002};
  form.metadata =
      "<GDALMetadata><Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.1</Item>"
      "<Item name=\"OFFSET\" sample=\"0\" role=\"offset\">100</Item>"
      "<Item name=\"OFFSET\" sample=\"1\" role=\"offset\">7</Item><Item name=\"UNIT\">x</Item></GDALMetadata>";
  const auto field = fieldIn(tiffWith<std::int16_t>("s.tif", form, 30, 20));
  EXPECT_NEAR(field->frame().axes(1, 2), 0.03048, 1e-15);
  EXPECT_NEAR(field->frame().point(3, 1, valueAt(3, 1)).y(), 0.3048 * (100 + 0.1 * valueAt(3, 1)), 1e-12);
  EXPECT_EQ(field->grid().missing(), -9999);
  form.metadata = "<GDALMetadata><Item role=\"scale\">-1</Item></GDALMetadata>";
  EXPECT_NE(refusalOf(tiffWith<std::int16_t>("s.tif", form, 30, 20)).find("has '-1' for the scale"), std::string::npos);
  form.metadata = "<GDALMetadata";
  const auto warnings = loadModelScene(tiffWith<std::int16_t>("s.tif", form, 30, 20)).model.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("42112 is no XML"), std::string::npos);
}

// The same map, with its rows or columns in another order in the file: each sample lies where it lay, and the outside
// is above.
TEST(ReadHeights, RowsNorthAndColumnsWestLieWhereTheyAre) {
  const std::uint32_t columns = 30, rows = 20;
  for (const bool west : {false, true}) {
    for (const bool north : {false, true}) {
      TiffForm form;
      form.map = {west ? -30.0 : 30, 0, 0, 10, 0, north ? 20.0 : -20, 0, 50, 0, 0, 0, 0, 0, 0, 0, 1};
      const SceneModel scene = loadModelScene(tiffWith<std::int16_t>("m.tif", form, columns, rows));
      EXPECT_TRUE(scene.model.warnings.empty());
      const auto& field = dynamic_cast<const HeightField&>(*scene.surfaces.at(0).source);
      for (const std::uint32_t i : {0U, 7U, columns - 1}) {
        for (const std::uint32_t j : {0U, 4U, rows - 1}) {
          const Vec3 wanted((west ? -30.0 : 30) * (i - 0.5 * (columns - 1)), valueAt(i, j),
                            (north ? -20.0 : 20) * (j - 0.5 * (rows - 1)));
          EXPECT_NEAR((field.frame().point(i, j, field.grid().at(i, j)) - wanted).norm(), 0, 1e-9);
        }
      }
      const auto [a, b, c] = field.corners(0);
      EXPECT_GT((b - a).cross(c - a).y(), 0);
      EXPECT_EQ(field.siteOf(Vec3(1, 1e6, 1)), Site::kOpen);
    }
  }
  TiffForm form;
  form.scale = -20;  // the specification's way to say that rows lead north, which GDAL does not follow
  const SceneModel scene = loadModelScene(tiffWith<std::int16_t>("m.tif", form, columns, rows));
  EXPECT_EQ(dynamic_cast<const HeightField&>(*scene.surfaces.at(0).source).frame().axes(2, 1), -20);
  ASSERT_EQ(scene.model.warnings.size(), 1U);
  EXPECT_NE(scene.model.warnings[0].find("GDAL takes them to lead south"), std::string::npos);
}

// The samples that lack are those of the last strip: its place in the file is that of the end.
TEST(ReadHeights, ACutTiffSaysSo) {
  const std::string path = tiffWith<std::int16_t>("whole.tif", {}, 20, 20);
  std::string tiff = bytesOf(path);
  std::uint32_t place = 8 + 3 * 5 * 20 * 2;  // three strips of five rows lie before it
  const std::string wanted(reinterpret_cast<const char*>(&place), sizeof place);
  const std::size_t at = tiff.rfind(wanted);
  ASSERT_NE(at, std::string::npos);
  place = static_cast<std::uint32_t>(tiff.size() - 20);
  std::memcpy(tiff.data() + at, &place, sizeof place);
  EXPECT_EQ(refusalOf(fileWith("cut.tif", tiff)),
            hl::test::tempFile("cut.tif") + ": is cut or corrupt: it ends before its last samples");
}

std::string bigEndian(std::uint32_t side) {
  std::string bytes;
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const auto value = static_cast<std::uint16_t>(i == 3 && j == 4 ? -32768 : valueAt(i, j));
      bytes += static_cast<char>(value >> 8);
      bytes += static_cast<char>(value & 255);
    }
  }
  return bytes;
}

TEST(ReadHeights, SrtmTiles) {
  const auto field = fieldIn(fileWith("N47E008.hgt", bigEndian(11)));
  ASSERT_EQ(field->grid().columns(), 11U);
  EXPECT_EQ(field->grid().at(2, 9), valueAt(2, 9));
  EXPECT_TRUE(std::isnan(field->grid().at(3, 4)));
  EXPECT_EQ(field->triangles(), 2U * (100 - 4));
  EXPECT_NEAR(field->frame().axes(0, 0), degreeAt(47.5).east_m / 10, 1e-6);
  EXPECT_NE(refusalOf(fileWith("N47E008.hgt", bigEndian(11) + "ab")).find("SRTM tile is a square"), std::string::npos);
}

TEST(ReadHeights, EsriGrids) {
  std::string text = "NCOLS 6\nnrows 4\r\nxllcorner 700\nyllcorner 100.5\ncellsize 2.5\nNODATA_value -1e4\n";
  for (std::uint32_t j = 0; j < 4; ++j) {
    for (std::uint32_t i = 0; i < 6; ++i) text += std::to_string(valueAt(i, j)) + (i == 5 ? "\n" : " ");
  }
  const auto field = fieldIn(fileWith("a.asc", text));
  expectValues(*field, 6, 4);
  EXPECT_EQ(field->frame().axes(0, 0), 2.5);
  EXPECT_EQ(field->grid().missing(), -1e4);
  EXPECT_NE(refusalOf(fileWith("b.asc", text.substr(0, text.size() - 3))).find("ends before its last sample"),
            std::string::npos);
  EXPECT_NE(refusalOf(fileWith("c.asc", "ncols 6\nnrows 4\ncellsize 1\n1 2 x 4")).find("'x' is no number"),
            std::string::npos);
  EXPECT_NE(refusalOf(fileWith("d.asc", "ncols 6\nnrows 4\n1 2 3 4")).find("cellsize"), std::string::npos);
  EXPECT_NE(refusalOf(fileWith("f.asc", "ncols 1e9\nnrows 1e9\ncellsize 1\n1 2 3")).find("ends before its last sample"),
            std::string::npos);
  EXPECT_NE(refusalOf(fileWith("e.asc", "ncols 6e9\nnrows 4\ncellsize 1\n1 2 3 4")).find("ncols"), std::string::npos);
  EXPECT_NE(refusalOf(fileWith("g.asc", "nrows 2\ncellsize 1\n1 2 3 4")).find("its header lacks ncols"),
            std::string::npos);
  EXPECT_NE(
      refusalOf(fileWith("h.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2 9\n3 4 9\n")).find("more samples than the 2 x 2"),
      std::string::npos)
      << "its rows would be shifted";
  EXPECT_EQ(fieldIn(fileWith("i.asc", "\xef\xbb\xbfncols 2\nnrows 2\ncellsize 1\n1 2\n3 4\n\n"))->grid().size().columns,
            2u);
}

std::string pngWith(std::uint8_t depth, std::uint32_t columns, std::uint32_t rows) {
  spng_ctx* const png = spng_ctx_new(SPNG_CTX_ENCODER);
  spng_set_option(png, SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{};
  header.width = columns;
  header.height = rows;
  header.bit_depth = depth;
  header.color_type = SPNG_COLOR_TYPE_GRAYSCALE;
  spng_set_ihdr(png, &header);
  std::vector<std::uint16_t> samples;
  for (std::uint32_t n = 0; n < columns * rows; ++n)
    samples.push_back(static_cast<std::uint16_t>(1000 + valueAt(n % columns, n / columns)));
  EXPECT_EQ(spng_encode_image(png, samples.data(), samples.size() * depth / 8, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  std::size_t size = 0;
  int error = 0;
  void* const bytes = spng_get_png_buffer(png, &size, &error);
  std::string result(static_cast<char*>(bytes), size);
  std::free(bytes);
  spng_ctx_free(png);
  return result;
}

TEST(ReadHeights, PngsOf16Bits) {
  const std::string png = pngWith(16, 9, 5);
  const auto field = fieldIn(fileWith("a.png", png));
  ASSERT_EQ(field->grid().columns(), 9U);
  for (std::uint32_t j = 0; j < 5; ++j) {
    for (std::uint32_t i = 0; i < 9; ++i) ASSERT_EQ(field->grid().at(i, j), 1000 + valueAt(i, j));
  }
  EXPECT_NEAR(65535 * field->frame().axes(1, 2), 1, 1e-12);  // an eighth of 8 m
  EXPECT_NE(refusalOf(fileWith("b.png", png.substr(0, png.size() - 20))).find("not a sound PNG"), std::string::npos);
  EXPECT_NE(refusalOf(fileWith("c.png", pngWith(8, 9, 5))).find("16 bits"), std::string::npos);
}

template <typename Sample>
std::string numpyWith(const std::string& type, bool fortran, std::uint32_t columns, std::uint32_t rows) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" +
                       std::to_string(rows) + ", " + std::to_string(columns) + "), }\n";
  std::string bytes = "\x93NUMPY";
  bytes += {1, 0, static_cast<char>(header.size()), 0};
  bytes += header;
  const auto add = [&](std::uint32_t i, std::uint32_t j) {
    const auto value = static_cast<Sample>(valueAt(i, j));
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (type[0] == '>') std::reverse(one.begin(), one.end());
    bytes += one;
  };
  for (std::uint32_t n = 0; n < columns * rows; ++n) fortran ? add(n / rows, n % rows) : add(n % columns, n / columns);
  return bytes;
}

TEST(ReadHeights, NumpyArrays) {
  expectValues(*fieldIn(fileWith("a.npy", numpyWith<std::int16_t>("<i2", false, 7, 5))), 7, 5);
  expectValues(*fieldIn(fileWith("a.npy", numpyWith<float>("<f4", false, 7, 5))), 7, 5);
  expectValues(*fieldIn(fileWith("a.npy", numpyWith<float>(">f4", false, 7, 5))), 7, 5);
  expectValues(*fieldIn(fileWith("a.npy", numpyWith<double>("<f8", false, 7, 5))), 7, 5);
  // In Fortran's order the grid is transposed, and lies as it should all the same.
  const auto turned = fieldIn(fileWith("a.npy", numpyWith<float>("<f4", true, 7, 5)));
  EXPECT_EQ(turned->grid().columns(), 5U);
  EXPECT_EQ(turned->grid().at(4, 6), valueAt(6, 4));
  EXPECT_EQ(turned->frame().axes.col(0), Vec3(0, 0, 1));
  EXPECT_EQ(turned->bounds().size().x(), 6);
  EXPECT_NE(refusalOf(fileWith("b.npy", numpyWith<float>("<c8", false, 7, 5))).find("'<c8'"), std::string::npos);
  EXPECT_NE(refusalOf(fileWith("c.npy", "\x93NUMPY")).find("ends before"), std::string::npos);
  std::string volume = numpyWith<float>("<f4", false, 7, 5);
  volume.replace(volume.find("(5, 7)"), 6, "(3,5,7)").erase(volume.find(' '), 1);
  EXPECT_NE(refusalOf(fileWith("e.npy", volume))
                .find("has shape (3,5,7), and a height field has two sides: save a "
                      "volume as NRRD or NIfTI"),
            std::string::npos);
  const std::string good = numpyWith<float>("<f4", false, 7, 5);
  EXPECT_NE(refusalOf(fileWith("d.npy", good.substr(0, good.size() - 1))).find("ends before"), std::string::npos);
}

// Whatever bytes are changed or lost, the file is taken or refused in one line.
TEST(ReadHeights, CorruptFilesGiveOneLine) {
  std::mt19937 random(1);
  TiffForm form;
  form.compression = COMPRESSION_LZW;
  const std::string tiff = bytesOf(tiffWith<std::int16_t>("x.tif", form, 20, 20));
  const std::pair<const char*, std::string> files[] = {{"y.tif", tiff},
                                                       {"N01E001.hgt", bigEndian(5)},
                                                       {"y.asc", "ncols 3\nnrows 2\ncellsize 1\n1 2 3 4 5 6\n"},
                                                       {"y.png", pngWith(16, 9, 5)},
                                                       {"y.npy", numpyWith<float>("<f4", false, 7, 5)}};
  for (const auto& [name, good] : files) {
    for (int i = 0; i < 60; ++i) {
      std::string bad = good;
      for (int k = 0; k < 1 + i % 3; ++k) bad[random() % bad.size()] = static_cast<char>(random());
      if (i % 4 == 0) bad.resize(random() % bad.size());
      const std::string refusal = refusalOf(fileWith(name, bad));
      EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
    }
  }
}

// A key, a word and a name of a file may have any bytes.
TEST(ReadHeights, BytesThatAreNoUtf8AreOneLine) {
  EXPECT_EQ(refusalOf(fileWith("m.asc", "s\xfc\ns")).substr(hl::test::tempFile("m.asc").size()),
            ": is not an Esri grid: 's' is no number for s?");
  const std::string odd = "odd\xfc.asc";
  EXPECT_NE(refusalOf(fileWith(odd, "ncols 2\n\xff\xfe 3\n")).find("is not an Esri grid"), std::string::npos);
}

TEST(ReadHeights, AFieldWithoutSamplesIsRefused) {
  EXPECT_NE(refusalOf(fileWith("a.asc", "ncols 2\nnrows 2\ncellsize 1\n-9999 1 1 1")).find("missing"),
            std::string::npos);
}

TEST(ReadHeights, AFieldBeyondMemoryIsRefused) {
  LoadOptions options;
  options.limits.samples_bytes = 100;
  try {
    loadModelScene(fileWith("a.npy", numpyWith<float>("<f4", false, 7, 5)), options);
    ADD_FAILURE() << "it was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("takes 0.0 GB of memory"), std::string::npos);
  }
}

}  // namespace
}  // namespace hl::test_read_heights
