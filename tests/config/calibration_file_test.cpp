#include "engine/config/calibration_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "engine/base/error.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

SavedCalibration example() {
  SavedCalibration calibration;
  calibration.rig = "a \"rig\".toml";
  calibration.written = "2010-12-21T10:00:00Z";
  calibration.after_s = 19.25;
  for (const char* label : {"1", "left"}) {
    SavedCamera camera;
    camera.label = label;
    camera.method = "joint";
    camera.camera_from_world.rotation = Eigen::Quaterniond(0.1, 0.7, -0.3, 0.2).normalized();
    camera.camera_from_world.translation = {1.0 / 3.0, -2.0, 1e-17};
    const Matrix6d root = Matrix6d::Identity() + 0.1 * Matrix6d::Ones();
    camera.covariance = 1e-6 * root * root.transpose();
    camera.covariance = 0.5 * (camera.covariance + camera.covariance.transpose().eval());
    calibration.cameras.push_back(camera);
  }
  return calibration;
}

TEST(CalibrationFile, ComesBackToTheLastBit) {
  const SavedCalibration wrote = example();
  const SavedCalibration read = parseCalibration(toToml(wrote), "c.toml");
  EXPECT_EQ(read.rig, wrote.rig);
  EXPECT_EQ(read.written, wrote.written);
  EXPECT_EQ(read.after_s, wrote.after_s);
  ASSERT_EQ(read.cameras.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.cameras[i].label, wrote.cameras[i].label);
    EXPECT_EQ(read.cameras[i].method, "joint");
    EXPECT_EQ(read.cameras[i].camera_from_world.translation, wrote.cameras[i].camera_from_world.translation);
    EXPECT_LT((read.cameras[i].camera_from_world.rotation.coeffs() -
               wrote.cameras[i].camera_from_world.rotation.coeffs())
                  .norm(),
              1e-15);
    EXPECT_EQ(read.cameras[i].covariance, wrote.cameras[i].covariance);
    EXPECT_EQ(read.cameras[i].focal_scale, 1.0);
  }
  EXPECT_TRUE(read.markers_in_body.empty());
}

TEST(CalibrationFile, BallsAndFocalLengthsThatWereCorrectedComeBackToTheLastBit) {
  SavedCalibration wrote = example();
  wrote.markers_in_body = {{0.1, 1.0 / 3.0, 0.0}, {-0.2, 1e-17, 0.05}, {0.0, 0.0, -1.0}};
  wrote.cameras[1].focal_scale = 1.0 + 1.0 / 300.0;
  const SavedCalibration read = parseCalibration(toToml(wrote), "c.toml");
  EXPECT_EQ(read.markers_in_body, wrote.markers_in_body);
  EXPECT_EQ(read.cameras[0].focal_scale, 1.0);
  EXPECT_EQ(read.cameras[1].focal_scale, wrote.cameras[1].focal_scale);
  wrote.cameras[1].focal_scale = 3.0;
  EXPECT_THROW(parseCalibration(toToml(wrote), "c.toml"), Error);
}

TEST(CalibrationFile, MistakesAreFoundAtTheirLine) {
  const std::string good = toToml(example());
  const struct {
    const char *from, *to, *said;
  } mistakes[] = {
      {"format_version = 1", "format_version = 2", "another format"},
      {"method = ", "metod = ", "did you mean 'method'?"},
      {"id = \"left\"", "id = \"1\"", "two cameras have this id"},
      {"rotation_wxyz = [", "rotation_wxyz = [5, ", "5 entries, not 4"},
      {"translation_m", "translation", "unknown key 'translation'"},
      {"covariance = [", "covariance = [-", "no covariance"},
  };
  for (const auto& mistake : mistakes) {
    const Error error = errorOf([&] { parseCalibration(replaced(good, mistake.from, mistake.to), "bad.toml"); });
    EXPECT_EQ(error.where().find("bad.toml:"), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find(mistake.said), std::string::npos) << error.what();
  }
  EXPECT_THROW(parseCalibration("format_version = 1\n", "empty.toml"), Error) << "no camera";
}

TEST(CalibrationFile, IsWrittenWholeOrNotAtAll) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("helical_calibration_" + std::to_string(::getpid()) + ".toml");
  saveCalibration(file, example());
  EXPECT_EQ(loadCalibration(file).cameras.size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  std::filesystem::remove(file);
  EXPECT_THROW(saveCalibration(file.parent_path() / "no such folder" / "c.toml", example()), Error);
}

}  // namespace
}  // namespace helical
