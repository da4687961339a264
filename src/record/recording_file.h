// Recording files: blocks of proto/recording.proto, each packed and with a checksum of its own. What was written before
// a program or its machine's power went is readable: a block that is cut short or damaged ends the recording.
#pragma once

#include <recording.pb.h>

#include <cstdint>
#include <fstream>
#include <string>

#include "record/private_file.h"

namespace hl {

/// One thread. What is given to write() is with the operating system when it returns: killing the program loses none.
class RecordingWriter {
 public:
  /// Makes the file, or empties it. Throws hl::Error.
  explicit RecordingWriter(const std::string& path);
  /// Writes to an empty file that is open already; `name` is for messages.
  RecordingWriter(FilePointer file, std::string name);
  ~RecordingWriter() = default;
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Throws hl::Error when the disk is full or gone; then the file ends with the block before.
  void write(const proto::RecordingBlock& block);
  std::uint64_t bytes() const { return bytes_; }  ///< of the file so far
  const std::string& path() const { return path_; }
  const FilePointer& file() const { return file_; }

 private:
  void append(const std::string& bytes);

  std::string path_;
  FilePointer file_;
  std::uint64_t bytes_ = 0;
};

/// One thread.
class RecordingReader {
 public:
  /// Throws hl::Error when the file can not be read or is no recording.
  explicit RecordingReader(const std::string& path);
  const std::string& path() const { return path_; }

  /// The next block; false at the end.
  bool next(proto::RecordingBlock& block);
  /// After the end: empty, or what is wrong with the file there, in one line.
  const std::string& damage() const { return damage_; }

 private:
  bool readBlock(std::string& packed, std::uint32_t& raw_bytes);

  std::string path_;
  std::ifstream in_;
  std::uint64_t left_ = 0;  // bytes of the file
  std::string damage_;
};

/// The first block, which every recording begins with. Throws hl::Error when it is not there.
proto::RecordingStart startOf(RecordingReader& reader);

}  // namespace hl
