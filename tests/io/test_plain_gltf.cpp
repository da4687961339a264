// What glTF files say that cannot be: each is refused with the element. What is legal is read: integers for positions,
// skins without matrices, turns that are not quite of length 1.
#include "io/plain_gltf.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "gltf_document.h"
#include "io/base64.h"
#include "io/load_model.h"
#include "load_refusal.h"
#include "temp_folder.h"

namespace hl::test_plain_gltf {
namespace {

using test::cornersOf;
using test::fileWith;
using test::loadRefusal;
using test::put;

// Which tests change: a square of two triangles.
struct Document : test::GltfDocument {
  Document() {
    attributes = R"("POSITION":0)";
    primitive = R"(,"indices":1)";
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F}) put(bytes, x);
    for (const std::uint16_t index : {0, 1, 2, 0, 2, 3}) put(bytes, index);
    views = {R"({"buffer":0,"byteLength":48})", R"({"buffer":0,"byteOffset":48,"byteLength":12})"};
    accessors = {R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]})",
                 R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"})"};
  }
};

void expectRefusal(const Document& document, const std::string& part) {
  for (const auto& [name, content] : {std::pair("r.gltf", document.gltf()), std::pair("r.glb", document.glb())}) {
    const std::string refusal = loadRefusal(fileWith(name, content));
    EXPECT_NE(refusal.find(part), std::string::npos) << name << ": '" << refusal << "' does not say '" << part << "'";
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  }
}

void expectRefusal(const std::function<void(Document&)>& change, const std::string& part) {
  Document document;
  change(document);
  expectRefusal(document, part);
}

TEST(PlainGltf, ASoundFileStaysAsItIs) {
  std::vector<std::string> warnings;
  for (const auto& [name, content] : {std::pair("s.gltf", Document().gltf()), std::pair("s.glb", Document().glb())}) {
    EXPECT_FALSE(plainGltf({fileWith(name, content), ".glb"}, warnings));
    EXPECT_EQ(loadModel(fileWith(name, content)).triangles.size(), 2u);
  }
  EXPECT_TRUE(warnings.empty());
}

TEST(PlainGltf, OfVersion1NothingIsAsked) {
  std::vector<std::string> warnings;
  const std::string gltf = R"({"asset":{"version":"1.0"},"accessors":{"a":{}},"buffers":{"b":{"byteLength":0}}})";
  EXPECT_FALSE(plainGltf({fileWith("one.gltf", gltf), ".gltf"}, warnings));
}

TEST(PlainGltf, AccessorsBeyondTheirViewsAreRefused) {
  const auto accessor = [](const std::string& text) { return [=](Document& d) { d.accessors[0] = text; }; };
  expectRefusal(accessor(R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})"),
                "accessors/0: its 5 elements from byte 0 on are not within the 48 bytes of bufferViews/0");
  expectRefusal(accessor(R"({"bufferView":0,"byteOffset":4,"componentType":5126,"count":4,"type":"VEC3"})"),
                "accessors/0: its 4 elements from byte 4 on");
  expectRefusal(accessor(R"({"bufferView":0,"byteOffset":-4,"componentType":5126,"count":4,"type":"VEC3"})"),
                "accessors/0: its byteOffset is -4, and no whole number from 0 on");
  expectRefusal(
      accessor(R"({"bufferView":0,"byteOffset":18446744073709551612,"componentType":5126,"count":4,"type":"VEC3"})"),
      "accessors/0: its 4 elements");
  expectRefusal(accessor(R"({"bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"VEC3"})"),
                "accessors/0: its 18446744073709551615 elements");
  expectRefusal(accessor(R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"})"),
                "accessors/0: its bufferView is 2, and there are 2 bufferViews, from 0");
  expectRefusal(accessor(R"({"bufferView":0,"componentType":5130,"count":4,"type":"VEC3"})"),
                "accessors/0: its componentType is 5130");
  expectRefusal(accessor(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC9"})"), "accessors/0: its type");
  expectRefusal(accessor(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"})"),
                "meshes/0/primitives/0/attributes: the accessor of its POSITION is no VEC3");
  expectRefusal(accessor(R"({"bufferView":0,"componentType":5122,"count":4,"type":"VEC3"})"),
                "meshes/0/primitives/0/attributes: the accessor of its POSITION has no numbers of the type float");
  expectRefusal(accessor(R"({"componentType":5126,"count":4,"type":"VEC3"})"), "POSITION has no bufferView");
}

TEST(PlainGltf, ViewsAndBuffersThatAreTooShortAreRefused) {
  const auto view = [](const std::string& text) { return [=](Document& d) { d.views[0] = text; }; };
  expectRefusal(view(R"({"buffer":0,"byteLength":61})"),
                "bufferViews/0: its 61 bytes from 0 on are not within the 60 of its buffer");
  expectRefusal(view(R"({"buffer":0,"byteOffset":18446744073709551612,"byteLength":48})"), "bufferViews/0: its 48");
  expectRefusal(view(R"({"buffer":1,"byteLength":48})"), "bufferViews/0: its buffer is 1, and there are 1 buffers");
  expectRefusal(view(R"({"buffer":0,"byteLength":48,"byteStride":2})"), "bufferViews/0: its byteStride is 2");
  expectRefusal(view(R"({"buffer":0,"byteLength":48,"byteStride":256})"), "bufferViews/0: its byteStride is 256");
  expectRefusal(view(R"({"buffer":0,"byteLength":48,"byteStride":8})"),
                "accessors/0: its elements of 12 bytes are 8 bytes apart (bufferViews/0)");
  expectRefusal([](Document& d) { d.buffer_bytes = 64; }, "buffers/0: it is cut: it tells of 64 bytes, and has 60");
  Document in_a_file;
  fileWith("short.bin", in_a_file.bytes.substr(0, 50));
  const std::string refusal = loadRefusal(fileWith("file.gltf", in_a_file.json(R"(,"uri":"short.bin")")));
  EXPECT_NE(refusal.find("buffers/0: it is cut: it tells of 60 bytes, and has 50"), std::string::npos) << refusal;
}

TEST(PlainGltf, PrimitivesThatContradictThemselvesAreRefused) {
  const auto primitive = [](const std::string& text) { return [=](Document& d) { d.primitive = text; }; };
  const std::string place = "meshes/0/primitives/0: ";
  expectRefusal(primitive(R"(,"indices":1,"mode":7)"), place + "its mode is 7, and there are 0 to 6");
  expectRefusal(primitive(R"(,"indices":2)"), place + "its indices is 2, and there are 2 accessors, from 0");
  expectRefusal(primitive(R"(,"indices":0)"), place + "the accessor of its indices has no whole numbers");
  expectRefusal(primitive(R"(,"indices":-1)"), place + "its indices is -1");
  expectRefusal([](Document& d) { d.attributes = R"("POSITION":7)"; },
                "meshes/0/primitives/0/attributes: its POSITION is 7, and there are 2 accessors");
  expectRefusal([](Document& d) { d.bytes[48 + 2 * 4] = 4; },
                place + "its index 4 is 4, and there are 4 vertices, from 0");
  expectRefusal(
      [](Document& d) {
        d.accessors[1] = R"({"bufferView":1,"componentType":5123,"count":2,"type":"SCALAR"})";
        d.primitive += R"(,"mode":5)";
      },
      place + "has 2 vertices, and its mode 5 needs 3");
}

TEST(PlainGltf, NodesThatContradictThemselvesAreRefused) {
  const auto nodes = [](const std::string& text) { return [=](Document& d) { d.nodes = text; }; };
  expectRefusal(nodes(R"({"mesh":1})"), "nodes/0: its mesh is 1, and there are 1 meshes, from 0");
  expectRefusal(nodes(R"({"mesh":0,"children":[1]})"), "nodes/0: its children/0 is 1, and there are 1 nodes");
  expectRefusal(nodes(R"({"mesh":0,"children":[1]},{"children":[0]})"), "nodes/0: is below itself");
  expectRefusal(nodes(R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0]})"),
                "nodes/0: its matrix is no list of 16 numbers");
  expectRefusal(nodes(R"({"mesh":0,"rotation":[0,0,1]})"), "nodes/0: its rotation is no list of 4 numbers");
  expectRefusal(nodes(R"({"mesh":0,"rotation":[0,0,0,0]})"), "nodes/0: its rotation is 0 0 0 0");
  expectRefusal(nodes(R"({"mesh":0,"rotation":[1e-200,0,0,0]})"), "nodes/0: its rotation is too small or too large");
  expectRefusal([](Document& d) { d.scene_nodes = "3"; }, "scenes/0: its nodes/0 is 3, and there are 1 nodes");
  std::string chain;
  for (int i = 1; i < 100'000; ++i) chain += fmt::format(R"({{"children":[{}]}},)", i);
  expectRefusal(nodes(chain + R"({"mesh":0})"), "the nodes below it are nested too deep");
  std::string doubling;
  for (int i = 1; i <= 40; ++i) doubling += fmt::format(R"({{"children":[{0},{0}]}},)", i);
  expectRefusal(nodes(doubling + R"({"mesh":0})"), "the nodes below it are there more than a million times");
}

TEST(PlainGltf, ATurnOfAnotherLengthIsATurn) {
  for (const double length : {1.0005, 3.0}) {
    Document turned;
    turned.nodes = fmt::format(R"({{"mesh":0,"rotation":[0,0,{0:.12g},{0:.12g}]}})", length * std::sqrt(0.5));
    const Model model = loadModel(fileWith("turned.gltf", turned.gltf()));
    EXPECT_LT((cornersOf(model)[1] - Vec3(0, 1, 0)).norm(), 1e-6);
    const std::string said = "nodes/0: its rotation has the length 3 and is read as one of 1";
    EXPECT_EQ(model.warnings, length > 2 ? std::vector<std::string>{said} : std::vector<std::string>());
  }
}

TEST(PlainGltf, ASkinWithoutMatricesStandsAsItWasModelled) {
  Document skinned;
  skinned.nodes = R"({"mesh":0,"skin":0},{"name":"joint"})";
  skinned.scene_nodes = "0,1";
  skinned.rest = R"(,"skins":[{"joints":[1]}])";
  const std::size_t begin = skinned.bytes.size();
  for (int i = 0; i < 4; ++i) put(skinned.bytes, std::uint32_t{0});
  for (int i = 0; i < 4; ++i) put(skinned.bytes, std::uint32_t{0xFF});
  skinned.views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":32}})", begin));
  skinned.accessors.push_back(R"({"bufferView":2,"componentType":5121,"count":4,"type":"VEC4"})");
  skinned.accessors.push_back(
      R"({"bufferView":2,"byteOffset":16,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"})");
  skinned.attributes += R"(,"JOINTS_0":2,"WEIGHTS_0":3)";
  for (const auto& [name, content] : {std::pair("k.gltf", skinned.gltf()), std::pair("k.glb", skinned.glb())}) {
    const Model model = loadModel(fileWith(name, content));
    EXPECT_EQ(cornersOf(model), cornersOf(loadModel(fileWith("plain.gltf", Document().gltf()))));
    EXPECT_TRUE(model.warnings.empty());
  }
}

TEST(PlainGltf, ACutFileIsRefused) {
  for (const auto& [name, content] :
       {std::pair("cut.gltf", Document().gltf()), std::pair("cut.glb", Document().glb())}) {
    for (std::size_t bytes = 1; bytes < content.size(); bytes += 7) {
      const std::string refusal = loadRefusal(fileWith(name, content.substr(0, bytes)));
      EXPECT_FALSE(refusal.empty()) << bytes;
      EXPECT_EQ(refusal.find("crashed"), std::string::npos) << bytes << refusal;
      EXPECT_NE(refusal.find("cut"), std::string::npos) << bytes << refusal;
    }
  }
}

// Random numbers of a type, as bytes and as what they mean (KHR_mesh_quantization).
struct Quantised {
  int type = 0;
  bool normalized = false;
  std::string raw;            // one element after the other, each filled up to four bytes
  std::vector<float> values;  // the same
};

template <typename Whole>
Quantised quantised(std::mt19937& random, int type, bool normalized, std::size_t parts) {
  Quantised result{type, normalized, {}, {}};
  constexpr int kLeast = std::numeric_limits<Whole>::min(), kMost = std::numeric_limits<Whole>::max();
  for (std::size_t i = 0; i < 30; ++i) {
    for (std::size_t part = 0; part < parts; ++part) {
      const int number = i == 0 ? kLeast : std::uniform_int_distribution<int>(kLeast, kMost)(random);
      put(result.raw, static_cast<Whole>(number));
      const double scaled = std::max(-1.0, number / static_cast<double>(kMost));
      result.values.push_back(static_cast<float>(normalized ? scaled : number));
    }
    while (result.raw.size() % 4 != 0) result.raw += '\0';
  }
  return result;
}

Quantised quantised(std::mt19937& random, int type, bool normalized, std::size_t parts) {
  if (type == 5120) return quantised<std::int8_t>(random, type, normalized, parts);
  if (type == 5121) return quantised<std::uint8_t>(random, type, normalized, parts);
  if (type == 5122) return quantised<std::int16_t>(random, type, normalized, parts);
  return quantised<std::uint16_t>(random, type, normalized, parts);
}

// Ten triangles; attributes one behind the other or interleaved.
Document documentOf(const std::vector<std::pair<std::string, Quantised>>& attributes, bool floats, bool interleaved) {
  Document document;
  document.bytes.clear();
  document.views.clear();
  document.accessors.clear();
  document.primitive = document.attributes = "";
  const auto element = [&](const Quantised& q, std::size_t i) {
    const std::size_t parts = q.values.size() / 30, raw = q.raw.size() / 30;
    if (!floats) return q.raw.substr(i * raw, raw);
    return std::string(reinterpret_cast<const char*>(&q.values[i * parts]), parts * sizeof(float));
  };
  std::size_t stride = 0;
  for (const auto& [name, q] : attributes) stride += element(q, 0).size();
  std::size_t offset = 0;
  if (interleaved)
    document.views.push_back(fmt::format(R"({{"buffer":0,"byteLength":{0},"byteStride":{1}}})", 30 * stride, stride));
  for (const auto& [name, q] : attributes) {
    const std::size_t size = element(q, 0).size();
    if (!interleaved)
      document.views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"byteStride":{}}})",
                                           document.bytes.size(), 30 * size, size));
    for (std::size_t i = 0; i < 30 && !interleaved; ++i) document.bytes += element(q, i);
    document.attributes +=
        fmt::format(R"({}"{}":{})", document.attributes.empty() ? "" : ",", name, document.accessors.size());
    document.accessors.push_back(fmt::format(
        R"({{"bufferView":{},"byteOffset":{},"componentType":{},"normalized":{},"count":30,"type":"VEC{}"}})",
        interleaved ? 0 : document.views.size() - 1, interleaved ? offset : 0, floats ? 5126 : q.type,
        q.normalized && !floats, q.values.size() / 30));
    offset += size;
  }
  for (std::size_t i = 0; i < 30 && interleaved; ++i) {
    for (const auto& [name, q] : attributes) document.bytes += element(q, i);
  }
  if (!floats)
    document.rest = R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
  return document;
}

TEST(PlainGltf, AQuantisedMeshIsTheSameAsInFloats) {
  std::mt19937 random(11);
  for (int round = 0; round < 40; ++round) {
    const int type = 5120 + round % 4;
    const bool normalized = round / 4 % 2 == 0;
    const std::vector<std::pair<std::string, Quantised>> attributes{
        {"POSITION", quantised(random, type, normalized, 3)},
        {"NORMAL", quantised(random, round % 2 == 0 ? 5120 : 5122, true, 3)},
        {"TEXCOORD_0", quantised(random, 5120 + static_cast<int>(random() % 4), random() % 2 == 0, 2)}};
    const bool interleaved = round / 8 % 2 == 0;
    const Document floats = documentOf(attributes, true, interleaved),
                   whole = documentOf(attributes, false, interleaved);
    const Model judge = loadModel(fileWith("floats.gltf", floats.gltf()));
    ASSERT_GT(judge.triangles.size(), 5u);
    for (const auto& [name, content] : {std::pair("q.gltf", whole.gltf()), std::pair("q.glb", whole.glb())}) {
      const Model model = loadModel(fileWith(name, content));
      EXPECT_EQ(cornersOf(model), cornersOf(judge)) << round << name;
      EXPECT_EQ(model.normals, judge.normals) << round << name;
      EXPECT_EQ(model.texcoords, judge.texcoords) << round << name;
      EXPECT_TRUE(model.warnings.empty());
    }
  }
}

TEST(Base64, IsItsOwnInverse) {
  EXPECT_EQ(toBase64("any carnal pleas"), "YW55IGNhcm5hbCBwbGVhcw==");
  EXPECT_EQ(fromBase64("YW55IGNhcm5hbCBwbGVhcw"), "any carnal pleas");
  for (const char* wrong : {"YW5*", "YW55I", "YW=5", "=W55", " YW55", "YW55 ", "    YW55", "YW55    ", "YW55IG\n"})
    EXPECT_FALSE(fromBase64(wrong)) << wrong;
  std::mt19937 random(1);
  for (std::size_t size = 0; size < 100; ++size) {
    std::string bytes;
    while (bytes.size() < size) bytes += static_cast<char>(random());
    EXPECT_EQ(fromBase64(toBase64(bytes)), bytes);
  }
}

}  // namespace
}  // namespace hl::test_plain_gltf
