// Recordings as cameras: files that the tests make, on a clock that they move.

#include "engine/cameras/file/file_camera.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "engine/base/error.h"
#include "tests/support/error_of.h"

namespace helical {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 64, kHeight = 48;
constexpr TimeNs kMs = kNanosecondsPerMillisecond;

/// A folder of the test's own. Frame i is a grey picture of brightness `grey(i)`.
class Files {
 public:
  Files() : folder_(fs::path(testing::TempDir()) / ("files-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Files() { fs::remove_all(folder_); }

  static int grey(int frame) { return 10 + 8 * frame; }

  fs::path video(const std::string& name, int frames, double rate_hz) const {
    const fs::path file = folder_ / name;
    cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate_hz,
                           {kWidth, kHeight});
    for (int i = 0; i < frames; ++i) writer.write(cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(grey(i))));
    writer.release();
    return file;
  }
  fs::path images(int count) const {
    const fs::path sub = folder_ / "images";
    fs::create_directories(sub);
    for (int i = 0; i < count; ++i)
      cv::imwrite((sub / (std::to_string(i) + ".png")).string(),
                  cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(grey(i))));
    return sub;
  }

 private:
  fs::path folder_;
};

struct Player {
  explicit Player(const fs::path& file, double rate_hz = 50.0, int width = kWidth) {
    DeviceOptions options;
    options.rate_hz = rate_hz;
    options.readout_ms = 8.0;
    camera = std::make_unique<FileCamera>(cameraId(0), file, options, width, kHeight, clock, link);
  }
  std::shared_ptr<ManualClock> clock = std::make_shared<ManualClock>();
  std::shared_ptr<CameraLink> link = std::make_shared<CameraLink>();
  std::unique_ptr<FileCamera> camera;
};

TEST(FileCamera, PlaysAVideoAtItsOwnRateToItsEnd) {
  const Files files;
  Player player(files.video("film.avi", 12, 40.0));
  EXPECT_EQ(player.link->state, LinkState::kStreaming);
  Frame frame;
  int frames = 0;
  for (TimeNs now = 0; now < 1000 * kMs; now += kMs) {
    player.clock->set(now);
    while (player.camera->poll(frame)) {
      EXPECT_EQ(frame.sequence, static_cast<std::uint64_t>(frames));
      EXPECT_EQ(frame.exposure, frames * 25 * kMs);
      EXPECT_EQ(frame.arrival, frame.exposure + 8 * kMs);
      EXPECT_EQ(frame.arrival, now) << "given out at another time than it arrives";
      EXPECT_EQ(frame.image.width, kWidth);
      EXPECT_NEAR(frame.image.row(kHeight / 2)[3 * kWidth / 2], Files::grey(frames), 3);
      ++frames;
    }
  }
  EXPECT_EQ(frames, 12);
  EXPECT_EQ(player.link->state, LinkState::kLost);
}

TEST(FileCamera, PlaysAFolderOfImagesAtTheRigsRateInTheOrderOfTheirNumbers) {
  const Files files;
  Player player(files.images(12), 50.0);
  Frame frame;
  for (int i = 0; i < 12; ++i) {
    player.clock->set((20 * i + 7) * kMs);
    EXPECT_FALSE(player.camera->poll(frame));
    player.clock->set((20 * i + 8) * kMs);
    ASSERT_TRUE(player.camera->poll(frame));
    EXPECT_EQ(frame.exposure, 20 * i * kMs);
    EXPECT_EQ(frame.image.row(0)[0], Files::grey(i));
  }
}

TEST(FileCamera, SeveralRunInStep) {
  const Files files;
  Player one(files.video("one.avi", 10, 25.0)), two(files.video("two.avi", 10, 25.0));
  Frame a, b;
  for (int i = 0; i < 10; ++i) {
    one.clock->set((40 * i + 8) * kMs);
    two.clock->set((40 * i + 8) * kMs);
    ASSERT_TRUE(one.camera->poll(a) && two.camera->poll(b));
    EXPECT_EQ(a.exposure, b.exposure);
    EXPECT_EQ(a.sequence, b.sequence);
  }
}

TEST(FileCamera, LosesWhatAMachineInRealTimeWasTooSlowFor) {
  const Files files;
  Player player(files.images(20), 50.0);
  Frame frame;
  player.clock->set(8 * kMs);
  ASSERT_TRUE(player.camera->poll(frame));
  player.clock->set(208 * kMs);
  ASSERT_TRUE(player.camera->poll(frame));
  EXPECT_EQ(frame.sequence, 7U) << "three frames are kept for a reader that is late";
}

TEST(FileCamera, SaysWhereACutOffVideoEnds) {
  const Files files;
  const fs::path film = files.video("film.avi", 30, 30.0);
  Frame frame;
  fs::resize_file(film, fs::file_size(film) / 2);
  Player player(film, 50.0);
  testing::internal::CaptureStderr();
  int frames = 0;
  for (TimeNs now = 0; now < 2000 * kMs; now += kMs) {
    player.clock->set(now);
    while (player.camera->poll(frame)) ++frames;
  }
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(player.link->state, LinkState::kStalled);
  EXPECT_GT(frames, 0);
  EXPECT_LT(frames, 30);
  EXPECT_NE(log.find("frame " + std::to_string(frames)), std::string::npos) << log;
}

TEST(FileCamera, RefusesWhatIsNotTheCameras) {
  const Files files;
  const Error size = errorOf([&] { Player(files.images(2), 50.0, 2 * kWidth); });
  EXPECT_EQ(size.kind(), ErrorKind::kInput);
  EXPECT_NE(std::string(size.what()).find("64x48"), std::string::npos) << size.what();
  const Error absent = errorOf([&] { Player("/no/such/film.mp4"); });
  EXPECT_EQ(absent.kind(), ErrorKind::kInput);
  EXPECT_NE(std::string(absent.what()).find("/no/such/film.mp4"), std::string::npos);
}

}  // namespace
}  // namespace helical
