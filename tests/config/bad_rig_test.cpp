// Every class of mistake in a rig file gives an Error with the file, the right line, what is wrong and a
// cure.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>

#include "engine/config/rig_file.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

/// A good rig with `from` replaced by `to`; the error must be at the line of `culprit` and speak of `said`.
struct Mistake {
  const char* name;
  const char* from;
  const char* to;
  const char* culprit;
  const char* said;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

class BadRig : public testing::TestWithParam<Mistake> {};

TEST_P(BadRig, IsRefusedWithLineAndCure) {
  const Mistake& mistake = GetParam();
  const std::string text = replaced(goodRig(), mistake.from, mistake.to);
  const Error error = errorOf([&] { parseRig(text, "bad.toml"); });
  EXPECT_EQ(error.kind(), ErrorKind::kInput);
  EXPECT_EQ(error.where(), "bad.toml:" + std::to_string(lineOf(text, mistake.culprit))) << error.what();
  EXPECT_NE(std::string(error.what()).find(mistake.said), std::string::npos) << error.what();
  EXPECT_FALSE(error.cure().empty());
}

constexpr Mistake kMistakes[] = {
    {"NoVersion", "format_version = 1", "", "", "'format_version' is missing"},
    {"NewerVersion", "format_version = 1", "format_version = 2", "format_version", "another format"},
    {"VersionOfWrongType", "format_version = 1", "format_version = \"1\"", "format_version",
     "not an integer"},
    {"CameraIsNoArray", "[[camera]]", "[camera]", "camera", "'camera' is a table"},
    {"UnknownKeyAtTop", "[markers]", "[markrs]", "markrs", "did you mean 'markers'?"},
    {"UnknownKeyInCamera", "size =", "lens = 4.2\nsize =", "lens", "unknown key 'lens' in [camera]"},
    {"MisspeltRequiredKey", "fx =", "fxx =", "fxx", "did you mean 'fx'?"},
    {"UnknownKeyInOptions", "hue_low", "hue_lo", "hue_lo", "did you mean 'hue_low'?"},
    {"UnknownKeyFarFromAny", "hue_low", "zzzzzzzz", "zzzzzzzz", "known here: hue_low, hue_high"},
    {"NoId", "id = \"left\"", "", "[[camera]]", "'id' is missing"},
    {"IdOfWrongType", "\"left\"", "1.5", "id", "'id' is a number"},
    {"IdEmpty", "\"left\"", "\"\"", "id", "'id'"},
    {"IdWithComma", "\"left\"", "\"a,b\"", "id", "'id'"},
    {"IdTooLong", "\"left\"", "\"abcdefghijklmnopq\"", "id", "'id'"},
    {"SourceUnknown", "size =", "source = \"camera\"\nsize =", "source", "unknown source"},
    {"SourceAravisWithoutAddress", "size =", "source = \"aravis:\"\nsize =", "source", "unknown source"},
    {"DeviceTrigger", "[camera.pose]", "[camera.device]\ntrigger = \"now\"\n[camera.pose]", "trigger", "unknown trigger"},
    {"DeviceStamp", "[camera.pose]", "[camera.device]\nstamped_at = \"now\"\n[camera.pose]", "stamped_at", "instant"},
    {"DeviceOffset", "[camera.pose]", "[camera.device]\noffset = [-1, 0]\n[camera.pose]", "offset", "no place"},
    {"DeviceRate", "[camera.pose]", "[camera.device]\nrate_hz = 0\n[camera.pose]", "rate_hz", "rate_hz is 0"},
    {"SourceWebcamWithoutNode", "size =", "source = \"webcam:\"\nsize =", "source", "unknown source"},
    {"SourceFileWithoutPath", "size =", "source = \"file:\"\nsize =", "source", "unknown source"},
    {"NoSize", "size = [640, 480]", "", "[[camera]]", "'size' is missing"},
    {"SizeOfThree", "[640, 480]", "[640, 480, 3]", "size", "3 entries"},
    {"SizeNegative", "[640, 480]", "[640, -480]", "size", "no image size"},
    {"SizeZero", "[640, 480]", "[0, 480]", "size", "no image size"},
    {"SizeFraction", "[640, 480]", "[640.5, 480]", "size", "no image size"},
    {"SizeHuge", "[640, 480]", "[1e300, 480]", "size", "no image size"},
    {"SizeOfTexts", "[640, 480]", "[\"640\", 480]", "size", "is a text"},
    {"AreaOfTwoCorners", "size =", "ignored_areas_px = [[[0, 0], [9, 9]]]\nsize =", "ignored_areas_px",
     "has 2 corners"},
    {"AreaWithoutItsBrackets", "size =", "ignored_areas_px = [[0, 0], [9, 0], [9, 9]]\nsize =",
     "ignored_areas_px", "not an array of 2 numbers"},
    {"AreaNan", "size =", "ignored_areas_px = [[[0, 0], [9, 0], [9, nan]]]\nsize =", "ignored_areas_px",
     "not finite"},
    {"NoIntrinsics", "[camera.intrinsics]", "[camera.intrinsic]", "[camera.intrinsic]",
     "did you mean 'intrinsics'?"},
    {"NoFocalLength", "fy = 560.1", "", "[camera.intrinsics]", "'fy' is missing in [camera.intrinsics]"},
    {"FocalLengthNegative", "fy = 560.1", "fy = -560.1", "fy", "'fy' is not positive"},
    {"FocalLengthZero", "fx = 567.6", "fx = 0", "fx", "'fx' is not positive"},
    {"FocalLengthIsText", "fx = 567.6", "fx = \"567.6\"", "fx", "'fx' is a text, not a number"},
    {"FocalLengthIsTrue", "fx = 567.6", "fx = true", "fx", "'fx' is true or false, not a number"},
    {"FocalLengthIsDate", "fx = 567.6", "fx = 2026-01-01", "fx", "'fx' is a date or time, not a number"},
    {"CentreNan", "cx = 319.5", "cx = nan", "cx", "'cx' is not finite"},
    {"CentreInfinite", "cy = 239", "cy = -inf", "cy", "'cy' is not finite"},
    {"DistortionOfFour", "-0.002, 0.003]", "-0.002]", "distortion", "4 entries, not 5"},
    {"DistortionNan", "0.003]", "nan]", "distortion", "not finite"},
    {"NoRotation", "rotation_wxyz = [0.5, 0.5, -0.5, 0.5]", "", "[camera.pose]",
     "'rotation_wxyz' is missing"},
    {"RotationNotUnit", "-0.5, 0.5]", "-0.5, 0.6]", "rotation_wxyz", "not of length 1"},
    {"RotationZero", "[0.5, 0.5, -0.5, 0.5]", "[0, 0, 0, 0]", "rotation_wxyz", "not of length 1"},
    {"RotationOverflows", "[0.5, 0.5,", "[1e300, 1e300,", "rotation_wxyz", "not of length 1"},
    {"NoTranslation", "translation_m = [0.1, -0.2, 3.0]", "", "[camera.pose]", "'translation_m' is missing"},
    {"TranslationIsText", "[0.1, -0.2, 3.0]", "\"here\"", "translation_m", "an array of 3 numbers"},
    {"InitialIsText", "[camera.pose]", "[camera.pose]\ninitial = \"yes\"", "initial", "not true or false"},
    {"OptionOfWrongType", "hue_low = 50", "hue_low = 50.5", "hue_low", "not an integer"},
    {"OptionTooLarge", "hue_low = 50", "hue_low = 99999999999", "hue_low", "out of range"},
    {"OptionRefusedByItsModule", "hue_low = 50", "hue_low = 500", "hue_low", "hue_low is 500"},
    {"SimulationRefused", "gust_factor = 0.5", "gust_factor = -1", "gust_factor", "gust_factor is -1"},
    {"NoiseRefused", "gust_factor = 0.5", "[simulation.noise]\ndropout = 1.5", "dropout", "dropout is 1.5"},
    {"TableIsValue", "[markers]\nhue_low = 50", "[simulation.x]", "simulation", "simulation"},
    {"TransmitterNotBuilt", "[markers]", "[transmitter]\nkind = \"usb\"\n[markers]", "kind", "not built yet"},
    {"ModelUnknown", "[markers]", "[helicopter]\nmodel = \"x\"\n[markers]", "model",
     "unknown helicopter model"},
    {"MarkersTooFew", "[markers]", "[helicopter]\nmarkers_m = [[0, 0, 0]]\n[markers]", "markers_m",
     "1 markers"},
    {"MarkersFlatArray", "[markers]", "[helicopter]\nmarkers_m = [0, 0, 0]\n[markers]", "markers_m",
     "3 numbers"},
    {"MarkersOnALine", "[markers]", "[helicopter]\nmarkers_m = [[0,0,0],[1,0,0],[2,0,0]]\n[markers]",
     "markers_m", "line"},
    {"RadiusNegative", "[markers]", "[helicopter]\nmarker_radius_m = -1\n[markers]", "marker_radius_m",
     "not positive"},
    {"MassZero", "[markers]", "[helicopter.parameters]\nmass_kg = 0\n[markers]", "mass_kg", "0.005 to 50"},
    {"TooHeavyToHover", "[markers]", "[helicopter.parameters]\nmass_kg = 5\n[markers]", "mass_kg",
     "cannot hover"},
    {"RotorKeyUnknown", "[markers]", "[helicopter.parameters.upper]\nlinkge = 1\n[markers]", "linkge",
     "linkage"},
    {"TiltLimitRefused", "[markers]", "[safety]\ntilt_limit_deg = 0\n[markers]", "tilt_limit_deg",
     "tilt_limit is 0"},
    {"CalibratorUnknown", "[markers]", "[calibration]\nmethod = \"x\"\n[markers]", "method",
     "no calibrator 'x'"},
    {"TooFewParticles", "[markers]", "[calibration]\nparticles = 3\n[markers]", "particles", "10 to 1e+06"},
    {"BallsTooUncertain", "[markers]", "[calibration]\nmarker_sigma_m = 0.1\n[markers]", "marker_sigma_m",
     "0 to 0.02"},
    {"FocalLengthsTooUncertain", "[markers]", "[calibration]\nfocal_sigma = -0.1\n[markers]", "focal_sigma",
     "0 to 0.1"},
    {"CalibrationKeyUnknown", "[markers]", "[calibration]\nkernl = 0.5\n[markers]", "kernl", "kernel"},
    {"TruthOfNoCamera", "[simulation]",
     "[[simulation.camera]]\nid = 9\nrotation_wxyz = [1, 0, 0, 0]\ntranslation_m = [0, 0, 1]\n[simulation]",
     "id = 9", "there is no camera '9'"},
    {"SecondTruth", "[simulation]",
     "[[simulation.camera]]\nid = 'left'\nrotation_wxyz = [1, 0, 0, 0]\ntranslation_m = [0, 0, "
     "1]\n[simulation]",
     "id = 'left'", "true pose in [camera.pose] already"},
    {"SyntaxError", "cy = 239", "cy = ", "cy", "cure"},
    {"KeyTwice", "cy = 239", "cy = 239\nfx = 3", "fx = 3", "cure"},
    {"ControlCharacter", "cy = 239", "cy = 239 \x01", "cy = 239", "cure"},
    {"InvalidUtf8", "\"left\"", "\"\xff\xfe\"", "id", "cure"},
};

INSTANTIATE_TEST_SUITE_P(Mistakes, BadRig, testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

std::string camera(const std::string& id, const std::string& source = "") {
  return "[[camera]]\nid = " + id + "\n" + (source.empty() ? "" : "source = \"" + source + "\"\n") +
         "size = [640, 480]\n[camera.intrinsics]\nfx = 500.0\nfy = 500.0\ncx = 319.5\ncy = 239.5\n";
}

TEST(BadRigFile, TwoCamerasOfOneIdAreNamedWithBothLines) {
  const std::string text = "format_version = 1\n" + camera("1") + camera("2") + camera("\"1\"");
  const Error error = errorOf([&] { parseRig(text, "bad.toml"); });
  EXPECT_EQ(error.where(), "bad.toml:" + std::to_string(lineOf(text, "id = \"1\"")));
  EXPECT_EQ(error.problem(),
            "two cameras have the id '1': lines 3 and " + std::to_string(lineOf(text, "id = \"1\"")));
  EXPECT_FALSE(error.cure().empty());
}

TEST(BadRigFile, HasNoCameraOrTooMany) {
  EXPECT_EQ(errorOf([] { parseRig("format_version = 1\n", "r"); }).problem(), "the rig has no camera");
  EXPECT_EQ(errorOf([] { parseRig("format_version = 1\n[[camra]]\n", "r"); }).cure(),
            "did you mean 'camera'?");
  std::string text = "format_version = 1\n";
  for (int i = 0; i < kMaxCameras; ++i) text += camera(std::to_string(i));
  EXPECT_EQ(parseRig(text, "r").cameras.size(), static_cast<std::size_t>(kMaxCameras));
  const Error error = errorOf([&] { parseRig(text + camera("99"), "r"); });
  EXPECT_EQ(error.problem(), "the rig has 17 cameras");
}

TEST(BadRigFile, ASimulatedCameraMustBeSomewhere) {
  const Error error = errorOf([] { parseRig("format_version = 1\n" + camera("1", "sim"), "r"); });
  EXPECT_EQ(error.problem(), "the simulated camera '1' has no true pose");
  EXPECT_NE(error.cure().find("[[simulation.camera]]"), std::string::npos);
}

TEST(BadRigFile, MissingFileFolderOrHugeFileIsSaidPlainly) {
  const auto folder = std::filesystem::temp_directory_path() / "helical_bad_rig_test";
  std::filesystem::create_directories(folder);
  const auto huge = folder / "huge.toml";
  std::ofstream(huge) << std::string(2 << 20, '#');
  const std::pair<std::filesystem::path, const char*> cases[] = {{folder / "missing.toml", "No such file"},
                                                                 {folder, "folder"},
                                                                 {huge, "larger than"},
                                                                 {"", "cannot read"}};
  for (const auto& [path, said] : cases) {
    const Error error = errorOf([&] { loadRig(path); });
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_EQ(error.where(), path.string());
    EXPECT_NE(error.problem().find(said), std::string::npos) << error.what();
    EXPECT_FALSE(error.cure().empty());
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace helical
