#include "tests/session/session_exercise.h"

#include <functional>
#include <memory>

#include "engine/base/error.h"
#include "engine/session/csv_export.h"
#include "engine/session/flight_playback.h"
#include "engine/session/mcap_recovery.h"
#include "engine/session/replay.h"
#include "engine/session/session_summary.h"

namespace helical::test {
namespace {

void play(const std::filesystem::path& file) {
  FlightPlayback playback(file, std::make_shared<ManualClock>());
  const TimeNs length = playback.end() - playback.begin();
  EngineSnapshot tick;
  EngineEvent event;
  for (const int quarter : {0, 3, 1, 4}) {
    playback.seek(playback.begin() + length / 4 * quarter);
    for (std::size_t i = 0; i < playback.rig().cameras.size(); ++i) {
      const CameraId camera = cameraId(static_cast<int>(i));
      playback.pollPicture(camera);
      playback.pollCalibration(camera);
    }
    while (playback.nextTick(tick)) {
    }
    while (playback.nextEvent(event)) {
    }
  }
  playback.step(1);
  playback.step(-5);
}

void replay(const std::filesystem::path& file) {
  McapReader session(file);
  const SessionSettings settings = fromAttachments(session.attachments(), file.string());
  replaySession(session, settings, {}, [](const EngineSnapshot&) {});
}

void mend(const std::filesystem::path& file, const std::filesystem::path& scratch) {
  const std::filesystem::path copy = scratch / "mended.mcap";
  std::filesystem::copy_file(file, copy, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::remove(scratch / "mended.mcap.damaged");
  recoverMcap(copy);
}

}  // namespace

int exerciseSession(const std::filesystem::path& file, const std::filesystem::path& scratch) {
  int refused = 0;
  const auto attempt = [&refused](const std::function<void()>& step) {
    try {
      step();
    } catch (const Error&) {
      ++refused;
    }
  };
  for (const auto open : {McapReader::Open::kByIndex, McapReader::Open::kByScan})
    attempt([&] { McapReader(file, open).read([](const McapMessage&) {}); });
  attempt([&] {
    McapReader session(file);
    exportCsv(session, scratch / "tables");
  });
  attempt([&] { play(file); });
  attempt([&] {
    McapReader session(file);
    summarize(session, [](double) {});
  });
  attempt([&] { replay(file); });
  attempt([&] { mend(file, scratch); });
  return refused;
}

}  // namespace helical::test
