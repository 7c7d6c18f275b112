#include "engine/calibration/intrinsics/intrinsics_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/aruco/charuco.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

const CameraModel kTruth(640, 480, 560.0, 555.0, 325.0, 236.0, {-0.25, 0.08, 1e-3, -5e-4, 0.0});

/// The board seen from `pose`, its corners with noise; empty if it is not wholly in the image.
BoardView project(const Board& board, const RigidTransform& camera_from_board, const CameraModel& camera,
                  double sigma_px, Random& random, const std::string& name) {
  BoardView view;
  view.name = name;
  for (int i = 0; i < board.columns * board.rows; ++i) {
    const Eigen::Vector3d on_board(board.square_m * (i % board.columns), board.square_m * (i / board.columns),
                                   0.0);
    const auto pixel = camera.project(camera_from_board * on_board);
    if (!pixel || !camera.contains(*pixel)) return {};
    view.on_board.push_back(on_board);
    view.pixels.push_back(*pixel + sigma_px * Eigen::Vector2d(random.normal(), random.normal()));
  }
  return view;
}

/// Views all over the image, tilted by up to `tilt_rad`.
std::vector<BoardView> makeViews(int count, double tilt_rad, std::uint64_t seed,
                                 const CameraModel& camera = kTruth) {
  Random random(seed);
  const Board board{9, 6, 0.03, {}, 0.0};
  std::vector<BoardView> views;
  while (static_cast<int>(views.size()) < count) {
    const Eigen::Vector3d turn(random.uniform(-tilt_rad, tilt_rad), random.uniform(-tilt_rad, tilt_rad),
                               random.uniform(-0.3, 0.3));
    const Eigen::Vector3d place(random.uniform(-0.3, 0.1), random.uniform(-0.25, 0.1),
                                random.uniform(0.35, 0.6));
    BoardView view =
        project(board, {expSO3(turn), place}, camera, 0.1, random, "view " + std::to_string(views.size()));
    if (!view.pixels.empty()) views.push_back(std::move(view));
  }
  return views;
}

TEST(Intrinsics, AreFoundWithinTheirSigmas) {
  const IntrinsicsCalibration c = calibrateIntrinsics(makeViews(20, 0.6, 1), 640, 480, false);
  EXPECT_EQ(c.verdict, IntrinsicsVerdict::kGood) << (c.reasons.empty() ? "" : c.reasons.front());
  EXPECT_NEAR(c.model.fx(), 560.0, 4.0 * c.sigma[0]);
  EXPECT_NEAR(c.model.fy(), 555.0, 4.0 * c.sigma[1]);
  EXPECT_NEAR(c.model.cx(), 325.0, 4.0 * c.sigma[2]);
  EXPECT_NEAR(c.model.cy(), 236.0, 4.0 * c.sigma[3]);
  EXPECT_NEAR(c.model.distortion()[0], -0.25, 4.0 * c.sigma[4]);
  EXPECT_LT(c.sigma[0], 1.0);
  EXPECT_GT(c.sigma[0], 0.01);
  EXPECT_NEAR(c.rms_px, 0.1 * std::sqrt(2.0), 0.01);
}

/// (error / sigma)^2 of the focal length is 1 on average when the sigma is true.
TEST(Intrinsics, SigmasAreTrue) {
  double sum = 0.0;
  constexpr int kRuns = 20;
  for (int run = 0; run < kRuns; ++run) {
    const IntrinsicsCalibration c =
        calibrateIntrinsics(makeViews(10, 0.6, 50 + static_cast<std::uint64_t>(run)), 640, 480, false);
    const double error = (c.model.fx() - 560.0) / c.sigma[0];
    sum += error * error;
  }
  // Standard deviation of the mean: sqrt(2 / 20) = 0.32.
  EXPECT_GT(sum / kRuns, 0.3);
  EXPECT_LT(sum / kRuns, 2.0);
}

TEST(Intrinsics, RationalModelFitsAWideLens) {
  const CameraModel wide(640, 480, 300.0, 300.0, 320.0, 240.0,
                         {0.9, 0.15, 1e-3, 0.0, 0.005, 1.2, 0.35, 0.03});
  const auto views = makeViews(25, 0.6, 2, wide);
  const IntrinsicsCalibration c = calibrateIntrinsics(views, 640, 480, true);
  EXPECT_TRUE(c.model.rational());
  EXPECT_LT(c.rms_px, 0.16);
}

TEST(Intrinsics, OutlierViewIsNamedAndLeftOut) {
  auto views = makeViews(15, 0.6, 3);
  Random random(9);
  for (Eigen::Vector2d& pixel : views[4].pixels)
    pixel += 3.0 * Eigen::Vector2d(random.normal(), random.normal());
  const IntrinsicsCalibration c = calibrateIntrinsics(views, 640, 480, false);
  for (std::size_t i = 0; i < c.views.size(); ++i) EXPECT_EQ(c.views[i].used, i != 4) << i;
  EXPECT_EQ(c.views[4].name, "view 4");
  EXPECT_GT(c.views[4].rms_px, 2.0);
  EXPECT_LT(c.rms_px, 0.16);
}

TEST(Intrinsics, ParallelViewsAreBad) {
  const IntrinsicsCalibration c = calibrateIntrinsics(makeViews(15, 0.0, 4), 640, 480, false);
  EXPECT_EQ(c.verdict, IntrinsicsVerdict::kBad);
  EXPECT_NE(c.reasons.front().find("parallel"), std::string::npos);
}

TEST(Intrinsics, TooFewViewsAreRefused) {
  EXPECT_THROW(calibrateIntrinsics(makeViews(2, 0.6, 5), 640, 480, false), Error);
  EXPECT_THROW(calibrateIntrinsics({}, 640, 480, false), Error);
  EXPECT_EQ(calibrateIntrinsics(makeViews(3, 0.6, 6), 640, 480, false).verdict, IntrinsicsVerdict::kBad);
}

TEST(Intrinsics, PartsOfTheImageWithoutCornersAreNamed) {
  auto views = makeViews(60, 0.6, 7);
  std::erase_if(views, [](const BoardView& view) {
    for (const Eigen::Vector2d& pixel : view.pixels)
      if (pixel.x() > 420.0) return true;
    return false;
  });
  ASSERT_GT(views.size(), 3U);
  const IntrinsicsCalibration c = calibrateIntrinsics(views, 640, 480, false);
  EXPECT_EQ(c.uncovered, (std::vector<std::string>{"top right", "middle right", "bottom right"}));
  EXPECT_NE(c.verdict, IntrinsicsVerdict::kGood);
}

/// Draws a plane's texture (`pixels_per_m`) as the camera sees it, nine samples a pixel.
std::vector<std::uint8_t> draw(const cv::Mat& texture, double pixels_per_m,
                               const RigidTransform& camera_from_board, const CameraModel& camera) {
  std::vector<std::uint8_t> image;
  const RigidTransform board_from_camera = camera_from_board.inverse();
  for (int y = 0; y < camera.height(); ++y)
    for (int x = 0; x < camera.width(); ++x) {
      int sum = 0;
      for (int k = 0; k < 9; ++k) {
        const Eigen::Vector2d at(x + (k % 3 - 1) / 3.0, y + (k / 3 - 1) / 3.0);
        const Eigen::Vector3d ray = board_from_camera.rotation * camera.bearing(at).homogeneous();
        const Eigen::Vector3d hit =
            board_from_camera.translation - ray * (board_from_camera.translation.z() / ray.z());
        const int column = static_cast<int>(std::floor(hit.x() * pixels_per_m));
        const int row = static_cast<int>(std::floor(hit.y() * pixels_per_m));
        const bool inside = column >= 0 && row >= 0 && column < texture.cols && row < texture.rows;
        sum += inside ? texture.at<std::uint8_t>(row, column) : 255;
      }
      image.push_back(static_cast<std::uint8_t>(sum / 9));
    }
  return image;
}

void expectCornersNear(const BoardView& found, const Eigen::Vector3d& first_corner,
                       const RigidTransform& pose) {
  double squares = 0.0;
  for (std::size_t i = 0; i < found.pixels.size(); ++i)
    squares += (found.pixels[i] - *kTruth.project(pose * (found.on_board[i] + first_corner))).squaredNorm();
  EXPECT_LT(std::sqrt(squares / static_cast<double>(found.pixels.size())), 0.15);
}

TEST(BoardFinding, ChessboardToAFractionOfAPixel) {
  const Board board{7, 5, 0.03, {}, 0.0};
  cv::Mat texture(6 * 60, 8 * 60, CV_8UC1);
  for (int y = 0; y < texture.rows; ++y)
    for (int x = 0; x < texture.cols; ++x)
      texture.at<std::uint8_t>(y, x) = (x / 60 + y / 60) % 2 == 0 ? 20 : 230;
  const RigidTransform pose{expSO3({0.3, -0.4, 0.1}), {-0.12, -0.08, 0.45}};
  const auto image = draw(texture, 2000.0, pose, kTruth);
  const BoardView found = findBoard({image.data(), 640, 480, 640}, board, "drawn");
  ASSERT_EQ(found.pixels.size(), 35U);
  // Which corner is the first one is a matter of convention: it may be the last.
  const bool turned =
      (found.pixels[0] - *kTruth.project(pose * Eigen::Vector3d(0.03, 0.03, 0.0))).norm() > 5.0;
  BoardView same = found;
  if (turned) std::reverse(same.pixels.begin(), same.pixels.end());
  expectCornersNear(same, {0.03, 0.03, 0.0}, pose);
}

TEST(BoardFinding, CharucoBlackOnWhiteAndWhiteOnBlack) {
  const Board board{5, 4, 0.03, "DICT_4X4_50", 0.0225};
  const auto charuco = cv::aruco::CharucoBoard::create(
      5, 4, 0.03F, 0.0225F, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
  cv::Mat texture;
  charuco->draw(cv::Size(5 * 80, 4 * 80), texture);
  const RigidTransform pose{expSO3({0.2, -0.3, 0.1}), {-0.08, -0.06, 0.35}};
  auto image = draw(texture, 80.0 / 0.03, pose, kTruth);
  const BoardView found = findBoard({image.data(), 640, 480, 640}, board, "drawn");
  EXPECT_EQ(found.pixels.size(), 12U);
  for (std::uint8_t& pixel : image) pixel = static_cast<std::uint8_t>(255 - pixel);
  EXPECT_EQ(findBoard({image.data(), 640, 480, 640}, board, "inverted").pixels.size(), 12U);
}

TEST(BoardFinding, NothingInAnEmptyImage) {
  const std::vector<std::uint8_t> gray(640 * 480, 128);
  EXPECT_TRUE(findBoard({gray.data(), 640, 480, 640}, {9, 6, 0.025, {}, 0.0}, "empty").pixels.empty());
  EXPECT_TRUE(
      findBoard({gray.data(), 640, 480, 640}, {5, 4, 0.03, "DICT_4X4_50", 0.02}, "empty").pixels.empty());
}

TEST(BoardFinding, BoardsThatCannotBeAreRefused) {
  EXPECT_THROW(validate(Board{1, 6, 0.025, {}, 0.0}), Error);
  EXPECT_THROW(validate(Board{9, 6, 0.0, {}, 0.0}), Error);
  EXPECT_THROW(validate(Board{9, 6, 0.025, "DICT_9X9", 0.01}), Error);
  EXPECT_THROW(validate(Board{9, 6, 0.025, "DICT_4X4_50", 0.03}), Error);
}

}  // namespace
}  // namespace helical
