#include "engine/markers/extracting_source.h"

#include <gtest/gtest.h>

#include "tests/markers/scenes.h"

namespace helical {
namespace {

/// Gives the empty field, then a ball, then nothing.
class TwoFrames final : public CameraSource {
 public:
  TwoFrames() : picture_(160, 120) { picture_.fill(120, 120, 120); }
  CameraId camera() const override { return cameraId(2); }
  bool poll(Frame& frame) override {
    if (given_ == 2) return false;
    if (given_ == 1) picture_.drawDisc(80, 60, 6, 45, 190, 50);
    frame = {camera(), static_cast<std::uint64_t>(10 + given_), 1000 + given_, 2000 + given_,
             picture_.view()};
    ++given_;
    return true;
  }
  void wait(TimeNs) override {}

 private:
  test::Picture picture_;
  int given_ = 0;
};

TEST(ExtractingSource, PassesStampsOnAndShowsEveryFrame) {
  MarkerOptions options;
  options.background_frames = 1;
  int shown = 0;
  ExtractingSource source(std::make_unique<TwoFrames>(), options,
                          [&shown](const Frame& frame, const Observation& o, const Extractor&) {
                            ++shown;
                            EXPECT_EQ(frame.sequence, o.sequence);
                          });
  Observation observation;
  ASSERT_TRUE(source.poll(observation));
  ASSERT_TRUE(source.poll(observation));
  EXPECT_EQ(observation.camera, cameraId(2));
  EXPECT_EQ(observation.sequence, 11U);
  EXPECT_EQ(observation.exposure, 1001);
  EXPECT_EQ(observation.arrival, 2001);
  EXPECT_GT(observation.extraction, 0);
  EXPECT_EQ(observation.count, 1);
  EXPECT_FALSE(source.poll(observation));
  EXPECT_EQ(shown, 2);
}

}  // namespace
}  // namespace helical
