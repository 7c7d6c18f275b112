#include "engine/session/csv_export.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "engine/base/error.h"
#include "engine/session/mcap_writer.h"
#include "engine/session/message_types.h"
#include "engine/session/ros_message.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rowsOf(const RosMessage& message, const std::string& payload) {
  Rows rows;
  message.rows(payload, [&](const auto& cells) { rows.push_back(cells); });
  return rows;
}

TEST(RosMessage, StructuresAreColumnsAndListsOfThemAreRows) {
  const RosMessage message("pkg/msg/Outer",
                           "byte KIND=3\nuint8 kind # what it is\npkg/Point[] points\nfloat64[2] pair_m\n"
                           "string word\nfloat64[] list\n" +
                               std::string(80, '=') + "\nMSG: pkg/Point\nfloat64 x_px\nint32 y\n");
  std::vector<std::string> names;
  for (const auto& column : message.columns()) names.push_back(column.name + "|" + column.unit);
  EXPECT_EQ(names, (std::vector<std::string>{"kind|", "points.x_px|px", "points.y|", "pair_m[0]|m",
                                             "pair_m[1]|m", "word|", "list|"}));
  CdrWriter out;
  out.put(std::uint8_t{3});
  out.put(std::uint32_t{2});
  for (int i = 0; i < 2; ++i) {
    out.put(0.1 * i);
    out.put(std::int32_t{-i});
  }
  out.put(1.0 / 3.0);
  out.put(2.0);
  out.putText("a,b");
  out.put(std::uint32_t{2});
  out.put(5.0);
  out.put(6.5);
  const Rows rows = rowsOf(message, out.bytes());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"3", "0", "0", "0.3333333333333333", "2", "a,b", "5 6.5"}));
  EXPECT_EQ(rows[1], (std::vector<std::string>{"3", "0.1", "-1", "0.3333333333333333", "2", "a,b", "5 6.5"}));
  for (std::size_t size = 0; size < out.bytes().size(); ++size)
    EXPECT_THROW(rowsOf(message, out.bytes().substr(0, size)), CutShort) << size;
}

TEST(RosMessage, AnEmptyListIsOneRowWithEmptyCells) {
  const RosMessage message("pkg/msg/Outer",
                           "uint8 kind\npkg/Point[] points\nuint8 end\n=====\nMSG: pkg/Point\nfloat64 x\n");
  CdrWriter out;
  out.put(std::uint8_t{1});
  out.put(std::uint32_t{0});
  out.put(std::uint8_t{2});
  EXPECT_EQ(rowsOf(message, out.bytes()), (Rows{{"1", "", "2"}}));
}

TEST(RosMessage, DefinitionsThatMakeNoSenseAreRefused) {
  for (const char* definition : {"pkg/Unknown x\n", "pkg/A x\n=====\nMSG: pkg/A\npkg/A again\n",
                                 "pkg/A[] x\n=====\nMSG: pkg/A\npkg/B[] y\n=====\nMSG: pkg/B\nint8 z\n"})
    EXPECT_THROW(RosMessage("pkg/msg/Outer", definition), Error) << definition;
}

TEST(RosMessage, ReadsEveryKindOfMessageOfASession) {
  for (int kind = 0; kind < kMessageKinds; ++kind) {
    const auto which = static_cast<MessageKind>(kind);
    EXPECT_FALSE(RosMessage(messageName(which), messageDefinition(which)).columns().empty());
  }
}

TEST(CsvExport, WritesATableAStreamAndSaysWhatIsInIt) {
  const test::TemporaryFolder folder;
  {
    McapWriter writer(folder / "a.mcap", "library");
    writer.addAttachment({"rig.toml", "application/toml", "format_version = 1\n"});
    const auto schema = writer.addSchema("pkg/msg/Name", "ros2msg", "float64 speed_m_s\nstring word\n");
    const auto channel = writer.addChannel(schema, "/deep/stream", "cdr");
    writer.addChannel(schema, "/silent", "cdr");
    for (int i = 0; i < 3; ++i) {
      CdrWriter out;
      out.put(0.1 * i);
      out.putText(i == 1 ? "a \"b\", c" : "d");
      writer.addMessage(channel, 1500000000LL * i, 0, out.bytes());
    }
    writer.close();
  }
  McapReader session(folder / "a.mcap");
  const CsvExport result = exportCsv(session, folder / "out");
  EXPECT_EQ(result.files.size(), 3u);
  EXPECT_EQ(test::bytesOf(folder / "out/deep_stream.csv"),
            "time_s [s],speed_m_s [m/s],word\n"
            "0.000000000,0,d\n"
            "1.500000000,0.1,\"a \"\"b\"\", c\"\n"
            "3.000000000,0.2,d\n");
  EXPECT_EQ(test::bytesOf(folder / "out/rig.toml"), "format_version = 1\n");
  EXPECT_NE(test::bytesOf(folder / "out/README.md").find("| `speed_m_s` | m/s |"), std::string::npos);
  EXPECT_THROW(exportCsv(session, "/proc/none"), Error);
}

}  // namespace
}  // namespace helical
