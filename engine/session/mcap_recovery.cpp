#include "engine/session/mcap_recovery.h"

#include <map>

#include "engine/base/error.h"
#include "engine/session/mcap_reader.h"
#include "engine/session/mcap_writer.h"
#include "engine/session/message_types.h"

namespace helical {
namespace {

/// Copies what a reader finds, schemas and channels when the first message needs them.
class Copy {
 public:
  Copy(McapReader& from, McapWriter& to) : from_(from), to_(to) {
    for (const auto& attachment : from.attachments()) to.addAttachment(attachment);
    for (const auto& [id, channel] : from.channels()) channelOf(id);
  }

  void add(const McapMessage& message) {
    const std::uint16_t channel = channelOf(message.channel);
    if (channel == 0) return;  // its channel is lost: nobody could read it
    to_.addMessage(channel, message.log_time, message.publish_time, message.payload);
    ++messages_;
  }
  std::uint64_t messages() const { return messages_; }

 private:
  std::uint16_t channelOf(std::uint16_t id) {
    const auto copied = channels_.find(id);
    if (copied != channels_.end()) return copied->second;
    const auto channel = from_.channels().find(id);
    if (channel == from_.channels().end()) return 0;
    std::uint16_t schema = 0;
    if (channel->second.schema != 0) {
      schema = schemaOf(channel->second.schema);
      if (schema == 0) return 0;
    }
    const auto named = from_.schemas().find(channel->second.schema);
    const std::string name = named == from_.schemas().end() ? "" : named->second.name;
    return channels_[id] =
               to_.addChannel(schema, channel->second.topic, channel->second.encoding, weightOf(name));
  }
  std::uint16_t schemaOf(std::uint16_t id) {
    const auto copied = schemas_.find(id);
    if (copied != schemas_.end()) return copied->second;
    const auto schema = from_.schemas().find(id);
    if (schema == from_.schemas().end()) return 0;
    return schemas_[id] =
               to_.addSchema(schema->second.name, schema->second.encoding, schema->second.definition);
  }

  McapReader& from_;
  McapWriter& to_;
  std::map<std::uint16_t, std::uint16_t> channels_, schemas_;
  std::uint64_t messages_ = 0;
};

/// A second name for the damaged file, one that is free.
std::filesystem::path keepOriginal(const std::filesystem::path& file) {
  std::filesystem::path kept = file;
  kept += ".damaged";
  for (int i = 2; std::filesystem::exists(kept); ++i) {
    kept = file;
    kept += ".damaged" + std::to_string(i);
  }
  std::error_code no_links_here;
  std::filesystem::create_hard_link(file, kept, no_links_here);
  if (no_links_here) std::filesystem::copy_file(file, kept);
  return kept;
}

}  // namespace

Recovery recoverMcap(const std::filesystem::path& file) {
  McapReader reader(file, McapReader::Open::kByScan);
  Recovery recovery;
  const auto count = reader.read([](const McapMessage&) {});
  recovery.damaged_chunks = count.damaged_chunks;
  recovery.messages = count.messages;
  recovery.was_complete = reader.complete() && count.damaged_chunks == 0;
  if (recovery.was_complete) return recovery;
  if (reader.channels().empty())
    throw Error(ErrorKind::kInput, "nothing can be saved of the session: it ends before its first stream",
                file.string(), "delete it");
  std::filesystem::path mended = file;
  mended += ".mended";
  try {
    McapWriter writer(mended, reader.library());
    Copy copy(reader, writer);
    reader.read([&](const McapMessage& message) { copy.add(message); });
    writer.close();
    recovery.messages = copy.messages();
    if (recovery.damaged_chunks > 0 || reader.gaps() > 0) recovery.original = keepOriginal(file);
    std::filesystem::rename(mended, file);
  } catch (const std::filesystem::filesystem_error& failure) {
    std::filesystem::remove(mended);
    throw Error(ErrorKind::kSystem, "the mended session cannot take its place: " + failure.code().message(),
                file.string(), "choose a folder that can be written to");
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(mended, ignored);
    throw;
  }
  return recovery;
}

}  // namespace helical
