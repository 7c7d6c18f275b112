#include "engine/session/csv_export.h"

#include <algorithm>
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

/// All tables of an export; those that are not finished are gone with it.
class Tables {
 public:
  Tables(McapReader& session, std::filesystem::path folder) : session_(session), folder_(std::move(folder)) {}
  ~Tables() {
    std::error_code ignored;
    for (const auto& [id, table] : tables_)
      if (table && !finished_) std::filesystem::remove(table->file(), ignored);
  }
  Tables(const Tables&) = delete;
  Tables& operator=(const Tables&) = delete;

  void add(const McapMessage& message) {
    std::unique_ptr<Table>& table = tables_[message.channel];
    if (!table) {
      const auto channel = session_.channels().find(message.channel);
      if (channel == session_.channels().end()) return;
      const auto schema = session_.schemas().find(channel->second.schema);
      if (schema == session_.schemas().end()) return;
      table = std::make_unique<Table>(folder_ / fileNameOf(channel->second.topic), channel->second, schema->second);
    }
    table->add(message);
  }
  /// What their columns mean.
  std::string finish(std::vector<std::filesystem::path>& files) {
    std::string descriptions;
    for (const auto& [id, table] : tables_) {
      if (!table) continue;
      table->close();
      descriptions += table->description();
      files.push_back(table->file());
    }
    finished_ = true;
    return descriptions;
  }

 private:
  McapReader& session_;
  std::filesystem::path folder_;
  std::map<std::uint16_t, std::unique_ptr<Table>> tables_;
  bool finished_ = false;
};

McapReader::Selection chosenChannels(const McapReader& session, const CsvSelection& selection) {
  McapReader::Selection chosen = withoutImages(session);
  chosen.from = selection.span.from;
  chosen.to = selection.span.to;
  const std::vector<std::string> known = tableTopics(session);
  for (const auto& topic : selection.topics)
    if (std::find(known.begin(), known.end(), topic) == known.end())
      throw Error(ErrorKind::kInput, "the session has no stream " + topic, session.file().string(),
                  known.empty() ? "give another session" : "give one such as " + known.front());
  if (!selection.topics.empty())
    std::erase_if(chosen.channels, [&](std::uint16_t id) {
      return !selection.topics.contains(session.channels().at(id).topic);
    });
  return chosen;
}

}  // namespace

std::vector<std::string> tableTopics(const McapReader& session) {
  std::vector<std::string> topics;
  for (const std::uint16_t id : withoutImages(session).channels) topics.push_back(session.channels().at(id).topic);
  std::sort(topics.begin(), topics.end());
  return topics;
}

CsvExport exportCsv(McapReader& session, const std::filesystem::path& folder, const CsvSelection& selection,
                    const ExportProgress& progress) {
  const McapReader::Selection chosen = chosenChannels(session, selection);
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorKind::kInput, "the folder for the export cannot be made: " + failure.message(),
                folder.string(), kCure);
  CsvExport result;
  Tables tables(session, folder);
  for (std::size_t chunk = 0; chunk < session.chunkCount(); ++chunk) {
    if (progress) progress(static_cast<double>(chunk) / static_cast<double>(session.chunkCount()));
    if (!session.mayHold(chunk, chosen)) continue;
    const McapReader::Reading one =
        session.readChunk(chunk, chosen, [&](const McapMessage& message) { tables.add(message); });
    result.reading.messages += one.messages;
    result.reading.chunks += one.chunks;
    result.reading.damaged_chunks += one.damaged_chunks;
  }
  const std::string readme = kReadmeHead + tables.finish(result.files);
  const auto write = [&](const std::string& name, const std::string& content) {
    std::ofstream stream = openFile(folder / name);
    stream << content;
    closeFile(stream, folder / name);
    result.files.push_back(folder / name);
  };
  for (const auto& attachment : session.attachments()) {
    const std::string name = std::filesystem::path(attachment.name).filename().string();
    if (!name.empty() && name != "." && name != "..") write(name, attachment.content);
  }
  write("README.md", readme);
  return result;
}

}  // namespace helical
