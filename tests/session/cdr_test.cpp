#include "engine/session/cdr.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/session/flight_messages.h"

namespace helical {
namespace {

TEST(Cdr, AlignsEveryNumberToItsOwnSizeBehindTheHead) {
  CdrWriter out;
  out.put(std::uint8_t{7});
  out.put(std::uint32_t{0x01020304});
  out.putText("ab");
  out.put(1.0);
  const std::string expected(
      "\0\1\0\0"
      "\7\0\0\0"
      "\4\3\2\1"
      "\3\0\0\0ab\0\0"
      "\0\0\0\0"
      "\0\0\0\0\0\0\xf0\x3f",
      32);
  EXPECT_EQ(out.bytes().substr(0, 20), expected.substr(0, 20));
  EXPECT_EQ((out.bytes().size() - CdrWriter::kCdrHead) % 8, 0u);
  EXPECT_EQ(out.bytes().substr(out.bytes().size() - 8), expected.substr(expected.size() - 8));
}

TEST(Cdr, ReadsBackWhatWasWritten) {
  CdrWriter out;
  out.put(true);
  out.putText("nose");
  out.put(-0.1);
  out.put(std::uint16_t{9});
  out.put(std::int64_t{-5});
  CdrReader in(out.bytes());
  EXPECT_TRUE(in.getBool());
  EXPECT_EQ(in.getText(), "nose");
  EXPECT_EQ(in.get<double>(), -0.1);
  EXPECT_EQ(in.get<std::uint16_t>(), 9);
  EXPECT_EQ(in.get<std::int64_t>(), -5);
  EXPECT_TRUE(in.atEnd());
  EXPECT_THROW(in.get<double>(), CutShort);
}

TEST(FlightMessages, AnObservationComesBackToTheLastBit) {
  UsedObservation used;
  Observation& observation = used.observation;
  observation.sequence = 41;
  observation.exposure = 123456789;
  observation.arrival = 123456999;
  observation.extraction = 77;
  observation.truncated = true;
  observation.count = 3;
  for (int i = 0; i < 3; ++i) {
    Centroid& centroid = observation.centroids[static_cast<std::size_t>(i)];
    centroid.pixel = {0.1 + i, std::sqrt(2.0) * i};
    centroid.covariance << 0.1, 0.2 / 3.0, 0.2 / 3.0, 0.7;
    centroid.area_px = 31.0 / 7.0;
    centroid.radius_px = 1.0 / 3.0;
    centroid.colour = i;
  }
  used.used = 130000000;
  CdrWriter out;
  encodeObservation(out, 5, used, 4, "camera_1");
  const DecodedObservation back = decodeObservation(out.bytes());
  EXPECT_EQ(back.order, 5u);
  EXPECT_EQ(back.used, used.used);
  EXPECT_EQ(back.observation.sequence, 41u);
  EXPECT_EQ(back.observation.exposure, observation.exposure);
  EXPECT_EQ(back.observation.arrival, observation.arrival);
  EXPECT_EQ(back.observation.extraction, 77);
  EXPECT_TRUE(back.observation.truncated);
  ASSERT_EQ(back.observation.count, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Centroid &sent = observation.centroids[i], &received = back.observation.centroids[i];
    EXPECT_EQ(received.pixel, sent.pixel);
    EXPECT_EQ(received.covariance, sent.covariance);
    EXPECT_EQ(received.area_px, sent.area_px);
    EXPECT_EQ(received.radius_px, sent.radius_px);
    EXPECT_EQ(received.colour, sent.colour);
  }
}

TEST(FlightMessages, CutPayloadsAreRefusedAtEveryLength) {
  UsedObservation used;
  used.observation.count = 2;
  CdrWriter out;
  encodeObservation(out, 1, used, 4, "camera_1");
  for (std::size_t size = 0; size < out.bytes().size(); ++size)
    EXPECT_THROW(decodeObservation(std::string_view(out.bytes()).substr(0, size)), CutShort) << size;
}

TEST(FlightMessages, ExtrinsicsSayWhereTheCameraIsAndHowSurelyAsRosDoes) {
  CameraEstimate estimate;
  estimate.camera_from_world = {Eigen::Quaterniond(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX())),
                                Eigen::Vector3d(0.0, 0.0, 2.0)};
  estimate.covariance.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  CdrWriter out;
  encodeExtrinsics(out, 0, estimate);
  CdrReader in(out.bytes());
  in.get<std::int32_t>();
  in.get<std::uint32_t>();
  in.getText();
  EXPECT_NEAR(in.get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(in.get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(in.get<double>(), 2.0, 1e-12);  // it looks down from 2 m
  for (int i = 0; i < 4; ++i) in.get<double>();
  const double expected[] = {4.0, 5.0, 6.0, 1.0, 2.0, 3.0};
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      EXPECT_NEAR(in.get<double>(), row == column ? expected[row] : 0.0, 1e-12);
  EXPECT_TRUE(in.atEnd());
}

}  // namespace
}  // namespace helical
