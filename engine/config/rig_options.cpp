#include "engine/config/rig_options.h"

#include <algorithm>
#include <string>

#include "engine/base/error.h"
#include "engine/calibration/self_calibration_limits.h"
#include "engine/config/option_fields.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kDegree = toRadians(1.0);

constexpr OptionField<HelicopterParameters> kHelicopterFields[] = {
    {"mass_kg", &HelicopterParameters::mass, 1.0, 0.005, 50.0},
    {"inertia_x_kg_m2", &HelicopterParameters::inertia_x, 1.0, 1e-7, 10.0},
    {"inertia_y_kg_m2", &HelicopterParameters::inertia_y, 1.0, 1e-7, 10.0},
    {"inertia_z_kg_m2", &HelicopterParameters::inertia_z, 1.0, 1e-7, 10.0},
    {"maximum_rotor_speed_rad_s", &HelicopterParameters::maximum_rotor_speed, 1.0, 1.0, 5000.0},
    {"bar_time_s", &HelicopterParameters::bar_time, 1.0, 0.01, 100.0},
    {"lower_tip_path_time_s", &HelicopterParameters::lower_tip_path_time, 1.0, 0.005, 10.0},
    {"swash_plate_range_deg", &HelicopterParameters::swash_plate_range, kDegree, 0.1, 45.0},
    {"swash_plate_rate_deg_s", &HelicopterParameters::swash_plate_rate, kDegree, 1.0, 1e5},
    {"drag_coefficient", &HelicopterParameters::drag_coefficient, 1.0, 0.0, 10.0},
    {"drag_area_x_m2", &HelicopterParameters::drag_area_x, 1.0, 0.0, 10.0},
    {"drag_area_y_m2", &HelicopterParameters::drag_area_y, 1.0, 0.0, 10.0},
    {"drag_area_z_m2", &HelicopterParameters::drag_area_z, 1.0, 0.0, 10.0},
    {"lateral_damping_n_s_m", &HelicopterParameters::lateral_damping, 1.0, 0.0, 10.0},
    {"vertical_damping_n_s_m", &HelicopterParameters::vertical_damping, 1.0, 0.0, 10.0},
    {"ground_effect", &HelicopterParameters::ground_effect, 1.0, 0.0, 3.0},
    {"rotor_radius_m", &HelicopterParameters::rotor_radius, 1.0, 0.02, 3.0},
    {"standing_height_m", &HelicopterParameters::standing_height, 1.0, 0.0, 1.0},
    {"thrust_offset_x_m", &HelicopterParameters::thrust_offset_x, 1.0, -0.1, 0.1},
    {"thrust_offset_y_m", &HelicopterParameters::thrust_offset_y, 1.0, -0.1, 0.1},
    {"swash_plate_offset_roll", &HelicopterParameters::swash_plate_offset_roll, 1.0, -1.0, 1.0},
    {"swash_plate_offset_pitch", &HelicopterParameters::swash_plate_offset_pitch, 1.0, -1.0, 1.0},
};

constexpr OptionField<RotorParameters> kRotorFields[] = {
    {"thrust_coefficient_n_s2", &RotorParameters::thrust_coefficient, 1.0, 1e-9, 1.0},
    {"drag_coefficient_n_m_s2", &RotorParameters::drag_coefficient, 1.0, 1e-11, 1.0},
    {"height_m", &RotorParameters::height, 1.0, 0.0, 2.0},
    {"hinge_stiffness_n_m_rad", &RotorParameters::hinge_stiffness, 1.0, 0.0, 1000.0},
    {"linkage", &RotorParameters::linkage, 1.0, 0.0, 5.0},
    {"motor_time_s", &RotorParameters::motor_time, 1.0, 0.005, 10.0},
    {"motor_gain_rad_s", &RotorParameters::motor_gain, 1.0, 1.0, 10000.0},
    {"motor_offset_rad_s", &RotorParameters::motor_offset, 1.0, -1000.0, 1000.0},
    {"phase_slope_s", &RotorParameters::phase_slope, 1.0, -1.0, 1.0},
    {"phase_offset_deg", &RotorParameters::phase_offset, kDegree, -180.0, 180.0},
};

constexpr OptionField<ColourRange> kColourFields[] = {
    {"hue_low", &ColourRange::hue_low},
    {"hue_high", &ColourRange::hue_high},
    {"saturation_low", &ColourRange::saturation_low},
    {"saturation_high", &ColourRange::saturation_high},
    {"value_low", &ColourRange::value_low},
    {"value_high", &ColourRange::value_high},
};

constexpr OptionField<MarkerOptions> kMarkerFields[] = {
    {"hue_low", &MarkerOptions::hue_low},
    {"hue_high", &MarkerOptions::hue_high},
    {"saturation_low", &MarkerOptions::saturation_low},
    {"saturation_high", &MarkerOptions::saturation_high},
    {"value_low", &MarkerOptions::value_low},
    {"value_high", &MarkerOptions::value_high},
    {"background_threshold", &MarkerOptions::background_threshold},
    {"background_frames", &MarkerOptions::background_frames},
    {"background_rows", &MarkerOptions::background_rows},
    {"whole_every", &MarkerOptions::whole_every},
    {"opening_px", &MarkerOptions::opening_px},
    {"closing_px", &MarkerOptions::closing_px},
    {"minimum_area_px", &MarkerOptions::minimum_area_px},
    {"maximum_area_px", &MarkerOptions::maximum_area_px},
    {"centroid_sigma_px", &MarkerOptions::centroid_sigma_px},
};

constexpr OptionField<TrackerOptions> kTrackerFields[] = {
    {"acceleration_noise_lateral", &TrackerOptions::acceleration_noise_lateral},
    {"acceleration_noise_vertical", &TrackerOptions::acceleration_noise_vertical},
    {"spin_noise_tilt", &TrackerOptions::spin_noise_tilt},
    {"spin_noise_yaw", &TrackerOptions::spin_noise_yaw},
    {"spin_decay_s", &TrackerOptions::spin_decay_s},
    {"centroid_bias_px", &TrackerOptions::centroid_bias_px},
    {"gate_chi2", &TrackerOptions::gate_chi2},
    {"reacquire_after_s", &TrackerOptions::reacquire_after_s},
};

constexpr OptionField<ControllerOptions> kControllerFields[] = {
    {"rate_hz", &ControllerOptions::rate_hz},
    {"position_p", &ControllerOptions::position_p},
    {"position_d", &ControllerOptions::position_d},
    {"position_i", &ControllerOptions::position_i},
    {"position_i_limit", &ControllerOptions::position_i_limit},
    {"position_error_limit_m", &ControllerOptions::position_error_limit},
    {"tilt", &ControllerOptions::tilt},
    {"phase_deg", &ControllerOptions::phase, kDegree},
    {"height_p", &ControllerOptions::height_p},
    {"height_d", &ControllerOptions::height_d},
    {"height_i", &ControllerOptions::height_i},
    {"yaw_p", &ControllerOptions::yaw_p},
    {"yaw_rate_limit_deg_s", &ControllerOptions::yaw_rate_limit, kDegree},
    {"yaw_d", &ControllerOptions::yaw_d},
    {"yaw_i", &ControllerOptions::yaw_i},
    {"ground_yaw_d", &ControllerOptions::ground_yaw_d},
    {"ground_yaw_i", &ControllerOptions::ground_yaw_i},
    {"output_delay_s", &ControllerOptions::output_delay_s},
    {"trim_upper", &ControllerOptions::trim_upper},
    {"trim_lower", &ControllerOptions::trim_lower},
    {"trim_roll", &ControllerOptions::trim_roll},
    {"trim_pitch", &ControllerOptions::trim_pitch},
};

constexpr OptionField<SupervisorOptions> kSupervisorFields[] = {
    {"coast_after_s", &SupervisorOptions::coast_after_s},
    {"descend_after_s", &SupervisorOptions::descend_after_s},
    {"descent_speed_m_s", &SupervisorOptions::descent_speed},
    {"longest_descent_s", &SupervisorOptions::longest_descent_s},
    {"tilt_limit_deg", &SupervisorOptions::tilt_limit, kDegree},
    {"tilt_time_s", &SupervisorOptions::tilt_time_s},
    {"fence_radius_m", &SupervisorOptions::fence_radius},
    {"fence_height_m", &SupervisorOptions::fence_height},
    {"hard_fence_margin_m", &SupervisorOptions::hard_fence_margin},
    {"flight_time_limit_s", &SupervisorOptions::flight_time_limit_s},
    {"neutral_after_s", &SupervisorOptions::neutral_after_s},
    {"speed_limit_m_s", &SupervisorOptions::speed_limit},
    {"speed_time_s", &SupervisorOptions::speed_time_s},
    {"fence_x_m", &SupervisorOptions::fence_half_x},
    {"fence_y_m", &SupervisorOptions::fence_half_y},
    {"fence_warning_margin_m", &SupervisorOptions::fence_warning_margin},
    {"residual_limit", &SupervisorOptions::residual_limit},
    {"position_sigma_limit_m", &SupervisorOptions::position_sigma_limit},
    {"rotation_sigma_limit_deg", &SupervisorOptions::rotation_sigma_limit, kDegree},
    {"uncertain_after_s", &SupervisorOptions::uncertain_after_s},
    {"uncertain_land_s", &SupervisorOptions::uncertain_land_s},
    {"camera_silent_s", &SupervisorOptions::camera_silent_s},
    {"camera_clock_s", &SupervisorOptions::camera_clock_s},
    {"overrun_s", &SupervisorOptions::overrun_s},
    {"transmitter_fault_s", &SupervisorOptions::transmitter_fault_s},
    {"transmitter_cut_s", &SupervisorOptions::transmitter_cut_s},
    {"record_stalled_s", &SupervisorOptions::record_stalled_s},
    {"arm_cameras", &SupervisorOptions::arm_cameras},
    {"arm_rate_share", &SupervisorOptions::arm_rate_share},
    {"arm_speed_m_s", &SupervisorOptions::arm_speed},
    {"arm_disk_gb", &SupervisorOptions::arm_disk_gb},
    {"disarm_idle_s", &SupervisorOptions::disarm_idle_s},
    {"disarm_after_cut_s", &SupervisorOptions::disarm_after_cut_s},
};

constexpr OptionField<SimulationOptions> kSimulationFields[] = {
    {"gust_factor", &SimulationOptions::gust_factor},
    {"vary", &SimulationOptions::vary},
    {"camera_rate_hz", &SimulationOptions::camera_rate_hz},
    {"rate_error", &SimulationOptions::rate_error},
    {"readout_delay_s", &SimulationOptions::readout_delay_s},
    {"field_empty_s", &SimulationOptions::field_empty_s},
    {"image_noise", &SimulationOptions::image_noise},
    {"light_drift", &SimulationOptions::light_drift},
    {"marker_error_m", &SimulationOptions::marker_error_m},
    {"focal_error", &SimulationOptions::focal_error},
};

constexpr OptionField<GuessSpread> kGuessFields[] = {
    {"guess_rotation_deg", &GuessSpread::rotation_rad, kDegree, 0.1, 180.0},
    {"guess_position_m", &GuessSpread::position_m, 1.0, 0.001, 100.0},
};

constexpr OptionField<GrowingGaussNewtonOptions> kGrowingFields[] = {
    {"kept_frames", &GrowingGaussNewtonOptions::kept_frames, 1.0, 16, 10000},
    {"robust_sigmas", &GrowingGaussNewtonOptions::robust_sigmas, 1.0, 0.0, 1000.0},
};

constexpr OptionField<ParticleFilterOptions> kParticleFields[] = {
    {"particles", &ParticleFilterOptions::particles, 1.0, 10, 1'000'000},
    {"likelihood_floor", &ParticleFilterOptions::floor, 1.0, 1e-12, 1.0},
    {"kernel", &ParticleFilterOptions::kernel, 1.0, 0.0, 0.999},
};

constexpr OptionField<SelfCalibrationOptions> kSelfCalibrationFields[] = {
    {"marker_sigma_m", &SelfCalibrationOptions::marker_sigma_m, 1.0, 0.0, kMostMarkerSigmaM},
    {"focal_sigma", &SelfCalibrationOptions::focal_sigma, 1.0, 0.0, kMostFocalSigma},
};

constexpr OptionField<ObservationNoise> kNoiseFields[] = {
    {"sigma_px", &ObservationNoise::sigma_px},           {"bias_px", &ObservationNoise::bias_px},
    {"bias_time_s", &ObservationNoise::bias_time_s},     {"dropout", &ObservationNoise::dropout},
    {"false_markers", &ObservationNoise::false_markers}, {"outliers", &ObservationNoise::outliers},
    {"lost_markers", &ObservationNoise::lost_markers},
};

template <class Options, std::size_t N>
void readWholeTable(TomlTable& table, const OptionField<Options> (&fields)[N], Options& options) {
  readOptions(table, fields, options);
  table.finish();
}

template <class Options, std::size_t N>
void readAndValidate(TomlTable& table, const OptionField<Options> (&fields)[N], Options& options) {
  readWholeTable(table, fields, options);
  table.locate([&] { validate(options); });
}

HelicopterParameters nominalParameters(TomlTable& table) {
  const std::string model = table.text("model").value_or("xrb");
  if (model == "xrb") return HelicopterParameters::xrb();
  if (model == "coax") return HelicopterParameters::coax();
  table.fail("model", "unknown helicopter model '" + model + "'", "use \"xrb\" or \"coax\"");
}

void readParameters(TomlTable table, HelicopterParameters& parameters) {
  readOptions(table, kHelicopterFields, parameters);
  TomlTable upper = table.table("upper"), lower = table.table("lower");
  readWholeTable(upper, kRotorFields, parameters.upper);
  readWholeTable(lower, kRotorFields, parameters.lower);
  table.finish();
  for (const double stick : {parameters.hoverStickUpper(), parameters.hoverStickLower()})
    if (!(stick > 0.0 && stick < 1.0))
      table.fail(
          "mass_kg",
          "this helicopter cannot hover: it would need rotor sticks of " +
              std::to_string(parameters.hoverStickUpper()) + " and " +
              std::to_string(parameters.hoverStickLower()),
          "check mass and the rotors' thrust coefficients and motor gains; sticks must lie between 0 and 1");
}

}  // namespace

void readHelicopter(TomlTable table, RigConfig& rig) {
  rig.helicopter = nominalParameters(table);
  const auto markers = table.points("markers_m");
  const auto radius = table.number("marker_radius_m");
  TomlTable parameters = table.table("parameters");
  table.finish();
  readParameters(std::move(parameters), rig.helicopter);
  if (!markers && !radius) return;
  const MarkerLayout usual = MarkerLayout::paper();
  const std::string culprit = markers ? "markers_m" : "marker_radius_m";
  try {
    rig.markers_in_body = markers ? MarkerLayout(*markers, radius.value_or(usual.radius()))
                                  : MarkerLayout(usual.all(), *radius);
  } catch (const Error& error) {
    table.fail(culprit, error.problem(), error.cure());
  }
}

void readMarkerOptions(TomlTable table, MarkerOptions& options) {
  readOptions(table, kMarkerFields, options);
  const std::string estimator = table.text("estimator").value_or("disc");
  if (estimator != "disc" && estimator != "binary")
    table.fail("estimator", "unknown estimator '" + estimator + "'", "use \"disc\" or \"binary\"");
  options.estimator = estimator == "disc" ? CentroidEstimator::kDisc : CentroidEstimator::kBinary;
  for (TomlTable& colour : table.tables("colour"))
    readWholeTable(colour, kColourFields, options.other_colours.emplace_back());
  table.finish();
  table.locate([&] { validate(options); });
}

void readTrackerOptions(TomlTable table, TrackerOptions& options) {
  readAndValidate(table, kTrackerFields, options);
}

void readControllerOptions(TomlTable table, ControllerOptions& options) {
  readAndValidate(table, kControllerFields, options);
}

void readSupervisorOptions(TomlTable table, SupervisorOptions& options) {
  const std::string fence = table.text("fence").value_or("cylinder");
  if (fence != "cylinder" && fence != "box")
    table.fail("fence", "unknown fence '" + fence + "'", "use \"cylinder\" or \"box\"");
  options.fence = fence == "box" ? FenceShape::kBox : FenceShape::kCylinder;
  readAndValidate(table, kSupervisorFields, options);
}

void readSimulationOptions(TomlTable& table, SimulationOptions& options) {
  TomlTable noise = table.table("noise");
  readAndValidate(table, kSimulationFields, options);
  readWholeTable(noise, kNoiseFields, options.noise);
  noise.locate([&] { validate(options); });
}

void readCalibration(TomlTable table, RigConfig& rig) {
  if (const auto method = table.text("method")) {
    const auto names = calibratorNames();
    if (std::find(names.begin(), names.end(), *method) == names.end()) {
      std::string known;
      for (const auto name : names) known += (known.empty() ? "" : ", ") + std::string(name);
      table.fail("method", "there is no calibrator '" + *method + "'", "give one of " + known);
    }
    rig.calibrator = *method;
  }
  readOptions(table, kGuessFields, rig.calibration.guess);
  readOptions(table, kGrowingFields, rig.calibration.growing_gauss_newton);
  readOptions(table, kParticleFields, rig.calibration.particle_filter);
  readOptions(table, kSelfCalibrationFields, rig.self_calibration);
  table.finish();
}

}  // namespace helical
