#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/session/mcap_reader.h"
#include "engine/session/mcap_writer.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using test::messagesOf;
using test::TemporaryFolder;

TEST(Mcap, EverythingComesBackInTheOrderInWhichItWasWritten) {
  const TemporaryFolder folder;
  std::vector<std::string> sent;
  {
    McapWriter writer(folder / "a.mcap", "library");
    writer.addAttachment({"rig.toml", "application/toml", std::string("a\0b", 3)});
    const auto schema = writer.addSchema("pkg/msg/Name", "ros2msg", "float64 x\n");
    const auto first = writer.addChannel(schema, "/first", "cdr");
    const auto second = writer.addChannel(schema, "/second", "cdr");
    for (int i = 0; i < 1000; ++i) {
      const std::string payload(static_cast<std::size_t>(i % 37), static_cast<char>(i));
      writer.addMessage(i % 3 == 0 ? second : first, 1000 - i / 2, i, payload);
      sent.push_back((i % 3 == 0 ? "/second@" : "/first@") + std::to_string(1000 - i / 2) + ":" + payload);
      if (i % 100 == 50) writer.flush();
    }
    writer.close();
  }
  McapReader reader(folder / "a.mcap");
  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(reader.profile(), "ros2");
  EXPECT_EQ(reader.library(), "library");
  EXPECT_EQ(reader.chunkCount(), 11u);
  ASSERT_EQ(reader.attachments().size(), 1u);
  EXPECT_EQ(reader.attachments()[0].content, std::string("a\0b", 3));
  EXPECT_EQ(messagesOf(reader), sent);
}

TEST(Mcap, AFileWithoutMessagesIsComplete) {
  const TemporaryFolder folder;
  McapWriter(folder / "a.mcap", "library").close();
  McapReader reader(folder / "a.mcap");
  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(reader.read([](const McapMessage&) {}).messages, 0u);
}

TEST(Mcap, WhatIsNoMcapFileIsRefusedWithACure) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "empty", "");
  test::writeBytes(folder / "foreign", "%PDF-1.4 and more");
  for (const auto& file : {folder / "empty", folder / "foreign", folder / "missing", folder / ""}) {
    try {
      McapReader reader(file);
      ADD_FAILURE() << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << file;
      EXPECT_EQ(error.where(), file.string());
      EXPECT_FALSE(error.cure().empty());
    }
  }
}

TEST(Mcap, AFullDiskIsAnError) {
  EXPECT_THROW(McapWriter("/dev/full", "library"), Error);
  EXPECT_THROW(McapWriter("/no/such/folder/a.mcap", "library"), Error);
}

}  // namespace
}  // namespace helical
