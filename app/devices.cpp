#include "app/devices.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/usb_transmitters.h"
#include "engine/base/error.h"
#include "engine/cameras/aravis/aravis_discovery.h"
#include "engine/cameras/webcam/webcam_discovery.h"

namespace helical {
namespace {

using nlohmann::json;

json told(double value) {
  return value > 0.0 ? json(value) : json(nullptr);
}

json toJson(const FoundCamera& camera) {
  return {{"source", camera.source},
          {"kind", camera.kind},
          {"name", camera.name},
          {"serial", camera.serial},
          {"owner", camera.owner},
          {"size", camera.width > 0 ? json({camera.width, camera.height}) : json(nullptr)},
          {"formats", camera.formats},
          {"rate_hz", {told(camera.lowest_rate_hz), told(camera.highest_rate_hz)}}};
}

std::string toText(const FoundCamera& camera) {
  std::string text = camera.source + "  " + camera.kind + ": " + camera.name + ", " + camera.serial + "\n";
  text += "  " + camera.owner + "\n";
  if (camera.width > 0)
    text += "  " + std::to_string(camera.width) + " x " + std::to_string(camera.height) + " pixels\n";
  std::string formats;
  for (const std::string& format : camera.formats) formats += (formats.empty() ? "  " : ", ") + format;
  if (!formats.empty()) text += formats + "\n";
  char rates[64];
  std::snprintf(rates, sizeof rates, "  %.4g to %.4g Hz\n", camera.lowest_rate_hz, camera.highest_rate_hz);
  if (camera.highest_rate_hz > 0.0) text += rates;
  return text;
}

void listDevices(bool as_json) {
  std::vector<FoundCamera> cameras = findAravisCameras();
  for (FoundCamera& webcam : findWebcams()) cameras.push_back(std::move(webcam));
  std::string text;
  if (as_json) {
    json report{{"cameras", json::array()}};
    for (const FoundCamera& camera : cameras) report["cameras"].push_back(toJson(camera));
    report["transmitters"] = usbTransmittersJson();
    text = report.dump(2) + "\n";
  } else {
    for (const FoundCamera& camera : cameras) text += toText(camera);
    if (cameras.empty()) text = "no camera answers; `helical doctor` looks for what is in its way\n";
    text += usbTransmittersText();
  }
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the list cannot be written to standard output", {}, "check the disk or the pipe");
}

}  // namespace

void addDevicesCommand(CLI::App& app, int& exit_code) {
  auto as_json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("devices", "Cameras and transmitters that are plugged in");
  command->add_flag("--json", *as_json, "Print one JSON object");
  command->callback([as_json, &exit_code] {
    listDevices(*as_json);
    exit_code = 0;
  });
}

}  // namespace helical
