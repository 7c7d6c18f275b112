#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace helical {

/// The container format MCAP, version 0 (https://mcap.dev/spec): a file is magic, records, magic; a record is
/// an opcode, a length of 8 bytes and its content.
inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};
inline constexpr std::uint64_t kMcapRecordHead = 9;  ///< opcode and length

enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0a,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

struct McapSchema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string definition;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;
  std::string topic;
  std::string encoding;
};

struct McapAttachment {
  std::string name;
  std::string media_type;
  std::string content;
};

/// Continues a CRC-32 (0 for the first part) over `bytes`.
std::uint32_t crc32(std::uint32_t before, std::string_view bytes);

}  // namespace helical
