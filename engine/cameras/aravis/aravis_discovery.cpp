#include "engine/cameras/aravis/aravis_discovery.h"

#include <arv.h>

#include "engine/cameras/aravis/aravis_error.h"
#include "engine/cameras/aravis/gvcp_probe.h"

namespace helical {
namespace {

constexpr int kProbeMs = 100;

std::string text(const char* value) {
  return value != nullptr ? value : "";
}

void ask(ArvCamera* camera, FoundCamera& found) {
  arv_camera_get_sensor_size(camera, &found.width, &found.height, nullptr);
  guint count = 0;
  const char** names = arv_camera_dup_available_pixel_formats_as_strings(camera, &count, nullptr);
  found.formats.assign(names, names + count);
  g_free(static_cast<void*>(names));
  if (arv_camera_is_frame_rate_available(camera, nullptr) != 0)
    arv_camera_get_frame_rate_bounds(camera, &found.lowest_rate_hz, &found.highest_rate_hz, nullptr);
}

FoundCamera inspect(unsigned index) {
  FoundCamera found;
  const std::string address = text(arv_get_device_address(index)), id = text(arv_get_device_id(index));
  const bool network = text(arv_get_device_protocol(index)) == "GigEVision";
  found.kind = network ? "GigE Vision" : "USB3 Vision";
  found.serial = text(arv_get_device_serial_nbr(index));
  found.source = "aravis:" + (network ? address : found.serial);
  found.name = text(arv_get_device_vendor(index)) + " " + text(arv_get_device_model(index));
  found.owner = "free";
  if (network && probe(address, kProbeMs) == ProbeAnswer::kControlled) {
    found.owner = "controlled by another host or program";
    return found;
  }
  AravisError error;
  ArvCamera* const camera = arv_camera_new(id.c_str(), error.slot());
  if (camera == nullptr) {
    found.owner = "cannot be opened: " + error.text();
    return found;
  }
  ask(camera, found);
  g_object_unref(camera);
  return found;
}

}  // namespace

std::vector<FoundCamera> findAravisCameras() {
  arv_disable_interface("Fake");
  arv_update_device_list();
  std::vector<FoundCamera> cameras;
  const unsigned count = arv_get_n_devices();
  for (unsigned i = 0; i < count; ++i) cameras.push_back(inspect(i));
  return cameras;
}

}  // namespace helical
