#include "engine/session/mcap_recovery.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/session/mcap_writer.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using test::bytesOf;
using test::messagesOf;
using test::TemporaryFolder;
using test::writeBytes;

/// A file of eight chunks, where each of them ends, and its messages.
struct Written {
  std::string bytes;
  std::vector<std::size_t> chunk_ends;  ///< the first: where the first chunk begins
  std::vector<std::size_t> messages;    ///< up to there
  std::vector<std::string> all;
};

Written writeChunks(const std::filesystem::path& file) {
  Written written;
  Random random(3);
  McapWriter writer(file, "library");
  writer.addAttachment({"rig.toml", "application/toml", "format_version = 1\n"});
  const auto schema = writer.addSchema("pkg/msg/Name", "ros2msg", "uint8[] x\n");
  const auto channel = writer.addChannel(schema, "/x", "cdr");
  const auto note = [&](std::size_t count) {
    written.chunk_ends.push_back(bytesOf(file).size());
    written.messages.push_back(count);
  };
  note(0);
  for (std::size_t i = 0; i < 160; ++i) {
    std::string payload(static_cast<std::size_t>(50.0 * random.uniform(0.0, 1.0)), '\0');
    for (char& byte : payload) byte = static_cast<char>(255.0 * random.uniform(0.0, 1.0));
    writer.addMessage(channel, static_cast<TimeNs>(i), static_cast<TimeNs>(i), payload);
    if (i % 20 != 19) continue;
    writer.flush();
    note(i + 1);
  }
  writer.close();
  written.bytes = bytesOf(file);
  written.all = messagesOf(file);
  return written;
}

/// Messages that any reader must find in the first `size` bytes.
std::size_t messagesBefore(const Written& written, std::size_t size) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < written.chunk_ends.size(); ++i)
    if (written.chunk_ends[i] <= size) count = written.messages[i];
  return count;
}

void expectMended(const Written& written, const std::filesystem::path& file, std::size_t cut) {
  writeBytes(file, written.bytes.substr(0, cut));
  const Recovery recovery = recoverMcap(file);
  McapReader reader(file);
  EXPECT_TRUE(reader.complete()) << cut;
  EXPECT_EQ(reader.attachments().size(), 1u) << cut;
  const auto messages = messagesOf(reader);
  EXPECT_EQ(messages.size(), recovery.messages) << cut;
  EXPECT_GE(messages.size(), messagesBefore(written, cut)) << cut;
  ASSERT_LE(messages.size(), written.all.size()) << cut;
  EXPECT_TRUE(std::equal(messages.begin(), messages.end(), written.all.begin())) << cut;
  EXPECT_TRUE(recoverMcap(file).was_complete) << cut;
}

TEST(Recovery, MendsAFileThatWasCutBehindAnyChunk) {
  const TemporaryFolder folder;
  const Written written = writeChunks(folder / "whole.mcap");
  for (const std::size_t end : written.chunk_ends) expectMended(written, folder / "cut.mcap", end);
}

TEST(Recovery, MendsAFileThatWasCutAnywhere) {
  const TemporaryFolder folder;
  const Written written = writeChunks(folder / "whole.mcap");
  Random random(17);
  const double span = static_cast<double>(written.bytes.size() - written.chunk_ends[0]);
  for (int i = 0; i < 300; ++i)
    expectMended(written, folder / "cut.mcap",
                 written.chunk_ends[0] + static_cast<std::size_t>(random.uniform(0.0, span)));
}

TEST(Recovery, LeavesACompleteFileAlone) {
  const TemporaryFolder folder;
  const Written written = writeChunks(folder / "whole.mcap");
  const Recovery recovery = recoverMcap(folder / "whole.mcap");
  EXPECT_TRUE(recovery.was_complete);
  EXPECT_EQ(recovery.messages, 160u);
  EXPECT_EQ(bytesOf(folder / "whole.mcap"), written.bytes);
}

TEST(Recovery, AFlippedByteCostsOneChunkAtMost) {
  const TemporaryFolder folder;
  const Written written = writeChunks(folder / "whole.mcap");
  Random random(29);
  const double span = static_cast<double>(written.chunk_ends.back() - written.chunk_ends[0]);
  for (int i = 0; i < 300; ++i) {
    const std::size_t at = written.chunk_ends[0] + static_cast<std::size_t>(random.uniform(0.0, span));
    std::string bytes = written.bytes;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (i % 8)));
    writeBytes(folder / "flipped.mcap", bytes);
    recoverMcap(folder / "flipped.mcap");
    const auto messages = messagesOf(folder / "flipped.mcap");
    EXPECT_GE(messages.size(), 140u) << at;
    EXPECT_TRUE(std::includes(written.all.begin(), written.all.end(), messages.begin(), messages.end(),
                              [&](const std::string& a, const std::string& b) {
                                return std::find(written.all.begin(), written.all.end(), a) <
                                       std::find(written.all.begin(), written.all.end(), b);
                              }))
        << at;
  }
}

TEST(Recovery, NothingToSaveIsAnErrorAndTheFileStays) {
  const TemporaryFolder folder;
  const Written written = writeChunks(folder / "whole.mcap");
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{8}, std::size_t{20}}) {
    writeBytes(folder / "stub.mcap", written.bytes.substr(0, size));
    EXPECT_THROW(recoverMcap(folder / "stub.mcap"), Error) << size;
    EXPECT_EQ(bytesOf(folder / "stub.mcap").size(), size);
  }
}

TEST(Recovery, KeepsTheOriginalWhenSomethingIsLeftOut) {
  const TemporaryFolder folder;
  const Written written = writeChunks(folder / "whole.mcap");
  std::string bytes = written.bytes;
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  writeBytes(folder / "flipped.mcap", bytes);
  const Recovery recovery = recoverMcap(folder / "flipped.mcap");
  EXPECT_EQ(recovery.original, folder / "flipped.mcap.damaged");
  EXPECT_EQ(bytesOf(recovery.original), bytes);
  writeBytes(folder / "flipped.mcap", bytes);
  EXPECT_EQ(recoverMcap(folder / "flipped.mcap").original, folder / "flipped.mcap.damaged2");
  // Of a file that was merely cut off nothing is left out.
  writeBytes(folder / "cut.mcap", written.bytes.substr(0, written.bytes.size() / 2));
  EXPECT_TRUE(recoverMcap(folder / "cut.mcap").original.empty());
  EXPECT_FALSE(std::filesystem::exists(folder / "cut.mcap.damaged"));
}

TEST(Reader, RandomDamageNeverDoesMoreThanLoseMessages) {
  const TemporaryFolder folder;
  const Written written = writeChunks(folder / "whole.mcap");
  Random random(31);
  for (int i = 0; i < 500; ++i) {
    std::string bytes = written.bytes;
    for (int flips = 0; flips < 1 + i % 20; ++flips) {
      const double at = random.uniform(8.0, static_cast<double>(bytes.size()));
      bytes[static_cast<std::size_t>(at)] = static_cast<char>(random.uniform(0.0, 255.0));
    }
    writeBytes(folder / "damaged.mcap", bytes);
    McapReader reader(folder / "damaged.mcap");
    const auto reading = reader.read([](const McapMessage&) {});
    EXPECT_LE(reading.messages, 160u);
  }
}

}  // namespace
}  // namespace helical
