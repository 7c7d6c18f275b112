#include "tests/session/session_mutations.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <vector>

#include "engine/session/mcap_reader.h"
#include "engine/session/mcap_writer.h"

namespace helical::test {
namespace {

std::size_t draw(Random& random, std::size_t below) {
  return below == 0 ? 0 : static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(below) - 1e-6));
}

char byte(Random& random) {
  return static_cast<char>(draw(random, 256));
}

struct Block {
  std::size_t at = 0, size = 0;
};

Block someBlock(const std::string& bytes, Random& random) {
  const std::size_t at = draw(random, bytes.size());
  return {at, std::min(bytes.size() - at, 1 + draw(random, 1 + draw(random, 4096)))};
}

/// The records that stand one after the other from the begin.
std::vector<Block> recordsOf(const std::string& bytes) {
  std::vector<Block> records;
  std::uint64_t length = 0;
  for (std::size_t at = kMcapMagic.size(); at + kMcapRecordHead <= bytes.size();) {
    std::memcpy(&length, bytes.data() + at + 1, sizeof length);
    if (length > bytes.size() - at - kMcapRecordHead) break;
    records.push_back({at, kMcapRecordHead + static_cast<std::size_t>(length)});
    at += records.back().size;
  }
  return records;
}

std::uint64_t absurd(Random& random, std::uint64_t true_one) {
  const std::array<std::uint64_t, 8> choices{0,
                                             1,
                                             true_one - 1,
                                             true_one + 1,
                                             2 * true_one,
                                             std::uint64_t{1} << 32,
                                             std::uint64_t{1} << 62,
                                             ~std::uint64_t{0}};
  return choices[draw(random, choices.size())];
}

/// A length of 8 bytes: a record's, or one inside it (a chunk's sizes, an attachment's).
void breakLength(std::string& bytes, Random& random) {
  const auto records = recordsOf(bytes);
  if (records.empty()) return;
  const Block record = records[draw(random, records.size())];
  const std::array<std::size_t, 4> places{1, kMcapRecordHead, kMcapRecordHead + 8, kMcapRecordHead + 16};
  const std::size_t at = record.at + places[draw(random, places.size())];
  if (at + sizeof(std::uint64_t) > bytes.size()) return;
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  value = absurd(random, value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

void damage(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const Block block = someBlock(bytes, random), other = someBlock(bytes, random);
  switch (draw(random, 10)) {
    case 0:
      bytes[block.at] = static_cast<char>(bytes[block.at] ^ (1 << draw(random, 8)));
      return;
    case 1:
      bytes.resize(block.at);
      return;
    case 2:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(block.at), block.size, '\0');
      return;
    case 3:
      for (std::size_t i = 0; i < block.size; ++i) bytes[block.at + i] = byte(random);
      return;
    case 4: {
      const std::size_t size = std::min(block.size, other.size);
      for (std::size_t i = 0; i < size; ++i) std::swap(bytes[block.at + i], bytes[other.at + i]);
      return;
    }
    case 5:
      bytes.insert(other.at, bytes.substr(block.at, block.size));
      return;
    case 6:
    case 7: {
      const auto records = recordsOf(bytes);
      if (records.empty()) return;
      const Block record = records[draw(random, records.size())], place = records[draw(random, records.size())];
      const std::string copy = bytes.substr(record.at, record.size);
      if (draw(random, 2) == 0)
        bytes.insert(place.at, copy);
      else
        bytes.erase(record.at, record.size);
      return;
    }
    default:
      breakLength(bytes, random);
  }
}

/// Numbers where they hurt: lengths, infinities, NaNs; or any bytes at all.
std::string damaged(std::string text, Random& random) {
  constexpr std::array<std::uint64_t, 6> kWords{~std::uint64_t{0},     std::uint64_t{0x7ff0000000000000},
                                                0x7ff8000000000000,    std::uint64_t{1} << 63,
                                                0x7fffffffffffffff,    0xffffffff};
  for (std::size_t hits = 1 + draw(random, 3); hits > 0 && text.size() > 12; --hits) {
    const std::size_t at = draw(random, text.size() - 8);
    const std::uint64_t word = kWords[draw(random, kWords.size())];
    const std::size_t kind = draw(random, 4);
    if (kind == 0)
      text[at] = byte(random);
    else if (kind == 1)
      text.resize(at);
    else
      std::memcpy(text.data() + (kind == 2 ? at / 4 * 4 : at), &word, kind == 2 ? 4 : 8);
  }
  return text;
}

}  // namespace

std::string mutateBytes(const std::string& bytes, Random& random) {
  std::string mutant = bytes;
  for (std::size_t hits = 1 + draw(random, 4); hits > 0; --hits) damage(mutant, random);
  return mutant;
}

void mutateContent(const std::filesystem::path& from, const std::filesystem::path& to, Random& random) {
  McapReader reader(from);
  McapWriter writer(to, "library");
  const std::size_t aim = draw(random, 8);  // attachments and definitions seldom: little is left without them
  for (McapAttachment attachment : reader.attachments()) {
    if (aim == 0) attachment.content = damaged(attachment.content, random);
    writer.addAttachment(attachment);
  }
  std::map<std::uint16_t, std::uint16_t> schemas, channels;
  for (const auto& [id, schema] : reader.schemas())
    schemas[id] = writer.addSchema(schema.name, schema.encoding,
                                   aim == 1 ? damaged(schema.definition, random) : schema.definition);
  for (const auto& [id, channel] : reader.channels())
    channels[id] = writer.addChannel(schemas.at(channel.schema), channel.topic, channel.encoding);
  reader.read([&](const McapMessage& message) {
    const bool hit = aim > 1 && draw(random, 40) == 0;
    const TimeNs time = hit && draw(random, 4) == 0 ? static_cast<TimeNs>(absurd(random, 1000)) : message.log_time;
    const std::string payload(message.payload);
    writer.addMessage(channels.at(message.channel), time, time, hit ? damaged(payload, random) : payload);
  });
  writer.close();
}

}  // namespace helical::test
