#include "engine/session/csv_export.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>

#include "engine/base/error.h"
#include "engine/session/flight_messages.h"
#include "engine/session/message_types.h"
#include "engine/session/ros_message.h"

namespace helical {
namespace {

// A table has no use for a message that packs points into bytes.
constexpr const char* kParticle = "float32 x_m\nfloat32 y_m\nfloat32 z_m\nfloat32 weight\n";
constexpr const char* kCure = "choose a folder that can be written to, on a disk with space";

/// "/cameras/1/observation" is cameras_1_observation.csv.
std::string fileNameOf(const std::string& topic) {
  std::string name;
  for (const char letter : topic) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '-';
    if (letter == '/' && name.empty()) continue;
    name += plain ? letter : '_';
  }
  return (name.empty() ? "stream" : name) + ".csv";
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string result = "\"";
  for (const char letter : cell) result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return result + "\"";
}

std::string secondsText(TimeNs time) {
  std::array<char, 40> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%lld.%09lld",
                static_cast<long long>(time / kNanosecondsPerSecond),
                static_cast<long long>(time % kNanosecondsPerSecond));
  return buffer.data();
}

std::ofstream openFile(const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  if (!stream) throw Error(ErrorKind::kInput, "the export cannot be written", file.string(), kCure);
  return stream;
}

void closeFile(std::ofstream& stream, const std::filesystem::path& file) {
  stream.close();
  if (!stream) throw Error(ErrorKind::kSystem, "the export cannot be written", file.string(), kCure);
}

/// One stream's table, open while the session is read.
class Table {
 public:
  Table(std::filesystem::path file, const McapChannel& channel, const McapSchema& schema)
      : file_(std::move(file)),
        topic_(channel.topic),
        type_(schema.name),
        cloud_(schema.name == messageName(MessageKind::kPointCloud)),
        message_(cloud_ ? "particles" : schema.name, cloud_ ? kParticle : schema.definition),
        stream_(openFile(file_)) {
    stream_ << "time_s [s]";
    for (const auto& column : message_.columns()) stream_ << ',' << header(column);
    stream_ << '\n';
  }

  void add(const McapMessage& message) {
    const std::string time = secondsText(message.log_time);
    if (cloud_) return addCloud(time, message.payload);
    message_.rows(message.payload, [&](const std::vector<std::string>& cells) {
      stream_ << time;
      for (const auto& cell : cells) stream_ << ',' << quoted(cell);
      stream_ << '\n';
      ++rows_;
    });
  }
  void close() { closeFile(stream_, file_); }

  const std::filesystem::path& file() const { return file_; }
  std::string description() const {
    std::string text = "## " + file_.filename().string() + "\n\nThe stream `" + topic_ + "`, messages of `" +
                       type_ + "`, " + std::to_string(rows_) + " rows.\n\n| column | unit |\n|---|---|\n";
    text += "| `time_s` | s |\n";
    for (const auto& column : message_.columns()) text += "| `" + column.name + "` | " + column.unit + " |\n";
    return text + "\n";
  }

 private:
  /// One row a particle.
  void addCloud(const std::string& time, std::string_view payload) {
    CalibrationView view;
    decodeBelief(payload, view);
    for (int i = 0; i < view.count; ++i, ++rows_) {
      const CalibrationView::Particle& particle = view.particles[static_cast<std::size_t>(i)];
      const Eigen::Vector3f& at = particle.centre_in_world;
      stream_ << time << ',' << at.x() << ',' << at.y() << ',' << at.z() << ',' << particle.weight << '\n';
    }
  }
  static std::string header(const RosMessage::Column& column) {
    return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
  }

  std::filesystem::path file_;
  std::string topic_, type_;
  bool cloud_;
  RosMessage message_;
  std::ofstream stream_;
  std::uint64_t rows_ = 0;
};

constexpr const char* kReadmeHead =
    "# A session of Helical as tables\n\n"
    "One CSV file a stream; the first line names the columns with their units in brackets. Commas separate,\n"
    "points are decimal, numbers have as many digits as it takes to read them back unchanged.\n\n"
    "- `time_s`: when the flight thread used or made it, in seconds since the session began. `header.stamp` "
    "of\n"
    "  an observation is the middle of its exposure.\n"
    "- World: z up, metres, its origin where the helicopter stood on the landing pad, x where its nose "
    "pointed.\n"
    "  Body: x forward, y left, z up. Camera: x right, y down, z forward. Pixel (0, 0) is the centre of the\n"
    "  first pixel. Quaternions are x y z w, as in ROS 2.\n"
    "- `extrinsics` and `true_pose` of a camera are its place in the world; `covariance` is of place, then "
    "of\n"
    "  rotation about the world's axes, row by row.\n"
    "- Observations have one row for every centroid, and one with empty cells when there is none. `marker` "
    "is\n"
    "  counted from 0; -1 is a centroid without a name.\n"
    "- `particles` has one row for every hypothesis of where a camera is, thinned out; the heaviest weight "
    "is "
    "1.\n"
    "- true and false are 1 and 0. Images are not exported as tables.\n\n";

}  // namespace

CsvExport exportCsv(McapReader& session, const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorKind::kInput, "the folder for the export cannot be made: " + failure.message(),
                folder.string(), kCure);
  std::map<std::uint16_t, std::unique_ptr<Table>> tables;
  CsvExport result;
  result.reading = session.read(withoutImages(session), [&](const McapMessage& message) {
    std::unique_ptr<Table>& table = tables[message.channel];
    if (!table) {
      const auto channel = session.channels().find(message.channel);
      if (channel == session.channels().end()) return;
      const auto schema = session.schemas().find(channel->second.schema);
      if (schema == session.schemas().end()) return;
      table = std::make_unique<Table>(folder / fileNameOf(channel->second.topic), channel->second,
                                      schema->second);
    }
    table->add(message);
  });
  std::string readme = kReadmeHead;
  for (const auto& [id, table] : tables) {
    if (!table) continue;
    table->close();
    readme += table->description();
    result.files.push_back(table->file());
  }
  const auto write = [&](const std::string& name, const std::string& content) {
    std::ofstream stream = openFile(folder / name);
    stream << content;
    closeFile(stream, folder / name);
    result.files.push_back(folder / name);
  };
  for (const auto& attachment : session.attachments())
    write(std::filesystem::path(attachment.name).filename().string(), attachment.content);
  write("README.md", readme);
  return result;
}

}  // namespace helical
