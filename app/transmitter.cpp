#include "app/transmitter.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/transmitter_calibration.h"
#include "app/transmitter_check.h"
#include "engine/base/error.h"
#include "engine/config/rig_file.h"
#include "engine/config/transmitter_writer.h"

namespace helical {
namespace {

constexpr int kGivenUp = 1;

struct Arguments {
  std::string rig, out;
};

/// Whose transmitter it is about. Throws Error(kInput) for a rig without a USB transmitter.
RigConfig usbRig(const std::string& file) {
  RigConfig rig = loadRig(file);
  if (!isUsb(rig.transmitter))
    throw Error(ErrorKind::kInput,
                "the rig's transmitter is '" + rig.transmitter.kind + "', which has no channels", file,
                "name a device in [transmitter]: kind = \"mcc-usb-3100\" or \"crazyradio\"");
  return rig;
}

void writeRig(const Arguments& arguments, const OutputChannels& channels, bool checked) {
  const std::string& out = arguments.out.empty() ? arguments.rig : arguments.out;
  writeChannels(arguments.rig, out, channels, checked);
  Conversation::say("written to " + out + "\n");
}

int calibrate(const Arguments& arguments) {
  const RigConfig rig = usbRig(arguments.rig);
  Conversation talk;
  const auto channels = measureChannels(talk, rig.transmitter);
  if (!channels) {
    Conversation::say("given up: the rig file is as it was\n");
    return kGivenUp;
  }
  writeRig(arguments, *channels, false);
  Conversation::say("it arms when somebody has seen which way the sticks go: helical transmitter test --rig " +
                    (arguments.out.empty() ? arguments.rig : arguments.out) + "\n");
  return 0;
}

int test(const Arguments& arguments) {
  RigConfig rig = usbRig(arguments.rig);
  if (rig.transmitter.channels.count == 0)
    throw Error(ErrorKind::kInput, "the transmitter's channels are not calibrated", arguments.rig,
                "helical transmitter calibrate --rig " + arguments.rig);
  Conversation talk;
  if (!lookAtDirections(talk, rig.transmitter)) {
    Conversation::say("not passed: the rig does not arm\n");
    return kGivenUp;
  }
  writeRig(arguments, rig.transmitter.channels, true);
  return 0;
}

void addRigOptions(CLI::App& command, const std::shared_ptr<Arguments>& arguments) {
  command.add_option("--rig", arguments->rig, "Rig file with a USB transmitter")->required();
  command.add_option("--out", arguments->out, "Rig file to write (default: the same)");
}

}  // namespace

void addTransmitterCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("transmitter", "Channels of a USB transmitter: measure them, look at them");
  command->require_subcommand(1);
  auto arguments = std::make_shared<Arguments>();
  CLI::App* calibrating = command->add_subcommand(
      "calibrate", "A dialog that finds every channel's output, ends and neutral; motors off");
  addRigOptions(*calibrating, arguments);
  calibrating->callback([arguments, &exit_code] { exit_code = calibrate(*arguments); });
  CLI::App* testing = command->add_subcommand(
      "test", "A dialog in which you look which way each stick goes; motors off. A rig does not arm before it");
  addRigOptions(*testing, arguments);
  testing->callback([arguments, &exit_code] { exit_code = test(*arguments); });
}

}  // namespace helical
