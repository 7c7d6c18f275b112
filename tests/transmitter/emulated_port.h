#pragma once

#include <umockdev.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "tests/transmitter/emulated_device.h"

namespace helical {

/// A port of an emulated USB bus, with a device in it: what an unmodified libusb, in this process or another one, takes
/// for /dev/bus/usb/BUS/ADDRESS. The node is a terminal that is writable when there is a transfer to reap, as usbfs has
/// it; closing the terminal is the unplugging. The process must run with libumockdev-preload.so.0 preloaded.
class EmulatedPort {
 public:
  enum class Access { kFree, kDenied };

  EmulatedPort(UMockdevTestbed* bed, int address, std::shared_ptr<EmulatedDevice> device,
               Access access = Access::kFree);
  ~EmulatedPort();
  EmulatedPort(const EmulatedPort&) = delete;
  EmulatedPort& operator=(const EmulatedPort&) = delete;

  /// As the kernel does it: transfers in flight end, nothing works any more, the device is gone from the tree.
  void unplug();
  /// Transfers that are waiting.
  int inFlight();

 private:
  struct Transfer;
  using TransferPointer = std::shared_ptr<Transfer>;

  static gboolean onRequest(UMockdevIoctlBase* base, UMockdevIoctlClient* client, gpointer self);
  bool handle(UMockdevIoctlClient* client);
  void makeNode(Access access);
  void announce();
  void takeAway(bool announced);
  void tellCapabilities(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
  int submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
  int reap(UMockdevIoctlData* argument);
  int discard(const UMockdevIoctlData* argument);
  UsbReply ask(Transfer& transfer);
  void serve();
  void finish(Transfer& transfer, int status, const UsbBytes& in);
  void forget(UMockdevIoctlClient* client);
  void showReapable();
  void watchClients();

  UMockdevTestbed* bed_;
  std::shared_ptr<EmulatedDevice> device_;
  UMockdevIoctlBase* handler_ = nullptr;
  gulong signal_ = 0;
  int address_;
  std::string node_, sysfs_, node_file_;
  int master_ = -1, slave_ = -1;
  bool reapable_ = false;
  bool gone_ = false;

  std::mutex mutex_;
  std::condition_variable stopping_;
  bool stop_ = false;
  std::list<UMockdevIoctlClient*> clients_;
  std::list<TransferPointer> pending_;
  std::deque<TransferPointer> done_;
  std::thread watcher_;
};

}  // namespace helical
