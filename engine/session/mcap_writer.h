#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/time.h"
#include "engine/session/byte_stream.h"
#include "engine/session/mcap_format.h"

namespace helical {

/// Writes one MCAP file of profile `ros2`: schemas, channels and attachments first, then messages in chunks
/// (zstd, CRC, message index), at last the summary. What has been flushed stays readable whatever happens
/// next. One thread. Every method throws Error(kSystem) when the disk refuses; the file then ends after the
/// last whole record.
class McapWriter {
 public:
  /// Replaces the file. Throws Error(kInput) when it cannot be made.
  McapWriter(std::filesystem::path file, const std::string& library);
  ~McapWriter();  ///< closes the file as it is, without a summary
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Before the first message.
  std::uint16_t addSchema(const std::string& name, const std::string& encoding,
                          const std::string& definition);
  /// Each has chunks of its own, so that a reader of one passes over the others: images, and what is rare and
  /// sought over the whole file.
  enum class Weight { kLight, kBulky, kRare };
  std::uint16_t addChannel(std::uint16_t schema, const std::string& topic, const std::string& encoding,
                           Weight weight = Weight::kLight);
  void addAttachment(const McapAttachment& attachment);

  /// Into the chunk in memory, which goes to the file when it has 256 KB.
  void addMessage(std::uint16_t channel, TimeNs log_time, TimeNs publish_time, std::string_view payload);

  /// What is in memory goes to the file.
  void flush();
  /// What was flushed goes to the disk.
  void sync();
  /// Flushes, then writes the summary: the file is complete.
  void close();

 private:
  struct Channel {
    Weight weight = Weight::kLight;
    std::uint64_t messages = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index;  ///< log time, offset in the chunk
  };
  struct Chunk {
    ByteWriter records;
    std::uint64_t start = 0, end = 0;
  };
  void write(std::string_view bytes);
  void flush(Weight weight);
  /// The chunk's message indexes; `offsets`: where they begin in the file, by channel, when they follow it.
  std::string takeIndexes(Weight weight, std::uint64_t chunk_end, ByteWriter& offsets);
  std::string summary(std::uint64_t start) const;
  std::string statistics() const;
  [[noreturn]] void refuse(const std::string& what, int code) const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t written_ = 0;
  std::uint32_t data_crc_ = 0;

  std::array<Chunk, 3> open_;  ///< by weight
  std::map<std::uint16_t, Channel> channels_;
  std::uint64_t messages_ = 0, first_ = 0, last_ = 0;
  std::uint16_t schemas_ = 0;
  std::uint32_t attachments_ = 0, chunks_ = 0;
  std::string schema_records_, channel_records_, chunk_indexes_, attachment_indexes_;
};

}  // namespace helical
