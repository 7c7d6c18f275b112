#include "engine/pipeline/engine.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <semaphore>
#include <thread>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/base/spsc_queue.h"
#include "engine/base/thread_priority.h"
#include "engine/cameras/demosaic.h"
#include "engine/config/calibration_file.h"
#include "engine/markers/marker_colours.h"
#include "engine/pipeline/announcer.h"
#include "engine/pipeline/calibration_record.h"
#include "engine/pipeline/calibration_view.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/flight_tap.h"
#include "engine/pipeline/hand_over.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {
namespace {

constexpr TimeNs kOutputPeriod = 5 * kNanosecondsPerMillisecond;
constexpr TimeNs kPicturePeriod = 33 * kNanosecondsPerMillisecond;
constexpr TimeNs kLongestWait = 20 * kNanosecondsPerMillisecond;
constexpr int kBackgroundPictures = 30;
constexpr double kFieldClear = 1.0;  // s, for a background of simulated cameras

constexpr double kUrgentFrames = 400.0;

/// Drawn by this machine, all cameras together.
double drawnPerSecond(const RigConfig& rig) {
  return rig.simulation.camera_rate_hz *
         static_cast<double>(std::count_if(rig.cameras.begin(), rig.cameras.end(),
                                           [](const CameraConfig& camera) { return camera.source == "sim"; }));
}

using ObservationQueue = SpscQueue<Observation, 16>;

std::size_t cameraOf(const Observation& observation) {
  return static_cast<std::size_t>(observation.camera.index());
}

/// On its way to the flight thread.
struct NewCalibration {
  NewCalibration(std::unique_ptr<CameraCalibration> made, std::uint64_t drawn)
      : calibration(std::move(made)), seed(drawn) {}
  std::unique_ptr<CameraCalibration> calibration;
  std::uint64_t seed;
};

/// On its way to the flight thread, with a copy of the plan that is swapped for the old one.
struct PendingChange {
  std::shared_ptr<const FlightChange> change;
  FlightPlan plan;
};

/// A copy of a capture thread's frames at display rate.
class PictureTap {
 public:
  void take(const Frame& frame, const Observation& observation, const Extractor& extractor) {
    keepBackground(extractor);
    if (last_ >= 0 && frame.arrival - last_ < kPicturePeriod) return;
    last_ = frame.arrival;
    CameraPicture& picture = pictures_.back();
    picture.sequence = frame.sequence;
    picture.exposure = frame.exposure;
    picture.width = frame.image.width;
    picture.height = frame.image.height;
    picture.observation = observation;
    picture.background = background_;
    toBgr(frame.image, picture.bgr);
    pictures_.publish();
  }
  LatestValue<CameraPicture>& pictures() { return pictures_; }

 private:
  /// A copy that pictures share, made anew now and then: it follows the light.
  void keepBackground(const Extractor& extractor) {
    if (!extractor.hasBackground()) {
      background_.reset();
      return;
    }
    if (background_ && ++background_age_ < kBackgroundPictures) return;
    background_age_ = 0;
    auto copy = std::make_shared<std::vector<std::uint8_t>>();
    toBgr(extractor.background(), *copy);
    background_ = std::move(copy);
  }
  LatestValue<CameraPicture> pictures_;
  std::shared_ptr<const std::vector<std::uint8_t>> background_;
  int background_age_ = 0;  ///< pictures
  TimeNs last_ = -1;
};

}  // namespace

struct Engine::Implementation {
  Implementation(const RigConfig& rig_config, const FlightPlan& flight_plan, FlightTap* flight_tap)
      : rig(rig_config),
        plan(flight_plan),
        clock(std::make_shared<MonotonicClock>()),
        hardware(openRig(
            rig, clock,
            [this](const Frame& frame, const Observation& observation, const Extractor& extractor) {
              taps[static_cast<std::size_t>(frame.camera.index())].take(frame, observation, extractor);
              if (tap != nullptr) tap->onFrame(frame, observation);
            },
            plan.carried_s)),
        loop(rig, plan),
        output(*hardware.transmitter),
        calibrator(rig.calibrator),
        control(rig.control),
        colour(rig.marker_options),
        tap(flight_tap),
        announcer(rig) {
    for (std::size_t i = 0; i < hardware.sources.size(); ++i)
      queues.push_back(std::make_unique<ObservationQueue>());
  }

  void capture(std::size_t index, const std::stop_token& stop);
  void fly(const std::stop_token& stop);
  void send(const std::stop_token& stop);
  void receive();
  void hide(std::size_t camera, bool hide_it);
  void tick(TimeNs now);
  void takeCalibrations(TimeNs now);
  void obeyCalibrationOrders(TimeNs now);
  void takeChange(TimeNs now);
  void showCalibrations(std::uint64_t tick, TimeNs now);
  void addOrders(EngineSnapshot& snapshot) const;
  void measureRate(EngineSnapshot& snapshot);
  void tamper(std::size_t camera);
  void replaceCalibration(std::size_t camera, const std::string& method);
  void raise(const EngineEvent& event) {
    lost += !events->push(event);
    if (tap != nullptr) tap->onEvent(event);
  }

  const RigConfig rig;
  FlightPlan plan;  ///< reading thread, after the start
  std::shared_ptr<MonotonicClock> clock;
  std::array<PictureTap, kMaxCameras> taps;
  RigHardware hardware;
  FlightLoop loop;
  OutputLoop output;

  std::vector<std::unique_ptr<ObservationQueue>> queues;
  /// Heads of the queues, taken out to be compared; flight thread.
  std::array<Observation, kMaxCameras> heads{};
  std::array<bool, kMaxCameras> has_head{};
  std::counting_semaphore<> arrived{0};

  std::atomic<bool> arm{false};
  std::atomic<bool> disarm{false};
  std::atomic<bool> take_off{false};
  std::atomic<bool> hold{false};
  std::atomic<bool> land{false};
  std::array<std::atomic<bool>, kMaxCameras> hidden{};
  std::array<std::atomic<int>, kMaxCameras> boards{};  ///< how many; the capture threads have the boards
  std::array<std::atomic<double>, kMaxCameras> lost_share{};
  std::array<std::atomic<double>, kMaxCameras> noise{};
  std::atomic<std::uint32_t> colours{0};
  std::atomic<std::uint32_t> backgrounds{0};
  std::array<std::atomic<std::uint32_t>, kMaxCameras> knocks{};
  std::atomic<TimeNs> gust_until{-1};
  std::array<HandOver<NewCalibration>, kMaxCameras> new_calibrations;
  std::array<LatestValue<CalibrationView>, kMaxCameras> calibration_views;
  SpscQueue<CalibrationOrder, 128> calibration_orders;
  std::string calibrator;               ///< reading thread
  std::uint64_t calibrations_made = 0;  ///< reading thread
  HandOver<PendingChange> new_change;
  // Reading thread.
  ControllerOptions control;
  ColourRange colour;
  std::array<Tampering, kMaxCameras> tampering{};
  std::vector<std::shared_ptr<const FlightChange>> changes;  ///< all: nobody else frees one

  LatestValue<EngineSnapshot> newest;
  std::unique_ptr<SpscQueue<EngineSnapshot, 256>> tick_queue =
      std::make_unique<SpscQueue<EngineSnapshot, 256>>();
  std::unique_ptr<SpscQueue<EngineEvent, 256>> events = std::make_unique<SpscQueue<EngineEvent, 256>>();
  std::atomic<std::uint64_t> lost{0};

  FlightTap* const tap;
  Announcer announcer;
  std::array<bool, kMaxCameras> was_hidden{};  ///< flight thread
  TimeNs rate_since = 0;
  std::uint64_t ticks_then = 0;
  double ticks_per_second = 0.0;
  bool ever_started = false;

  std::vector<std::jthread> threads;
};

void Engine::Implementation::capture(std::size_t index, const std::stop_token& stop) {
  // Many simulated cameras are more work than there is time: in real time they would lock out the window.
  if (drawnPerSecond(rig) <= kUrgentFrames) raisePriority(Urgency::kCapture);
  ObservationSource& source = *hardware.sources[index];
  Observation observation;
  while (!stop.stop_requested()) {
    source.wait(clock->now() + kLongestWait);
    // A machine slower than the camera always finds a next frame: it must still be able to stop.
    while (!stop.stop_requested() && source.poll(observation)) {
      // A full queue drops it; the gap in the sequence counts it.
      queues[index]->push(observation);
      arrived.release();
    }
  }
}

void Engine::Implementation::hide(std::size_t camera, bool hide_it) {
  if (was_hidden[camera] == hide_it) return;
  was_hidden[camera] = hide_it;
  loop.hideCamera(cameraId(static_cast<int>(camera)), hide_it);
  if (tap != nullptr) tap->onHidden(cameraId(static_cast<int>(camera)), hide_it, clock->now());
}

void Engine::Implementation::receive() {
  for (std::size_t i = 0; i < queues.size(); ++i) hide(i, hidden[i].load(std::memory_order_relaxed));
  // In order of exposure over all cameras, also after a stall that let the queues fill.
  for (;;) {
    std::size_t oldest = queues.size();
    for (std::size_t i = 0; i < queues.size(); ++i) {
      if (!has_head[i]) has_head[i] = queues[i]->pop(heads[i]);
      if (has_head[i] && (oldest == queues.size() || heads[i].exposure < heads[oldest].exposure)) oldest = i;
    }
    if (oldest == queues.size()) return;
    const TimeNs now = clock->now();
    loop.onObservation(heads[oldest], now);
    if (tap != nullptr)
      tap->onObservation(heads[oldest], now, loop.snapshot().cameras[cameraOf(heads[oldest])].track);
    has_head[oldest] = false;
  }
}

void Engine::Implementation::tick(TimeNs now) {
  OperatorCommands commands;
  commands.arm = arm.exchange(false);
  commands.disarm = disarm.exchange(false);
  commands.take_off = take_off.exchange(false);
  commands.hold = hold.exchange(false);
  commands.land = land.exchange(false);
  commands.kill = output.stopped();
  takeCalibrations(now);
  takeChange(now);
  obeyCalibrationOrders(now);
  DeviceStatus devices;
  devices.transmitter = output.transmitterStatus();
  if (tap != nullptr) devices.record = tap->health();
  output.submit(loop.onTick(now, commands, devices), now);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    hardware.orders[i]->expect(loop.expectedBalls(cameraId(static_cast<int>(i))));

  EngineSnapshot& snapshot = newest.back();
  snapshot = loop.snapshot();
  hardware.addTruth(snapshot, now);
  hardware.addLinks(snapshot);
  addOrders(snapshot);
  measureRate(snapshot);
  showCalibrations(snapshot.tick, now);
  if (!tick_queue->push(snapshot)) lost.fetch_add(1, std::memory_order_relaxed);
  if (tap != nullptr) tap->onTick(commands, snapshot);
  announcer.announce(snapshot, output.gaveUp(), [this](const EngineEvent& event) { raise(event); });
  newest.publish();
}

void Engine::Implementation::takeCalibrations(TimeNs now) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    std::unique_ptr<NewCalibration> anew = new_calibrations[i].take();
    if (!anew) continue;
    const CameraId camera = cameraId(static_cast<int>(i));
    const char* method = anew->calibration->calibrator().name();
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "calibrates anew by %s", method);
    if (loop.calibration(camera) != nullptr) raise(announcer.event(now, Severity::kInfo, i, text.data()));
    loop.swapCalibration(camera, anew->calibration);
    if (tap != nullptr) tap->onCalibration(camera, method, anew->seed, now);
    new_calibrations[i].giveBack(std::move(anew));
  }
}

void Engine::Implementation::takeChange(TimeNs now) {
  std::unique_ptr<PendingChange> pending = new_change.take();
  if (!pending) return;
  if (pending->change->plan) loop.swapPlan(pending->plan);
  if (pending->change->control) loop.setControl(*pending->change->control);
  if (tap != nullptr) tap->onChange(pending->change, now);
  new_change.giveBack(std::move(pending));
}

void Engine::Implementation::obeyCalibrationOrders(TimeNs now) {
  CalibrationOrder order;
  while (calibration_orders.pop(order)) {
    const auto camera = static_cast<std::size_t>(order.camera.index());
    if (camera >= rig.cameras.size()) continue;
    const char* refusal = loop.orderCalibration(order);
    if (tap != nullptr) tap->onCalibrationOrder(order, now);
    raise(announcer.ordered(now, camera, order.kind, refusal));
  }
}

void Engine::Implementation::showCalibrations(std::uint64_t tick, TimeNs now) {
  if (tick % kCalibrationViewTicks != 0) return;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraCalibration* calibration = loop.calibration(cameraId(static_cast<int>(i)));
    if (calibration == nullptr) continue;
    fillView(*calibration, calibration_views[i].back());
    if (tap != nullptr) tap->onBelief(cameraId(static_cast<int>(i)), calibration_views[i].back(), now);
    calibration_views[i].publish();
  }
}

void Engine::Implementation::addOrders(EngineSnapshot& snapshot) const {
  snapshot.gust_ordered = snapshot.time < gust_until.load(std::memory_order_relaxed);
  snapshot.colours = colours.load(std::memory_order_relaxed);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    snapshot.cameras[i].boards = boards[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].knocks = knocks[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].lost_share = lost_share[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].noise = noise[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].backgrounds = backgrounds.load(std::memory_order_relaxed);
    const CameraCalibration* calibration = loop.calibration(cameraId(static_cast<int>(i)));
    if (calibration != nullptr)
      snapshot.cameras[i].effective_sample_size = calibration->calibrator().effectiveSampleSize();
  }
}

/// What the flight thread really does; the loop itself only knows what it should.
void Engine::Implementation::measureRate(EngineSnapshot& snapshot) {
  if (snapshot.time - rate_since >= kNanosecondsPerSecond) {
    ticks_per_second =
        static_cast<double>(snapshot.tick - ticks_then) / toSeconds(snapshot.time - rate_since);
    rate_since = snapshot.time;
    ticks_then = snapshot.tick;
  }
  if (ticks_per_second > 0.0) snapshot.ticks_per_second = ticks_per_second;
}

void Engine::Implementation::tamper(std::size_t camera) {
  TamperingChannel& channel = *hardware.tampering[camera];
  channel.back() = tampering[camera];
  channel.publish();
}

void Engine::Implementation::replaceCalibration(std::size_t index, const std::string& method) {
  const CameraConfig& camera = rig.cameras[index];
  // Another seed each time: a restart should not repeat the luck of the last one.
  const std::uint64_t seed = rig.simulation.seed + index + kMaxCameras * ++calibrations_made;
  auto calibration = std::make_unique<CameraCalibration>(method, camera.model, rig.markers_in_body,
                                                         camera.camera_from_world, seed, rig.calibration);
  new_calibrations[index].offer(std::make_unique<NewCalibration>(std::move(calibration), seed));
}

void Engine::Implementation::fly(const std::stop_token& stop) {
  raisePriority(Urgency::kControl);
  const TimeNs period = fromSeconds(1.0 / rig.control.rate_hz);
  TimeNs next = clock->now() + period;
  while (!stop.stop_requested()) {
    const TimeNs now = clock->now();
    if (now >= next) {
      receive();
      tick(clock->now());
      // After a stall the missed ticks are left out, not caught up with.
      next += period * std::max<TimeNs>(1, (now - next) / period + 1);
      continue;
    }
    if (arrived.try_acquire_for(std::chrono::nanoseconds(next - now))) receive();
  }
}

void Engine::Implementation::send(const std::stop_token& stop) {
  raisePriority(Urgency::kControl);
  while (!stop.stop_requested()) {
    output.step(clock->now());
    clock->sleepUntil(clock->now() + kOutputPeriod);
  }
  output.kill();
  output.step(clock->now());
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
  implementation_->hardware.orders[static_cast<std::size_t>(camera.index())]->ignore(areas);
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
  for (const CalibrationOrder& order : adoptOrders(saved, implementation_->rig))
    if (!orderCalibration(order))
      throw Error(ErrorKind::kSystem, "the engine is still busy with earlier orders", file.string(), "try again");
}

bool Engine::poll() {
  for (auto& calibration : implementation_->new_calibrations) calibration.collect();
  implementation_->new_change.collect();
  return implementation_->newest.take();
}
const EngineSnapshot& Engine::snapshot() const {
  return implementation_->newest.front();
}

bool Engine::pollPicture(CameraId camera) {
  return implementation_->taps[static_cast<std::size_t>(camera.index())].pictures().take();
}

const CameraPicture& Engine::picture(CameraId camera) const {
  return implementation_->taps[static_cast<std::size_t>(camera.index())].pictures().front();
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
