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
#include "engine/session/message_types.h"

namespace helical {
namespace {

constexpr std::uint64_t kLargestChunk = 64u << 20;
constexpr std::uint64_t kLargestSmallRecord = 16u << 20;  // schemas, channels, attachments
constexpr std::uint64_t kMostKept = 256u << 20;              // of them all together
constexpr std::uint64_t kSearchWindow = 1u << 16;
constexpr std::uint64_t kMostGaps = 10'000;  // a file made of nothing else would be searched for hours
constexpr TimeNs kLatest = TimeNs{1} << 61;  // differences of times stay within their type
constexpr std::uint64_t kLargestSummary = 256u << 20;  // of a day's flight
constexpr std::uint64_t kFooterContent = 8 + 8 + 4;
constexpr std::uint64_t kChunkHead = 8 + 8 + 8 + 4;  // before the name of its compression

constexpr std::string_view kZstdName{"\x04\0\0\0zstd", 8};

bool known(McapOpcode opcode) {
  return opcode >= McapOpcode::kHeader && opcode <= McapOpcode::kDataEnd;
}

}  // namespace

McapReader::McapReader(std::filesystem::path file, Open open) : file_(std::move(file)) {
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
    if (open == Open::kByScan || !takeSummary()) scan();
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
      if (gaps_ >= kMostGaps) return;
      at = before = nextChunk(std::max(before + 1, parts_.empty() ? 0 : parts_.back().offset));
      gaps_ += at < size_;
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

bool McapReader::takeSummary() {
  const std::uint64_t footer_size = kMcapRecordHead + kFooterContent;
  if (size_ < 2 * kMcapMagic.size() + footer_size) return false;
  const std::uint64_t footer_at = size_ - kMcapMagic.size() - footer_size;
  const std::string footer = bytesAt(footer_at, size_ - footer_at);
  ByteReader in(footer);
  if (in.get<std::uint8_t>() != static_cast<std::uint8_t>(McapOpcode::kFooter) ||
      in.get<std::uint64_t>() != kFooterContent || !footer.ends_with(kMcapMagic))
    return false;
  const auto start = in.get<std::uint64_t>();
  in.get<std::uint64_t>();
  const auto crc = in.get<std::uint32_t>();
  if (start < kMcapMagic.size() || start >= footer_at || footer_at - start > kLargestSummary) return false;
  const std::string summary = bytesAt(start, footer_at - start);
  const std::uint32_t actual =
      crc32(crc32(0, summary), std::string_view(footer).substr(0, footer_size - sizeof crc));
  if (crc == 0 || crc != actual) return false;
  try {
    Head header;
    if (!headAt(kMcapMagic.size(), header) || header.opcode != McapOpcode::kHeader) return false;
    take(header, kMcapMagic.size() + kMcapRecordHead);
    ByteReader records(summary);
    while (!records.atEnd()) {
      const auto opcode = static_cast<McapOpcode>(records.get<std::uint8_t>());
      const std::string_view content = records.getRaw(records.get<std::uint64_t>());
      if (opcode == McapOpcode::kSchema) takeSchema(content);
      if (opcode == McapOpcode::kChannel) takeChannel(content);
      if (opcode == McapOpcode::kChunkIndex) takeChunkIndex(content);
      if (opcode == McapOpcode::kAttachmentIndex) takeAttachmentIndex(content);
    }
    complete_ = true;
  } catch (const CutShort&) {
    schemas_.clear(), channels_.clear(), attachments_.clear(), parts_.clear();
    kept_ = 0;
  }
  return complete_;
}

void McapReader::takeChunkIndex(std::string_view content) {
  ByteReader in(content);
  Part part;
  part.start = static_cast<TimeNs>(in.get<std::uint64_t>());
  part.end = static_cast<TimeNs>(in.get<std::uint64_t>());
  if (part.start < 0 || part.end > kLatest || part.start > part.end) throw CutShort();
  const auto at = in.get<std::uint64_t>(), length = in.get<std::uint64_t>();
  if (at > size_ || length > size_ - at || length < kMcapRecordHead) throw CutShort();
  part.offset = at + kMcapRecordHead;
  part.length = length - kMcapRecordHead;
  ByteReader offsets(in.getText());
  while (!offsets.atEnd()) {
    part.channels.push_back(offsets.get<std::uint16_t>());
    offsets.get<std::uint64_t>();
  }
  parts_.push_back(std::move(part));
}

void McapReader::takeAttachmentIndex(std::string_view content) {
  ByteReader in(content);
  const auto at = in.get<std::uint64_t>();
  Head head;
  if (!headAt(at, head) || head.opcode != McapOpcode::kAttachment) throw CutShort();
  take(head, at + kMcapRecordHead);
}

void McapReader::takePart(const Head& head, std::uint64_t offset) {
  Part part{offset, head.length, head.opcode, 0, std::numeric_limits<TimeNs>::max(), {}};
  if (head.opcode == McapOpcode::kChunk && head.length >= 2 * sizeof(std::uint64_t)) {
    const std::string times = bytesAt(offset, 2 * sizeof(std::uint64_t));
    ByteReader in(times);
    part.start = static_cast<TimeNs>(in.get<std::uint64_t>());
    part.end = static_cast<TimeNs>(in.get<std::uint64_t>());
    if (part.start < 0 || part.end > kLatest || part.start > part.end) {
      part.start = 0;  // its head is damaged: nobody knows when
      part.end = std::numeric_limits<TimeNs>::max();
    }
  }
  parts_.push_back(std::move(part));
}

void McapReader::take(const Head& head, std::uint64_t offset) {
  if (head.opcode == McapOpcode::kChunk || head.opcode == McapOpcode::kMessage) {
    if (!data_ended_) takePart(head, offset);
    return;
  }
  if (head.opcode == McapOpcode::kMessageIndex && !data_ended_ && !parts_.empty() && head.length >= 2) {
    const std::string channel = bytesAt(offset, 2);
    parts_.back().channels.push_back(ByteReader(channel).get<std::uint16_t>());
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

/// A small file can name the same large attachment over and over, or pack millions of schemas.
void McapReader::keep(std::size_t bytes) {
  kept_ += bytes;
  if (kept_ > kMostKept) throw CutShort();
}

void McapReader::takeSchema(std::string_view content) {
  keep(content.size());
  ByteReader in(content);
  McapSchema schema;
  schema.id = in.get<std::uint16_t>();
  schema.name = in.getText();
  schema.encoding = in.getText();
  schema.definition = in.getText();
  schemas_.emplace(schema.id, schema);
}

void McapReader::takeChannel(std::string_view content) {
  keep(content.size());
  ByteReader in(content);
  McapChannel channel;
  channel.id = in.get<std::uint16_t>();
  channel.schema = in.get<std::uint16_t>();
  channel.topic = in.getText();
  channel.encoding = in.getText();
  channels_.emplace(channel.id, channel);
}

void McapReader::takeAttachment(std::string_view content) {
  keep(content.size());
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

TimeNs McapReader::firstTime() const {
  TimeNs first = std::numeric_limits<TimeNs>::max();
  for (const Part& part : parts_) first = std::min(first, part.start);
  return parts_.empty() ? 0 : first;
}

TimeNs McapReader::lastTime() const {
  TimeNs last = 0;
  for (const Part& part : parts_)
    if (part.end != std::numeric_limits<TimeNs>::max()) last = std::max(last, part.end);
  return last;
}

McapReader::Reading McapReader::read(const std::function<void(const McapMessage&)>& show) {
  return read(Selection{}, show);
}

bool McapReader::mayHold(const Part& part, const Selection& selection) {
  const bool dated = part.start >= 0 && part.start <= part.end;  // unless its head is damaged
  if (dated && (part.end < selection.from || part.start > selection.to)) return false;
  // Of a chunk that was cut off from its index nobody knows what it holds.
  return selection.channels.empty() || part.channels.empty() ||
         std::any_of(part.channels.begin(), part.channels.end(),
                     [&](std::uint16_t channel) { return selection.channels.contains(channel); });
}

McapReader::Reading McapReader::read(const Selection& selection,
                                     const std::function<void(const McapMessage&)>& show) {
  Reading reading;
  for (std::size_t chunk = 0; chunk < parts_.size(); ++chunk) {
    if (!mayHold(chunk, selection)) continue;
    const Reading one = readChunk(chunk, selection, show);
    reading.chunks += one.chunks;
    reading.messages += one.messages;
    reading.damaged_chunks += one.damaged_chunks;
  }
  return reading;
}

McapReader::Reading McapReader::readChunk(std::size_t chunk, const Selection& selection,
                                          const std::function<void(const McapMessage&)>& show) {
  Reading reading;
  const auto show_selected = [&](const McapMessage& message) {
    if (message.log_time < selection.from || message.log_time > selection.to) return;
    if (!selection.channels.empty() && !selection.channels.contains(message.channel)) return;
    ++reading.messages;
    show(message);
  };
  ++reading.chunks;
  reading.damaged_chunks += !readChunk(parts_[chunk], show_selected);
  return reading;
}

bool McapReader::readChunk(const Part& part, const std::function<void(const McapMessage&)>& show) {
  std::string plain;
  try {
    if (part.length > kLargestChunk) return false;
    const std::string content = bytesAt(part.offset, part.length);
    if (part.opcode == McapOpcode::kMessage) {
      readRecords(bytesAt(part.offset - kMcapRecordHead, part.length + kMcapRecordHead), show);
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
    readRecords(plain, show);
    return true;
  } catch (const CutShort&) {
    return false;
  }
}

void McapReader::readRecords(std::string_view records, const std::function<void(const McapMessage&)>& show) {
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
    if (shown.log_time < 0 || shown.log_time > kLatest) throw CutShort();
    shown.payload = message.rest();
    show(shown);
  }
}

McapReader::Selection withoutImages(const McapReader& session) {
  McapReader::Selection selection;
  for (const auto& [id, channel] : session.channels()) {
    const auto schema = session.schemas().find(channel.schema);
    if (schema == session.schemas().end() || !isImageMessage(schema->second.name))
      selection.channels.insert(id);
  }
  return selection;
}

}  // namespace helical
