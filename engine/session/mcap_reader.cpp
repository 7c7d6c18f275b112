#include "engine/session/mcap_reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "engine/base/error.h"
#include "engine/session/byte_stream.h"

namespace helical {
namespace {

constexpr std::uint64_t kLargestChunk = 64u << 20;
constexpr std::uint64_t kLargestSmallRecord = 16u << 20;  // schemas, channels, attachments
constexpr std::uint64_t kSearchWindow = 1u << 20;
constexpr std::uint64_t kChunkHead = 8 + 8 + 8 + 4;  // before the name of its compression

constexpr std::string_view kZstdName{"\x04\0\0\0zstd", 8};

bool known(McapOpcode opcode) {
  return opcode >= McapOpcode::kHeader && opcode <= McapOpcode::kDataEnd;
}

}  // namespace

McapReader::McapReader(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    const std::string why = descriptor_ < 0 ? std::strerror(errno) : "it is no regular file";
    if (descriptor_ >= 0) ::close(descriptor_);
    throw Error(ErrorKind::kInput, "the session cannot be read: " + why, file_.string(),
                "give a file that `helical fly --session` wrote");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  try {
    if (bytesAt(0, kMcapMagic.size()) != kMcapMagic) throw CutShort();
    scan();
  } catch (const CutShort&) {
    ::close(descriptor_);
    throw Error(ErrorKind::kInput, "this is no session: it does not begin as an MCAP file", file_.string(),
                "give a file that `helical fly --session` wrote");
  }
}

McapReader::~McapReader() {
  ::close(descriptor_);
}

std::string McapReader::bytesAt(std::uint64_t offset, std::uint64_t length) const {
  if (offset > size_ || length > size_ - offset) throw CutShort();
  std::string bytes(static_cast<std::size_t>(length), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw CutShort();
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

bool McapReader::headAt(std::uint64_t offset, Head& head) const {
  if (offset > size_ || size_ - offset < kMcapRecordHead) return false;
  const std::string bytes = bytesAt(offset, kMcapRecordHead);
  ByteReader in(bytes);
  head.opcode = static_cast<McapOpcode>(in.get<std::uint8_t>());
  head.length = in.get<std::uint64_t>();
  return known(head.opcode) && head.length <= size_ - offset - kMcapRecordHead;
}

void McapReader::scan() {
  std::uint64_t at = kMcapMagic.size(), before = at;
  bool sound = true;
  while (at < size_) {
    Head head;
    if (!headAt(at, head)) {
      // Somebody changed a length, or the file was cut here: the next chunk is known by its compression.
      sound = false;
      at = before = nextChunk(std::max(before + 1, parts_.empty() ? 0 : parts_.back().offset));
      continue;
    }
    take(head, at + kMcapRecordHead);
    before = at;
    at += kMcapRecordHead + head.length;
    if (head.opcode != McapOpcode::kFooter) continue;
    complete_ = sound && data_ended_ && at + kMcapMagic.size() == size_ &&
                bytesAt(at, kMcapMagic.size()) == kMcapMagic;
    return;
  }
}

void McapReader::take(const Head& head, std::uint64_t offset) {
  if (head.opcode == McapOpcode::kChunk || head.opcode == McapOpcode::kMessage) {
    if (!data_ended_) parts_.push_back({offset, head.length, head.opcode});
    return;
  }
  if (head.opcode == McapOpcode::kDataEnd) data_ended_ = true;
  if (head.length > kLargestSmallRecord) return;
  const std::string content = bytesAt(offset, head.length);
  try {
    ByteReader in(content);
    if (head.opcode == McapOpcode::kHeader) {
      profile_ = in.getText();
      library_ = in.getText();
    } else if (head.opcode == McapOpcode::kSchema) {
      takeSchema(content);
    } else if (head.opcode == McapOpcode::kChannel) {
      takeChannel(content);
    } else if (head.opcode == McapOpcode::kAttachment) {
      takeAttachment(content);
    }
  } catch (const CutShort&) {
    // Its content contradicts its length: as if it were not there.
  }
}

std::uint64_t McapReader::nextChunk(std::uint64_t from) const {
  const std::uint64_t back = kMcapRecordHead + kChunkHead;
  for (std::uint64_t window = from; window < size_; window += kSearchWindow) {
    const std::string bytes =
        bytesAt(window, std::min(kSearchWindow + back + kZstdName.size(), size_ - window));
    for (std::size_t at = bytes.find(kZstdName); at != std::string::npos;
         at = bytes.find(kZstdName, at + 1)) {
      Head head;
      if (at >= back && headAt(window + at - back, head) && head.opcode == McapOpcode::kChunk)
        return window + at - back;
    }
  }
  return size_;
}

void McapReader::takeSchema(std::string_view content) {
  ByteReader in(content);
  McapSchema schema;
  schema.id = in.get<std::uint16_t>();
  schema.name = in.getText();
  schema.encoding = in.getText();
  schema.definition = in.getText();
  schemas_.emplace(schema.id, schema);
}

void McapReader::takeChannel(std::string_view content) {
  ByteReader in(content);
  McapChannel channel;
  channel.id = in.get<std::uint16_t>();
  channel.schema = in.get<std::uint16_t>();
  channel.topic = in.getText();
  channel.encoding = in.getText();
  channels_.emplace(channel.id, channel);
}

void McapReader::takeAttachment(std::string_view content) {
  ByteReader in(content);
  in.get<std::uint64_t>();
  in.get<std::uint64_t>();
  McapAttachment attachment;
  attachment.name = in.getText();
  attachment.media_type = in.getText();
  attachment.content = in.getRaw(in.get<std::uint64_t>());
  const std::size_t covered = in.position();
  const auto crc = in.get<std::uint32_t>();
  if (crc != 0 && crc != crc32(0, content.substr(0, covered))) return;
  attachments_.push_back(std::move(attachment));
}

McapReader::Reading McapReader::read(const std::function<void(const McapMessage&)>& show) {
  Reading reading;
  for (const Part& part : parts_) {
    ++reading.chunks;
    if (!readChunk(part, reading, show)) ++reading.damaged_chunks;
  }
  return reading;
}

bool McapReader::readChunk(const Part& part, Reading& reading,
                           const std::function<void(const McapMessage&)>& show) {
  std::string plain;
  try {
    if (part.length > kLargestChunk) return false;
    const std::string content = bytesAt(part.offset, part.length);
    if (part.opcode == McapOpcode::kMessage) {
      readRecords(bytesAt(part.offset - kMcapRecordHead, part.length + kMcapRecordHead), reading, show);
      return true;
    }
    ByteReader in(content);
    in.getRaw(16);
    const auto size = in.get<std::uint64_t>();
    const auto crc = in.get<std::uint32_t>();
    const std::string compression(in.getText());
    const std::string_view packed = in.getRaw(in.get<std::uint64_t>());
    if (size > kLargestChunk) return false;
    if (compression == "lz4")
      throw Error(ErrorKind::kInput, "the session is compressed with lz4", file_.string(),
                  "convert it with `mcap compress --compression zstd`");
    if (compression == "zstd") {
      plain.resize(static_cast<std::size_t>(size));
      if (ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size()) != plain.size())
        return false;
    } else if (compression.empty()) {
      plain = packed;
    } else {
      return false;
    }
    if (plain.size() != size || (crc != 0 && crc != crc32(0, plain))) return false;
    readRecords(plain, reading, show);
    return true;
  } catch (const CutShort&) {
    return false;
  }
}

void McapReader::readRecords(std::string_view records, Reading& reading,
                             const std::function<void(const McapMessage&)>& show) {
  ByteReader in(records);
  while (!in.atEnd()) {
    const auto opcode = static_cast<McapOpcode>(in.get<std::uint8_t>());
    const std::string_view content = in.getRaw(in.get<std::uint64_t>());
    if (opcode == McapOpcode::kSchema) takeSchema(content);
    if (opcode == McapOpcode::kChannel) takeChannel(content);
    if (opcode != McapOpcode::kMessage) continue;
    ByteReader message(content);
    McapMessage shown;
    shown.channel = message.get<std::uint16_t>();
    message.get<std::uint32_t>();
    shown.log_time = static_cast<TimeNs>(message.get<std::uint64_t>());
    shown.publish_time = static_cast<TimeNs>(message.get<std::uint64_t>());
    shown.payload = message.rest();
    ++reading.messages;
    show(shown);
  }
}

}  // namespace helical
