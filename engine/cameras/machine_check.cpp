#include "engine/cameras/machine_check.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>

namespace helical {
namespace {

namespace fs = std::filesystem;
using Verdict = Finding::Verdict;

constexpr long kReceiveBuffer = 8L << 20;
constexpr long kJumboFrame = 9000;
constexpr long kUsbMemoryMb = 200;
constexpr long kUsefulPriority = 10;

std::optional<std::string> firstLine(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) return std::nullopt;
  return line;
}

std::optional<long> number(const fs::path& file) {
  const auto line = firstLine(file);
  if (!line) return std::nullopt;
  try {
    return std::stol(*line);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

/// In order of their names, so that a report repeats.
std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

Finding receiveBuffer(const fs::path& root) {
  Finding finding{"receive buffer", Verdict::kGood, "", ""};
  const auto bytes = number(root / "proc/sys/net/core/rmem_max");
  finding.found = bytes ? "net.core.rmem_max is " + std::to_string(*bytes) + " bytes" : "net.core.rmem_max is not known";
  if (bytes && *bytes >= kReceiveBuffer) return finding;
  finding.verdict = Verdict::kBad;
  finding.cure = "sudo sysctl -w net.core.rmem_max=33554432 (and a line of it in /etc/sysctl.d/90-helical.conf)";
  return finding;
}

void addNetworks(const fs::path& root, std::vector<Finding>& findings) {
  for (const fs::path& network : entriesOf(root / "sys/class/net")) {
    const std::string name = network.filename().string();
    const auto mtu = number(network / "mtu");
    if (name == "lo" || !mtu || firstLine(network / "operstate").value_or("") == "down") continue;
    Finding finding{"MTU of " + name, Verdict::kGood, std::to_string(*mtu) + " bytes", ""};
    if (*mtu < kJumboFrame) {
      finding.verdict = Verdict::kAdvice;
      finding.cure = "if cameras are on it: sudo ip link set " + name +
                     " mtu 9000, then packet_bytes = 9000 in the rig's [camera.device]";
    }
    findings.push_back(finding);
  }
}

Finding usbRules(const fs::path& root) {
  Finding finding{"udev rules", Verdict::kGood, "", ""};
  for (const char* folder : {"etc/udev/rules.d", "usr/lib/udev/rules.d", "lib/udev/rules.d"})
    for (const fs::path& file : entriesOf(root / folder))
      if (file.filename().string().find("aravis") != std::string::npos) {
        finding.found = "USB3 Vision cameras are open to users by " + file.filename().string();
        return finding;
      }
  finding.found = "no rule opens USB3 Vision cameras to users";
  finding.verdict = Verdict::kAdvice;
  finding.cure =
      "for USB3 Vision cameras: echo 'SUBSYSTEM==\"usb\", ATTRS{bDeviceClass}==\"ef\", ATTRS{bDeviceSubClass}==\"02\", "
      "MODE=\"0666\"' | sudo tee /etc/udev/rules.d/90-aravis.rules, then sudo udevadm control --reload";
  return finding;
}

Finding usbMemory(const fs::path& root) {
  Finding finding{"USB memory", Verdict::kGood, "this machine has no USB", ""};
  const auto megabytes = number(root / "sys/module/usbcore/parameters/usbfs_memory_mb");
  if (!megabytes) return finding;
  finding.found = "usbfs_memory_mb is " + std::to_string(*megabytes);
  if (*megabytes == 0 || *megabytes >= kUsbMemoryMb) return finding;  // 0: no limit
  finding.verdict = Verdict::kAdvice;
  finding.cure = "for USB3 Vision cameras: echo 1000 | sudo tee /sys/module/usbcore/parameters/usbfs_memory_mb";
  return finding;
}

Finding realTimePriority() {
  Finding finding{"real-time priority", Verdict::kGood, "", ""};
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  const bool allowed = geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY ||
                       limit.rlim_cur >= static_cast<rlim_t>(kUsefulPriority);
  finding.found = allowed ? "allowed" : "not allowed to this user";
  if (allowed) return finding;
  finding.verdict = Verdict::kAdvice;
  finding.cure =
      "echo \"$USER - rtprio 50\" | sudo tee /etc/security/limits.d/90-helical.conf, the same with nice -10, then log in "
      "again";
  return finding;
}

Finding governor(const fs::path& root) {
  Finding finding{"CPU governor", Verdict::kGood, "this machine does not change its clock", ""};
  for (const fs::path& cpu : entriesOf(root / "sys/devices/system/cpu")) {
    const auto name = firstLine(cpu / "cpufreq/scaling_governor");
    if (!name) continue;
    finding.found = *name;
    if (*name == "performance") continue;
    finding.verdict = Verdict::kAdvice;
    finding.cure = "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor";
    return finding;
  }
  return finding;
}

Finding webcamPermission(const fs::path& root) {
  Finding finding{"webcam permission", Verdict::kGood, "there is no webcam", ""};
  for (const fs::path& device : entriesOf(root / "dev")) {
    if (!device.filename().string().starts_with("video")) continue;
    finding.found = device.string() + " may be used";
    if (access(device.c_str(), R_OK | W_OK) == 0) continue;
    finding.found = device.string() + " may not be used";
    finding.verdict = Verdict::kBad;
    finding.cure = "sudo usermod -aG video $USER, then log in again";
    return finding;
  }
  return finding;
}

}  // namespace

std::vector<Finding> checkMachine(const fs::path& root) {
  std::vector<Finding> findings{receiveBuffer(root)};
  addNetworks(root, findings);
  findings.push_back(usbRules(root));
  findings.push_back(usbMemory(root));
  findings.push_back(webcamPermission(root));
  findings.push_back(realTimePriority());
  findings.push_back(governor(root));
  return findings;
}

}  // namespace helical
