#include "engine/cameras/machine_check.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace helical {
namespace {

namespace fs = std::filesystem;

/// A machine made of files.
class Machine : public testing::Test {
 protected:
  Machine() : root_(fs::temp_directory_path() / ("helical-machine-" + std::to_string(getpid()))) {
    fs::remove_all(root_);
    put("proc/sys/net/core/rmem_max", "33554432");
    put("sys/class/net/eth0/mtu", "9000");
    put("sys/class/net/eth0/operstate", "up");
    put("etc/udev/rules.d/90-aravis.rules", "");
    put("sys/module/usbcore/parameters/usbfs_memory_mb", "1000");
    put("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
  }
  ~Machine() override { fs::remove_all(root_); }

  void put(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << "\n";
  }
  Finding find(const std::string& check) {
    const auto findings = checkMachine(root_);
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const auto& f) { return f.check == check; });
    if (found != findings.end()) return *found;
    ADD_FAILURE() << "no finding about " << check;
    return {};
  }
  void expectCured(const std::string& check, const std::string& by) {
    const Finding finding = find(check);
    EXPECT_NE(finding.verdict, Finding::Verdict::kGood) << check;
    EXPECT_NE(finding.cure.find(by), std::string::npos) << finding.cure;
  }

  fs::path root_;
};

TEST_F(Machine, ThatIsReadyHasNoCure) {
  for (const Finding& finding : checkMachine(root_)) {
    if (finding.check == "real-time priority") continue;  // this process' own
    EXPECT_EQ(finding.verdict, Finding::Verdict::kGood) << finding.check << ": " << finding.found;
    EXPECT_EQ(finding.cure, "") << finding.check;
  }
}

TEST_F(Machine, SmallReceiveBufferIsBad) {
  put("proc/sys/net/core/rmem_max", "212992");
  expectCured("receive buffer", "net.core.rmem_max=");
  EXPECT_EQ(find("receive buffer").verdict, Finding::Verdict::kBad);
  put("proc/sys/net/core/rmem_max", "nonsense");
  EXPECT_EQ(find("receive buffer").verdict, Finding::Verdict::kBad);
}

TEST_F(Machine, SmallPacketsAreAdvisedAgainstPerNetwork) {
  put("sys/class/net/eth1/mtu", "1500");
  expectCured("MTU of eth1", "ip link set eth1 mtu 9000");
  EXPECT_EQ(find("MTU of eth0").verdict, Finding::Verdict::kGood);
}

TEST_F(Machine, UsbAndGovernorAreAdvisedOn) {
  put("sys/module/usbcore/parameters/usbfs_memory_mb", "16");
  expectCured("USB memory", "usbfs_memory_mb");
  put("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave");
  expectCured("CPU governor", "performance");
  fs::remove(root_ / "etc/udev/rules.d/90-aravis.rules");
  expectCured("udev rules", "udev/rules.d");
}

TEST_F(Machine, WithoutUsbOrFrequenciesIsReady) {
  fs::remove_all(root_ / "sys/module");
  fs::remove_all(root_ / "sys/devices");
  EXPECT_EQ(find("USB memory").verdict, Finding::Verdict::kGood);
  EXPECT_EQ(find("CPU governor").verdict, Finding::Verdict::kGood);
}

}  // namespace
}  // namespace helical
