#include "engine/session/mcap_writer.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "engine/base/check.h"
#include "engine/base/error.h"

namespace helical {
namespace {

constexpr int kCompressionLevel = 1;
constexpr std::size_t kChunkSize = 256u << 10;
constexpr const char* kCure = "choose a folder that can be written to, on a disk with space";

std::string record(McapOpcode opcode, std::string_view content) {
  ByteWriter out;
  out.put(static_cast<std::uint8_t>(opcode));
  out.put(static_cast<std::uint64_t>(content.size()));
  out.putRaw(content);
  return out.bytes();
}

std::string compress(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kCompressionLevel);
  HELICAL_CHECK(!ZSTD_isError(size));
  out.resize(size);
  return out;
}

/// A file over the process's limit, or a pipe that nobody reads any more, is an error to be told and no
/// reason to end the flight: while this lives, they do not signal this thread.
class QuietWrites {
 public:
  QuietWrites() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGXFSZ);
    sigaddset(&signals_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~QuietWrites() {
    const timespec at_once{};
    const int code = errno;
    while (sigtimedwait(&signals_, nullptr, &at_once) > 0) {
    }
    errno = code;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  QuietWrites(const QuietWrites&) = delete;
  QuietWrites& operator=(const QuietWrites&) = delete;

 private:
  sigset_t signals_{}, before_{};
};

}  // namespace

McapWriter::McapWriter(std::filesystem::path file, const std::string& library) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644);
  if (descriptor_ < 0)
    throw Error(ErrorKind::kInput, std::string("the session cannot be recorded: ") + std::strerror(errno),
                file_.string(), kCure);
  // Whoever looks for sessions that were cut off sees that this one is being written.
  static_cast<void>(::flock(descriptor_, LOCK_EX | LOCK_NB));
  ByteWriter header;
  header.putText("ros2");
  header.putText(library);
  try {
    write(std::string(kMcapMagic) + record(McapOpcode::kHeader, header.bytes()));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

McapWriter::~McapWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint16_t McapWriter::addSchema(const std::string& name, const std::string& encoding,
                                    const std::string& definition) {
  ByteWriter content;
  content.put(++schemas_);
  content.putText(name);
  content.putText(encoding);
  content.putText(definition);
  const std::string whole = record(McapOpcode::kSchema, content.bytes());
  write(whole);
  schema_records_ += whole;
  return schemas_;
}

std::uint16_t McapWriter::addChannel(std::uint16_t schema, const std::string& topic,
                                     const std::string& encoding, Weight weight) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  channels_[id].weight = weight;
  ByteWriter metadata;
  metadata.putText("offered_qos_profiles");  // rosbag2 asks for it
  metadata.putText("");
  ByteWriter content;
  content.put(id);
  content.put(schema);
  content.putText(topic);
  content.putText(encoding);
  content.putText(metadata.bytes());
  const std::string whole = record(McapOpcode::kChannel, content.bytes());
  write(whole);
  channel_records_ += whole;
  return id;
}

void McapWriter::addAttachment(const McapAttachment& attachment) {
  ByteWriter content;
  content.put(std::uint64_t{0});  // logged and made when the session began
  content.put(std::uint64_t{0});
  content.putText(attachment.name);
  content.putText(attachment.media_type);
  content.put(static_cast<std::uint64_t>(attachment.content.size()));
  content.putRaw(attachment.content);
  content.put(crc32(0, content.bytes()));
  const std::string whole = record(McapOpcode::kAttachment, content.bytes());
  ByteWriter index;
  index.put(written_);
  index.put(static_cast<std::uint64_t>(whole.size()));
  index.put(std::uint64_t{0});
  index.put(std::uint64_t{0});
  index.put(static_cast<std::uint64_t>(attachment.content.size()));
  index.putText(attachment.name);
  index.putText(attachment.media_type);
  write(whole);
  attachment_indexes_ += record(McapOpcode::kAttachmentIndex, index.bytes());
  ++attachments_;
}

void McapWriter::addMessage(std::uint16_t channel, TimeNs log_time, TimeNs publish_time,
                            std::string_view payload) {
  const auto logged = static_cast<std::uint64_t>(std::max<TimeNs>(0, log_time));
  Channel& to = channels_.at(channel);
  Chunk& chunk = open_[static_cast<std::size_t>(to.weight)];
  const bool first = chunk.records.size() == 0;
  to.index.emplace_back(logged, chunk.records.size());
  chunk.records.put(static_cast<std::uint8_t>(McapOpcode::kMessage));
  chunk.records.put(static_cast<std::uint64_t>(2 + 4 + 8 + 8 + payload.size()));
  chunk.records.put(channel);
  chunk.records.put(static_cast<std::uint32_t>(to.messages++));
  chunk.records.put(logged);
  chunk.records.put(static_cast<std::uint64_t>(std::max<TimeNs>(0, publish_time)));
  chunk.records.putRaw(payload);
  chunk.start = first ? logged : std::min(chunk.start, logged);
  chunk.end = first ? logged : std::max(chunk.end, logged);
  first_ = messages_ == 0 ? logged : std::min(first_, logged);
  last_ = std::max(last_, logged);
  ++messages_;
  if (chunk.records.size() >= kChunkSize) flush(to.weight);
}

void McapWriter::flush() {
  flush(Weight::kLight);
  flush(Weight::kBulky);
  flush(Weight::kRare);
}

void McapWriter::flush(Weight weight) {
  Chunk& chunk = open_[static_cast<std::size_t>(weight)];
  if (chunk.records.size() == 0) return;
  const std::string compressed = compress(chunk.records.bytes());
  ByteWriter content;
  content.put(chunk.start);
  content.put(chunk.end);
  content.put(static_cast<std::uint64_t>(chunk.records.size()));
  content.put(crc32(0, chunk.records.bytes()));
  content.putText("zstd");
  content.put(static_cast<std::uint64_t>(compressed.size()));
  content.putRaw(compressed);
  const std::string whole = record(McapOpcode::kChunk, content.bytes());
  ByteWriter offsets;
  const std::string indexes = takeIndexes(weight, written_ + whole.size(), offsets);
  ByteWriter index;
  index.put(chunk.start);
  index.put(chunk.end);
  index.put(written_);
  index.put(static_cast<std::uint64_t>(whole.size()));
  index.putText(offsets.bytes());
  index.put(static_cast<std::uint64_t>(indexes.size()));
  index.putText("zstd");
  index.put(static_cast<std::uint64_t>(compressed.size()));
  index.put(static_cast<std::uint64_t>(chunk.records.size()));
  write(whole + indexes);
  chunk_indexes_ += record(McapOpcode::kChunkIndex, index.bytes());
  ++chunks_;
  chunk.records.clear();
}

std::string McapWriter::takeIndexes(Weight weight, std::uint64_t chunk_end, ByteWriter& offsets) {
  std::string indexes;
  for (auto& [id, channel] : channels_) {
    if (channel.weight != weight || channel.index.empty()) continue;
    ByteWriter entries;
    for (const auto& [time, offset] : channel.index) {
      entries.put(time);
      entries.put(offset);
    }
    ByteWriter index;
    index.put(id);
    index.putText(entries.bytes());
    offsets.put(id);
    offsets.put(chunk_end + indexes.size());
    indexes += record(McapOpcode::kMessageIndex, index.bytes());
    channel.index.clear();
  }
  return indexes;
}

void McapWriter::sync() {
  // Pipes and the like cannot be synced; they are no disks that could lose it.
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    refuse("the session cannot be recorded any more", errno);
}

std::string McapWriter::statistics() const {
  ByteWriter counts;
  for (const auto& [id, channel] : channels_) {
    if (channel.messages == 0) continue;
    counts.put(id);
    counts.put(channel.messages);
  }
  ByteWriter content;
  content.put(messages_);
  content.put(schemas_);
  content.put(static_cast<std::uint32_t>(channels_.size()));
  content.put(attachments_);
  content.put(std::uint32_t{0});  // no metadata
  content.put(chunks_);
  content.put(first_);
  content.put(last_);
  content.putText(counts.bytes());
  return record(McapOpcode::kStatistics, content.bytes());
}

std::string McapWriter::summary(std::uint64_t start) const {
  std::string groups, offsets;
  const auto group = [&](McapOpcode opcode, const std::string& records) {
    if (records.empty()) return;
    ByteWriter content;
    content.put(static_cast<std::uint8_t>(opcode));
    content.put(start + groups.size());
    content.put(static_cast<std::uint64_t>(records.size()));
    offsets += record(McapOpcode::kSummaryOffset, content.bytes());
    groups += records;
  };
  group(McapOpcode::kSchema, schema_records_);
  group(McapOpcode::kChannel, channel_records_);
  group(McapOpcode::kStatistics, statistics());
  group(McapOpcode::kChunkIndex, chunk_indexes_);
  group(McapOpcode::kAttachmentIndex, attachment_indexes_);
  ByteWriter footer;
  footer.put(static_cast<std::uint8_t>(McapOpcode::kFooter));
  footer.put(std::uint64_t{20});
  footer.put(start);
  footer.put(start + groups.size());
  const std::string whole = groups + offsets + footer.bytes();
  ByteWriter crc;
  crc.put(crc32(0, whole));
  return whole + crc.bytes();
}

void McapWriter::close() {
  flush();
  ByteWriter end;
  end.put(data_crc_);
  write(record(McapOpcode::kDataEnd, end.bytes()));
  write(summary(written_) + std::string(kMcapMagic));
  sync();
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) refuse("the session cannot be recorded to its end", errno);
}

void McapWriter::write(std::string_view bytes) {
  const QuietWrites quiet;
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int code = count == 0 ? ENOSPC : errno;
      // Half a record at the end would only be in the way of whoever reads it; if that fails, too, `recover`
      // leaves it out.
      if (done > 0 && ::ftruncate(descriptor_, static_cast<off_t>(written_)) != 0)
        refuse("the session cannot be recorded any more, and its end is damaged", code);
      refuse("the session cannot be recorded any more", code);
    }
    done += static_cast<std::size_t>(count);
  }
  written_ += bytes.size();
  data_crc_ = crc32(data_crc_, bytes);
}

void McapWriter::refuse(const std::string& what, int code) const {
  throw Error(ErrorKind::kSystem, what + ": " + std::strerror(code), file_.string(), kCure);
}

}  // namespace helical
