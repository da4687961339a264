// A file that comes alone: it is read, and nothing that it names beside it can be opened, whatever the format.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/file_ending.h"
#include "io/isolated.h"
#include "io/load_model.h"
#include "io/load_scene_file.h"
#include "io/load_sent.h"
#include "io/sandbox.h"
#include "temp_folder.h"

namespace hl::test_alone {
namespace {

using test::fileWith;
using test::tempFile;

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

Model alone(const std::string& path) {
  return runIsolated("it", {},
                     [&](const auto& report) {
                       return parseModel({path, endingOf(path), true}, report);
                     },
                     {})
      .model;
}

std::string refusalOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Alone, FilesThatHaveAllInOneAreReadAsEver) {
  for (const std::string& path :
       {fileWith("alone.obj", kSquare), fileWith("tiny.obj", "v 0 0 0\np 1\n"),
        fileWith("alone.stl",
                 "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                 "endloop\nendfacet\nendsolid a\n"),
        fileWith("alone.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        fileWith("alone.wrl", "#VRML V2.0 utf8\nShape { geometry Box { size 1 2 3 } }\n")}) {
    const Model one = alone(path), other = loadModel(path);
    EXPECT_GT(one.elements(), 0u) << path;
    EXPECT_EQ(one.positions, other.positions) << path;
    EXPECT_EQ(one.triangles, other.triangles) << path;
    EXPECT_TRUE(one.warnings.empty()) << path << ": " << one.warnings.front();
  }
}

TEST(Alone, WhatAnObjNamesIsLeftOutWithAWarning) {
  fileWith("beside.mtl", "newmtl a\n");
  const Model model = alone(fileWith("names.obj", std::string("mtllib beside.mtl\n") + kSquare));
  EXPECT_EQ(model.triangles.size(), 2u);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0], "comes alone, without beside.mtl");
}

TEST(Alone, AGltfWithABufferBesideItIsRefused) {
  fileWith("beside.bin", std::string(36, '\0'));
  const std::string path = fileWith(
      "names.gltf",
      R"({"asset":{"version":"2.0"},"buffers":[{"uri":"beside.bin","byteLength":36}],"bufferViews":[{"buffer":0,)"
      R"("byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],)"
      R"("scene":0})");
  EXPECT_EQ(refusalOf([&] { loadModel(path); }), "");
  EXPECT_EQ(refusalOf([&] { alone(path); }),
            "it: needs beside.bin, and a file comes alone: put all into one, a .glb for example");
}

TEST(Alone, AnInventorFileCannotReadAnother) {
  const std::string cube = fileWith("cube.iv", "#Inventor V2.1 ascii\nSeparator { Cube {} }\n");
  const std::string path =
      fileWith("names.iv", "#Inventor V2.1 ascii\nSeparator { Cube {} File { name \"" + cube + "\" } }\n");
  EXPECT_EQ(loadModel(path).triangles.size(), 24u);
  EXPECT_EQ(alone(path).triangles.size(), 12u);
}

TEST(Alone, ASceneFileMayHoldWhatIsInIt) {
  LoadOptions options;
  options.alone = true;
  const auto load = [&](const std::string& object) {
    return loadSceneFile(fileWith("alone.hl.json", "{\"objects\":[\n" + object + "]}"), options).model;
  };
  EXPECT_GT(load("{\"builtin\":\"sphere:500\"}").elements(), 100u);
  EXPECT_EQ(refusalOf([&] { load("{\"file\":\"/etc/passwd.obj\"}"); }),
            "line 2: objects[0].file: names another file, and this one comes alone");
}

TEST(Alone, NothingCanBeOpenedAndWhatIsOpenCanBeRead) {
  const std::string path = fileWith("open", "content");
  const pid_t child = fork();
  if (child == 0) {
    const int open_before = open(path.c_str(), O_RDONLY);
    if (!allowReadingBySeccomp() || !forbidOpening()) _exit(2);
    char byte = 0;
    const bool reads = pread(open_before, &byte, 1, 0) == 1 && byte == 'c';
    const bool opens = open(path.c_str(), O_RDONLY) >= 0 || openat(AT_FDCWD, path.c_str(), O_RDONLY) >= 0;
    _exit(reads && !opens ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WEXITSTATUS(status) == 2) GTEST_SKIP() << "this kernel has no seccomp";
  EXPECT_EQ(status, 0);
}

TEST(Alone, TheEndingDecides) {
  EXPECT_EQ(sentEndingOf("A.OBJ"), ".obj");
  EXPECT_EQ(sentEndingOf("a.hl.json"), ".hl.json");
  EXPECT_EQ(sentEndingOf("a.json"), ".json");
  EXPECT_EQ(sentEndingOf("a"), "");
  EXPECT_TRUE(readsSent(".hl.json") && readsSent(".obj") && readsSent(".wrl") && readsSent(".las"));
  EXPECT_FALSE(readsSent(".bin") || readsSent("") || readsSent(".json"));
}

// A program that is none, one that gives nothing, and one that is given up.
TEST(Sent, AReaderThatGivesNothingIsALine) {
  const int file = open(fileWith("sent.obj", kSquare).c_str(), O_RDONLY);
  std::atomic<bool> given_up{false};
  EXPECT_EQ(refusalOf([&] {
              loadSent(file, "a.obj", {"/nonexistent", {"hl"}}, {}, given_up);
            }),
            "a.obj: no process to read it in: No such file or directory");
  EXPECT_NE(refusalOf([&] { loadSent(file, "a.obj", {"/bin/true", {"true"}}, {}, given_up); }), "");
  EXPECT_NE(refusalOf([&] { loadSent(file, "a.obj", {"/bin/cat", {"cat", "/proc/version"}}, {}, given_up); }), "");
  given_up = true;
  EXPECT_EQ(refusalOf([&] {
              loadSent(file, "a.obj", {"/bin/sh", {"sh", "-c", "exec sleep 1000"}}, {}, given_up);
            }),
            "a.obj: the reading was given up");
  close(file);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a process is left";
}

}  // namespace
}  // namespace hl::test_alone
