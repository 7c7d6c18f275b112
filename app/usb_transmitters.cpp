#include "app/usb_transmitters.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/config/resource_files.h"
#include "engine/transmitter/crazyradio.h"
#include "engine/transmitter/mcc_analog_output.h"
#include "engine/transmitter/output_device.h"

namespace helical {
namespace {

using nlohmann::json;
using Verdict = Finding::Verdict;

constexpr const char* kRules = "60-helical.rules";

struct Plugged {
  std::string kind;  ///< as in a rig file
  UsbFound found;
};

std::vector<Plugged> plugged() {
  std::vector<Plugged> all;
  for (const auto& [kind, wanted] : {std::pair(kMccDevice, MccProtocol::wanted("")),
                                     std::pair(kCrazyradioDevice, Crazyradio::wanted(""))})
    for (UsbFound& found : UsbDevice::list(wanted)) all.push_back({kind, std::move(found)});
  return all;
}

std::string nameOf(const Plugged& device) {
  const UsbFound& found = device.found;
  const std::string name = found.name.empty() ? "bus " + std::to_string(found.bus) + " device " + std::to_string(found.address)
                                              : found.name;
  return device.kind + ": " + name + (found.serial.empty() ? "" : ", " + found.serial);
}

Finding checkRules(const std::filesystem::path& root, bool needed) {
  std::error_code ignored;
  for (const char* folder : {"etc/udev/rules.d", "usr/lib/udev/rules.d", "usr/local/lib/udev/rules.d", "lib/udev/rules.d"})
    if (std::filesystem::exists(root / folder / kRules, ignored))
      return {"USB rules", Verdict::kGood, "/" + std::string(folder) + "/" + kRules + " is installed", ""};
  return {"USB rules", needed ? Verdict::kBad : Verdict::kAdvice,
          std::string(kRules) + " is not installed: USB transmitters are the superuser's alone",
          "sudo cp " + (resourceFolder() / "udev" / kRules).string() +
              " /etc/udev/rules.d/ && sudo udevadm control --reload && sudo udevadm trigger"};
}

bool isOfRig(const Plugged& device, const TransmitterOptions& transmitter) {
  if (device.kind != transmitter.kind) return false;
  // One that cannot be opened does not say its number, and may be the one.
  return transmitter.device.empty() || device.found.serial.empty() || device.found.serial == transmitter.device;
}

Finding checkRig(const TransmitterOptions& transmitter, const std::vector<Plugged>& devices, bool& missing) {
  const auto count = std::count_if(devices.begin(), devices.end(),
                                   [&](const Plugged& device) { return isOfRig(device, transmitter); });
  if (count == 1) {
    const bool ready = directionsChecked(transmitter);
    return {"transmitter", ready ? Verdict::kGood : Verdict::kBad,
            ready ? "the rig's " + transmitter.kind + " is plugged in, its channels are calibrated and checked"
                  : "the channels of the rig's " + transmitter.kind + " are not calibrated, or their directions not checked",
            ready ? "" : "helical transmitter calibrate --rig RIG, then helical transmitter test --rig RIG"};
  }
  missing = missing || count == 0;
  const auto trouble = count == 0 ? TransmitterTrouble::kAbsent : TransmitterTrouble::kSeveral;
  return {"transmitter", Verdict::kBad, std::string("the rig's ") + transmitter.kind + ": " + toString(trouble), cureOf(trouble)};
}

/// Whether Helical can know that the pilot has taken over.
Finding checkTrainerSwitch(const TransmitterOptions& transmitter) {
  constexpr const char* kCheck = "trainer switch";
  if (transmitter.kind == kCrazyradioDevice)
    return {kCheck, Verdict::kAdvice,
            "a Crazyradio has no input for one: no other transmitter can take over while Helical sends",
            "who watches presses STOP (Esc), which cuts; then another radio may fly"};
  if (transmitter.trainer_input < 0)
    return {kCheck, Verdict::kAdvice, "the rig names no input: Helical does not know when the pilot has taken over",
            "wire the switch to a digital input and give its number: trainer_input in [transmitter]"};
  return {kCheck, Verdict::kGood, "at digital input " + std::to_string(transmitter.trainer_input), ""};
}

}  // namespace

json usbTransmittersJson() {
  json all = json::array();
  for (const Plugged& device : plugged()) {
    const char* trouble = toString(device.found.trouble);
    all.push_back({{"kind", device.kind},
                   {"name", device.found.name},
                   {"serial", device.found.serial},
                   {"trouble", *trouble == '\0' ? json(nullptr) : json(trouble)}});
  }
  return all;
}

std::string usbTransmittersText() {
  std::string text;
  for (const Plugged& device : plugged()) {
    text += nameOf(device) + "\n";
    if (device.found.trouble == TransmitterTrouble::kNone) continue;
    text += std::string("  ") + toString(device.found.trouble) + "; " + cureOf(device.found.trouble) + "\n";
  }
  return text;
}

std::vector<Finding> checkUsbTransmitters(const std::filesystem::path& root, const RigConfig* rig, bool& missing) {
  const std::vector<Plugged> devices = plugged();
  const bool usb_rig = rig != nullptr && isUsb(rig->transmitter);
  std::vector<Finding> findings{checkRules(root, usb_rig || !devices.empty())};
  for (const Plugged& device : devices)
    if (device.found.trouble != TransmitterTrouble::kNone)
      findings.push_back({nameOf(device), Verdict::kBad, toString(device.found.trouble), cureOf(device.found.trouble)});
  if (!usb_rig) return findings;
  findings.push_back(checkRig(rig->transmitter, devices, missing));
  findings.push_back(checkTrainerSwitch(rig->transmitter));
  return findings;
}

}  // namespace helical
