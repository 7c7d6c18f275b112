#include "engine/pipeline/engine.h"

#include <algorithm>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/config/calibration_file.h"
#include "engine/markers/marker_colours.h"
#include "engine/pipeline/calibration_record.h"
#include "engine/pipeline/engine_implementation.h"

namespace helical {
namespace {

constexpr double kFieldClear = 1.0;  // s, for a background of simulated cameras

}  // namespace

void Engine::Implementation::tamper(std::size_t camera) {
  TamperingChannel& channel = *hardware.tampering[static_cast<std::size_t>(streams[camera].index())];
  channel.back() = tampering[camera];
  channel.publish();
}

/// What the operator ordered of a camera goes with it when its frames come by another cable.
void Engine::Implementation::followCables() {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraId stream = newest.front().streams[i];
    if (stream == streams[i]) continue;
    streams[i] = stream;
    tamper(i);
    hardware.orders[static_cast<std::size_t>(stream.index())]->ignore(ignored[i]);
  }
}

void Engine::Implementation::replaceCalibration(std::size_t index, const std::string& method) {
  // Another seed each time: a restart should not repeat the luck of the last one.
  const std::uint64_t seed = rig.simulation.seed + index + kMaxCameras * ++calibrations_made;
  auto calibration = newCalibration(rig, cameraId(static_cast<int>(index)), method, seed);
  new_calibrations[index].offer(std::make_unique<NewCalibration>(std::move(calibration), seed));
}

Engine::Engine(const RigConfig& rig, const FlightPlan& plan, FlightTap* tap)
    : implementation_(std::make_unique<Implementation>(rig, plan, tap)) {}

Engine::~Engine() {
  stop();
}

const RigConfig& Engine::rig() const {
  return implementation_->rig;
}
const FlightPlan& Engine::plan() const {
  return implementation_->plan;
}
const ControllerOptions& Engine::control() const {
  return implementation_->control;
}
bool Engine::running() const {
  return !implementation_->threads.empty();
}

void Engine::start() {
  Implementation& i = *implementation_;
  HELICAL_CHECK(!i.ever_started);
  i.ever_started = true;
  // Opening devices and drawing the simulated rooms took time that is not part of the flight.
  i.clock->restart();
  i.threads.emplace_back([&i](const std::stop_token& stop) { i.send(stop); });
  i.threads.emplace_back([&i](const std::stop_token& stop) { i.fly(stop); });
  for (std::size_t c = 0; c < i.hardware.sources.size(); ++c)
    i.threads.emplace_back([&i, c](const std::stop_token& stop) { i.capture(c, stop); });
}

void Engine::stop() {
  for (auto& thread : implementation_->threads) thread.request_stop();
  implementation_->threads.clear();
}

void Engine::arm() {
  implementation_->arm = true;
}
void Engine::disarm() {
  implementation_->disarm = true;
}
void Engine::hold() {
  implementation_->hold = true;
}
void Engine::takeOff() {
  implementation_->take_off = true;
}
void Engine::land() {
  implementation_->land = true;
}
void Engine::kill() {
  implementation_->output.kill();
}

void Engine::hideCamera(CameraId camera, bool hidden) {
  implementation_->hidden[static_cast<std::size_t>(camera.index())] = hidden;
}

void Engine::knockCamera(CameraId camera, double angle, double distance) {
  Implementation& i = *implementation_;
  if (!i.hardware.world) return;
  i.hardware.world->knock(camera, angle, distance);
  ++i.knocks[static_cast<std::size_t>(camera.index())];
}

void Engine::gust(const Eigen::Vector3d& wind_in_world, double duration_s) {
  Implementation& i = *implementation_;
  if (!i.hardware.world) return;
  i.hardware.world->gust(wind_in_world, duration_s);
  i.gust_until = i.clock->now() + fromSeconds(duration_s);
}

void Engine::setBoards(CameraId camera, const WhiteBoards& boards) {
  const auto index = static_cast<std::size_t>(camera.index());
  implementation_->tampering[index].boards = boards;
  implementation_->boards[index] = boards.count;
  implementation_->tamper(index);
}

void Engine::loseFrames(CameraId camera, double share) {
  const auto index = static_cast<std::size_t>(camera.index());
  implementation_->tampering[index].lost_share = share;
  implementation_->lost_share[index] = share;
  implementation_->tamper(index);
}

void Engine::addNoise(CameraId camera, double grey_levels, double px) {
  const auto index = static_cast<std::size_t>(camera.index());
  implementation_->tampering[index].noise_grey = grey_levels;
  implementation_->tampering[index].noise_px = px;
  implementation_->noise[index] = implementation_->rig.simulation.images ? grey_levels : px;
  implementation_->tamper(index);
}

void Engine::setMarkerColour(const ColourRange& colour) {
  Implementation& i = *implementation_;
  MarkerOptions options = i.rig.marker_options;
  static_cast<ColourRange&>(options) = colour;
  validate(options);
  std::vector<ColourRange> colours = i.rig.marker_options.other_colours;
  colours.insert(colours.begin(), colour);
  // Builds the tables, so that no capture thread has to.
  const MarkerColours built(std::move(colours));
  for (const auto& orders : i.hardware.orders) orders->seek(built);
  i.colour = colour;
  ++i.colours;
}

const ColourRange& Engine::markerColour() const {
  return implementation_->colour;
}

void Engine::takeBackground() {
  Implementation& i = *implementation_;
  const FlightPhase phase = snapshot().phase;
  if (phase != FlightPhase::kIdle && phase != FlightPhase::kOff)
    throw Error(ErrorKind::kInput, "no new background while the rotors turn", {}, "land first");
  if (i.hardware.world && i.rig.simulation.images) i.hardware.world->clearField(kFieldClear);
  for (const auto& orders : i.hardware.orders) orders->takeBackground();
  ++i.backgrounds;
}

void Engine::change(const FlightChange& change) {
  Implementation& i = *implementation_;
  validate(change);
  // An earlier change that the flight thread has not taken yet becomes part of this one.
  i.plan = change.plan.value_or(i.plan);
  i.control = change.control.value_or(i.control);
  auto pending = std::make_unique<PendingChange>();
  FlightChange ordered = change;
  if (!i.changes.empty() && !i.new_change.taken()) {
    if (i.changes.back()->plan) ordered.plan = i.plan;
    if (i.changes.back()->control) ordered.control = i.control;
  }
  pending->change = std::make_shared<const FlightChange>(std::move(ordered));
  pending->plan = i.plan;
  i.changes.push_back(pending->change);
  i.new_change.offer(std::move(pending));
}

void Engine::setIgnoredAreas(CameraId camera, const IgnoredAreas& areas) {
  implementation_->ignored[static_cast<std::size_t>(camera.index())] = areas;
  implementation_->hardware.orders[implementation_->streamOf(camera)]->ignore(areas);
}

void Engine::setCalibrator(const std::string& method) {
  Implementation& i = *implementation_;
  const auto names = calibratorNames();
  if (std::find(names.begin(), names.end(), method) == names.end())
    throw Error(ErrorKind::kInput, "there is no calibrator " + method, {}, "take one of the list");
  for (std::size_t c = 0; c < i.rig.cameras.size(); ++c) i.replaceCalibration(c, method);
  i.calibrator = method;
}

std::vector<std::string> Engine::calibrators() {
  const auto names = calibratorNames();
  return {names.begin(), names.end()};
}

const std::string& Engine::calibrator() const {
  return implementation_->calibrator;
}

void Engine::restartCalibration(CameraId camera) {
  const auto index = static_cast<std::size_t>(camera.index());
  implementation_->replaceCalibration(index, implementation_->calibrator);
}

bool Engine::orderCalibration(const CalibrationOrder& order) {
  return implementation_->calibration_orders.push(order);
}

void Engine::saveCalibration(const std::filesystem::path& file, std::optional<CameraId> only) const {
  const RigConfig& rig = implementation_->rig;
  SavedCalibration saved = calibrationOf(rig, snapshot());
  if (only) saved = onlyOf(saved, rig.cameras[static_cast<std::size_t>(only->index())]);
  helical::saveCalibration(file, saved);
}

void Engine::adoptCalibration(const std::filesystem::path& file, std::optional<CameraId> only) {
  SavedCalibration saved = loadCalibration(file);
  if (only) saved = onlyOf(saved, implementation_->rig.cameras[static_cast<std::size_t>(only->index())]);
  const RigConfig& rig = implementation_->rig;
  const MarkerLayout& flown_with = snapshot().tick > 0 ? snapshot().markers : rig.markers_in_body;
  for (const CalibrationOrder& order : adoptOrders(saved, rig, flown_with))
    if (!orderCalibration(order))
      throw Error(ErrorKind::kSystem, "the engine is still busy with earlier orders", file.string(),
                  "try again");
}

bool Engine::poll() {
  for (auto& calibration : implementation_->new_calibrations) calibration.collect();
  implementation_->new_change.collect();
  if (!implementation_->newest.take()) return false;
  implementation_->followCables();
  return true;
}
const EngineSnapshot& Engine::snapshot() const {
  return implementation_->newest.front();
}

bool Engine::pollPicture(CameraId camera) {
  return implementation_->taps[implementation_->streamOf(camera)].pictures().take();
}

const CameraPicture& Engine::picture(CameraId camera) const {
  return implementation_->taps[implementation_->streamOf(camera)].pictures().front();
}

bool Engine::pollCalibration(CameraId camera) {
  return implementation_->calibration_views[static_cast<std::size_t>(camera.index())].take();
}

const CalibrationView& Engine::calibration(CameraId camera) const {
  return implementation_->calibration_views[static_cast<std::size_t>(camera.index())].front();
}

bool Engine::nextTick(EngineSnapshot& tick) {
  return implementation_->tick_queue->pop(tick);
}
bool Engine::nextEvent(EngineEvent& event) {
  return implementation_->events->pop(event);
}
std::uint64_t Engine::lostTicks() const {
  return implementation_->lost.load(std::memory_order_relaxed);
}

}  // namespace helical
