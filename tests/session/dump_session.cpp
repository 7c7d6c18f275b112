#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/session/mcap_reader.h"
#include "engine/session/message_types.h"
#include "engine/session/ros_message.h"

/// Prints what Helical's reader finds in a session, a JSON object a message in the file's order: tests
/// compare it with what other readers find.
int main(int argc, char** argv) {
  using namespace helical;
  if (argc != 2) return 2;
  try {
    McapReader session(argv[1]);
    std::map<std::uint16_t, std::unique_ptr<RosMessage>> types;
    const auto reading = session.read([&](const McapMessage& message) {
      const McapChannel& channel = session.channels().at(message.channel);
      const McapSchema& schema = session.schemas().at(channel.schema);
      nlohmann::json line{{"topic", channel.topic},
                          {"log_time", std::to_string(message.log_time)},
                          {"publish_time", std::to_string(message.publish_time)},
                          {"crc", crc32(0, message.payload)},
                          {"rows", nlohmann::json::array()}};
      if (!isImageMessage(schema.name)) {
        auto& type = types[message.channel];
        if (!type) type = std::make_unique<RosMessage>(schema.name, schema.definition);
        type->rows(message.payload,
                   [&](const std::vector<std::string>& cells) { line["rows"].push_back(cells); });
      }
      std::printf("%s\n", line.dump().c_str());
    });
    return session.complete() && reading.damaged_chunks == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
