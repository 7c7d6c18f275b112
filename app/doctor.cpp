#include "app/doctor.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/usb_transmitters.h"
#include "engine/base/error.h"
#include "engine/cameras/aravis/gvcp_probe.h"
#include "engine/cameras/machine_check.h"
#include "engine/config/rig_file.h"

namespace helical {
namespace {

using nlohmann::json;
using Verdict = Finding::Verdict;

constexpr std::string_view kAravis = "aravis:";
constexpr int kProbeMs = 500;
constexpr int kFailed = 1, kDeviceMissing = 3;

struct DoctorArguments {
  std::string rig;
  bool json = false;
};

/// Whether the rig's network cameras answer, and whether somebody else has them. Sets `missing`.
std::vector<Finding> checkCameras(const RigConfig& rig, bool& missing) {
  std::vector<Finding> findings;
  for (const CameraConfig& camera : rig.cameras) {
    if (!camera.source.starts_with(kAravis)) continue;
    const std::string address = camera.source.substr(kAravis.size());
    if (!isIpAddress(address)) continue;
    Finding finding{camera.name, Verdict::kGood, address + " answers and is free", ""};
    const ProbeAnswer answer = probe(address, kProbeMs);
    if (answer == ProbeAnswer::kControlled) {
      finding.found = address + " is controlled by another program or host";
      finding.cure = "end the other one; after a crash wait 3 seconds";
    } else if (answer == ProbeAnswer::kSilent) {
      finding.found = address + " does not answer";
      finding.cure = "check its power and cable, and whether its address is of this machine's network: helical devices";
      missing = true;
    }
    if (answer != ProbeAnswer::kFree) finding.verdict = Verdict::kBad;
    findings.push_back(finding);
  }
  return findings;
}

const char* nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return "good";
    case Verdict::kAdvice:
      return "advice";
    case Verdict::kBad:
      return "bad";
  }
  return "";
}

std::string reportOf(const std::vector<Finding>& findings, bool as_json) {
  json report{{"checks", json::array()}};
  std::string text;
  for (const Finding& finding : findings) {
    report["checks"].push_back({{"check", finding.check},
                                {"verdict", nameOf(finding.verdict)},
                                {"found", finding.found},
                                {"cure", finding.cure.empty() ? json(nullptr) : json(finding.cure)}});
    text += std::string(nameOf(finding.verdict)) + "  " + finding.check + ": " + finding.found + "\n";
    if (!finding.cure.empty()) text += "      cure: " + finding.cure + "\n";
  }
  return as_json ? report.dump(2) + "\n" : text;
}

int examine(const DoctorArguments& arguments) {
  std::vector<Finding> findings = checkMachine("/");
  bool missing = false;
  const auto add = [&](std::vector<Finding> more) { findings.insert(findings.end(), more.begin(), more.end()); };
  std::optional<RigConfig> rig;
  if (!arguments.rig.empty()) rig = loadRig(arguments.rig);
  if (rig) add(checkCameras(*rig, missing));
  add(checkUsbTransmitters("/", rig ? &*rig : nullptr, missing));
  const std::string text = reportOf(findings, arguments.json);
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {}, "check the disk or the pipe");
  if (missing) return kDeviceMissing;
  const bool bad = std::any_of(findings.begin(), findings.end(),
                               [](const Finding& finding) { return finding.verdict == Verdict::kBad; });
  return bad ? kFailed : 0;
}

}  // namespace

void addDoctorCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<DoctorArguments>();
  CLI::App* command =
      app.add_subcommand("doctor", "What on this machine would get in the way of cameras and transmitters, and the cure");
  command->add_option("--rig", arguments->rig, "Looks for the cameras and the transmitter of this rig, too");
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = examine(*arguments); });
}

}  // namespace helical
