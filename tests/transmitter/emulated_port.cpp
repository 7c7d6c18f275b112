#include "tests/transmitter/emulated_port.h"

#include <fcntl.h>
#include <glib/gstdio.h>
#include <linux/usbdevice_fs.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <set>
#include <stdexcept>

namespace helical {
namespace {

constexpr std::size_t kSetupBytes = 8;

std::string formatted(const char* format, int number) {
  char text[128];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace

/// A request block of the client, mirrored from its memory.
struct EmulatedPort::Transfer {
  UMockdevIoctlClient* client = nullptr;
  UMockdevIoctlData* block = nullptr;
  UMockdevIoctlData* buffer = nullptr;

  ~Transfer() {
    if (buffer != nullptr) g_object_unref(buffer);
    if (block != nullptr) g_object_unref(block);
  }
  usbdevfs_urb& urb() const { return *reinterpret_cast<usbdevfs_urb*>(block->data); }
  bool isControl() const { return urb().type == USBDEVFS_URB_TYPE_CONTROL; }
  bool isIn() const { return ((isControl() ? buffer->data[0] : urb().endpoint) & 0x80) != 0; }
  std::size_t offset() const { return isControl() ? kSetupBytes : 0; }
  std::size_t size() const { return static_cast<std::size_t>(urb().buffer_length) - offset(); }
  UsbBytes data() const {
    if (buffer == nullptr || isIn()) return {};
    return {buffer->data + offset(), buffer->data + urb().buffer_length};
  }
  UsbSetup setup() const {
    const auto word = [this](int at) {
      return static_cast<std::uint16_t>(buffer->data[at] | buffer->data[at + 1] << 8);
    };
    return {buffer->data[0], buffer->data[1], word(2), word(4), word(6)};
  }
};

EmulatedPort::EmulatedPort(UMockdevTestbed* bed, int address, std::shared_ptr<EmulatedDevice> device, Access access)
    : bed_(bed),
      device_(std::move(device)),
      handler_(umockdev_ioctl_base_new()),
      address_(address),
      node_(formatted("/dev/bus/usb/001/%03d", address)),
      sysfs_(formatted("/devices/pci0000:00/usb1/1-%d", address)) {
  signal_ = g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(&EmulatedPort::onRequest), this);
  GError* failure = nullptr;
  if (!umockdev_testbed_attach_ioctl(bed_, node_.c_str(), handler_, &failure))
    throw std::runtime_error(failure->message);
  makeNode(access);
  announce();
  watcher_ = std::thread([this] { watchClients(); });
}

EmulatedPort::~EmulatedPort() {
  // Nobody is told: whoever still looks for devices, an output process that nobody waited for, opens and closes its ear
  // for events as it likes.
  takeAway(false);
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopping_.notify_all();
  watcher_.join();
  for (UMockdevIoctlClient* client : clients_) g_object_unref(client);
  g_signal_handler_disconnect(handler_, signal_);
  g_object_unref(handler_);
}

void EmulatedPort::makeNode(Access access) {
  char* root = umockdev_testbed_get_root_dir(bed_);
  node_file_ = root + node_;
  g_free(root);
  g_mkdir_with_parents(node_file_.substr(0, node_file_.rfind('/')).c_str(), 0755);
  // Nobody may write to it, the superuser included.
  std::string target = "/proc/sys/kernel/ostype";
  if (access == Access::kFree) {
    char name[128];
    if (openpty(&master_, &slave_, name, nullptr, nullptr) != 0) throw std::runtime_error("no terminal");
    target = name;
    termios settings;
    tcgetattr(slave_, &settings);
    cfmakeraw(&settings);
    tcsetattr(slave_, TCSANOW, &settings);
    tcflow(slave_, TCOOFF);
  }
  if (symlink(target.c_str(), node_file_.c_str()) != 0) throw std::runtime_error("no node");
}

void EmulatedPort::announce() {
  std::string hex;
  for (const std::uint8_t byte : device_->descriptors()) hex += formatted("%02x", byte);
  // Without the line that would make a node: there is one.
  const std::string text = "P: " + sysfs_ +
                           "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\n" +
                           formatted("E: DEVNUM=%03d\n", address_) + "E: DEVNAME=" + node_ +
                           "\nA: busnum=1\\n\n" + formatted("A: devnum=%d\\n\n", address_) +
                           "A: bConfigurationValue=1\\n\nA: speed=12\\n\n" + "H: descriptors=" + hex + "\n";
  GError* failure = nullptr;
  if (!umockdev_testbed_add_from_string(bed_, text.c_str(), &failure)) throw std::runtime_error(failure->message);
}

void EmulatedPort::unplug() {
  takeAway(true);
}

void EmulatedPort::takeAway(bool announced) {
  {
    const std::lock_guard lock(mutex_);
    if (gone_) return;
    gone_ = true;
  }
  const std::string path = "/sys" + sysfs_;
  // Before the transfers end: who waits for one closes its ear for events then, and umockdev ends the process when it
  // finds one closed on its way to it.
  if (announced) umockdev_testbed_uevent(bed_, path.c_str(), "remove");
  {
    const std::lock_guard lock(mutex_);
    for (const auto& transfer : pending_) {
      finish(*transfer, -ESHUTDOWN, {});
      done_.push_back(transfer);
    }
    pending_.clear();
    showReapable();
    if (master_ >= 0) close(master_);
    master_ = -1;
  }
  umockdev_testbed_remove_device(bed_, path.c_str());
  umockdev_testbed_detach_ioctl(bed_, node_.c_str(), nullptr);
  unlink(node_file_.c_str());
  if (slave_ >= 0) close(slave_);
  slave_ = -1;
}

int EmulatedPort::inFlight() {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(pending_.size());
}

gboolean EmulatedPort::onRequest(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer self) {
  return static_cast<EmulatedPort*>(self)->handle(client) ? TRUE : FALSE;
}

bool EmulatedPort::handle(UMockdevIoctlClient* client) {
  UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
  int error = 0;
  {
    const std::lock_guard lock(mutex_);
    switch (umockdev_ioctl_client_get_request(client)) {
      case USBDEVFS_GET_CAPABILITIES:
        tellCapabilities(client, argument);
        break;
      case USBDEVFS_RELEASEINTERFACE:
        forget(client);
        [[fallthrough]];
      case USBDEVFS_CLAIMINTERFACE:
      case USBDEVFS_DISCONNECT_CLAIM:
      case USBDEVFS_CLEAR_HALT:
      case USBDEVFS_IOCTL:
        error = gone_ ? ENODEV : 0;
        break;
      case USBDEVFS_GETDRIVER:
        error = ENODATA;
        break;
      case USBDEVFS_SUBMITURB:
        error = submit(client, argument);
        break;
      case USBDEVFS_REAPURB:
      case USBDEVFS_REAPURBNDELAY:
        error = reap(argument);
        break;
      case USBDEVFS_DISCARDURB:
        error = discard(argument);
        break;
      default:
        error = ENOTTY;
    }
  }
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
  return true;
}

/// The first that libusb asks: a new client.
void EmulatedPort::tellCapabilities(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  clients_.push_back(static_cast<UMockdevIoctlClient*>(g_object_ref(client)));
  UMockdevIoctlData* data = umockdev_ioctl_data_resolve(argument, 0, 4, nullptr);
  if (data == nullptr) return;
  const std::uint32_t capabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                     USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
  std::memcpy(data->data, &capabilities, sizeof capabilities);
  g_object_unref(data);
}

int EmulatedPort::submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  if (gone_) return ENODEV;
  auto transfer = std::make_shared<Transfer>();
  transfer->client = client;
  transfer->block = umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr);
  if (transfer->block == nullptr) return EIO;
  const int length = transfer->urb().buffer_length;
  if (length > 0)
    transfer->buffer = umockdev_ioctl_data_resolve(transfer->block, G_STRUCT_OFFSET(usbdevfs_urb, buffer),
                                                   static_cast<std::size_t>(length), nullptr);
  pending_.push_back(transfer);
  if (transfer->isControl() || !transfer->isIn()) {
    const UsbReply reply = ask(*transfer);
    if (!reply.pending) {
      finish(*transfer, reply.status, reply.in);
      pending_.remove(transfer);
      done_.push_back(transfer);
    }
  }
  serve();
  return 0;
}

UsbReply EmulatedPort::ask(Transfer& transfer) {
  const std::lock_guard lock(device_->mutex);
  if (transfer.isControl()) return device_->control(transfer.setup(), transfer.data());
  if (transfer.isIn()) return device_->in(transfer.urb().endpoint);
  return device_->out(transfer.urb().endpoint, transfer.data());
}

/// What waits for data is asked again, one after the other on each endpoint.
void EmulatedPort::serve() {
  std::set<int> empty;
  for (auto it = pending_.begin(); it != pending_.end();) {
    const TransferPointer transfer = *it;
    const int endpoint = transfer->urb().endpoint;
    if (transfer->isControl() || !transfer->isIn() || empty.contains(endpoint)) {
      ++it;
      continue;
    }
    const UsbReply reply = ask(*transfer);
    if (reply.pending) {
      empty.insert(endpoint);
      ++it;
      continue;
    }
    finish(*transfer, reply.status, reply.in);
    done_.push_back(transfer);
    it = pending_.erase(it);
  }
  showReapable();
}

void EmulatedPort::finish(Transfer& transfer, int status, const UsbBytes& in) {
  usbdevfs_urb& urb = transfer.urb();
  urb.status = status;
  urb.actual_length = status == 0 ? static_cast<int>(transfer.size()) : 0;
  if (!transfer.isIn()) return;
  const std::size_t count = std::min(in.size(), transfer.size());
  if (count > 0) std::memcpy(transfer.buffer->data + transfer.offset(), in.data(), count);
  urb.actual_length = static_cast<int>(count);
}

int EmulatedPort::reap(UMockdevIoctlData* argument) {
  if (done_.empty()) return gone_ ? ENODEV : EAGAIN;
  const TransferPointer transfer = done_.front();
  done_.pop_front();
  showReapable();
  UMockdevIoctlData* result = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
  if (result == nullptr) return EIO;
  umockdev_ioctl_data_set_ptr(result, 0, transfer->block);
  g_object_unref(result);
  return 0;
}

int EmulatedPort::discard(const UMockdevIoctlData* argument) {
  const gulong address = *reinterpret_cast<const gulong*>(argument->data);
  const auto found = std::find_if(pending_.begin(), pending_.end(),
                                  [&](const auto& transfer) { return transfer->block->client_addr == address; });
  if (found == pending_.end()) return EINVAL;
  finish(**found, -ENOENT, {});
  done_.push_back(*found);
  pending_.erase(found);
  showReapable();
  return 0;
}

/// The kernel drops a client's transfers when it lets go of the interface, and when it dies.
void EmulatedPort::forget(UMockdevIoctlClient* client) {
  const auto is_its = [&](const auto& transfer) { return transfer->client == client; };
  pending_.remove_if(is_its);
  std::erase_if(done_, is_its);
  showReapable();
}

void EmulatedPort::showReapable() {
  const bool wanted = !done_.empty();
  if (master_ < 0 || slave_ < 0 || wanted == reapable_) return;
  tcflow(slave_, wanted ? TCOON : TCOOFF);
  reapable_ = wanted;
}

/// umockdev does not say when a client closes its node: it is looked for.
void EmulatedPort::watchClients() {
  std::unique_lock lock(mutex_);
  while (!stopping_.wait_for(lock, std::chrono::milliseconds(20), [this] { return stop_; }))
    for (auto it = clients_.begin(); it != clients_.end();) {
      if (umockdev_ioctl_client_get_connected(*it)) {
        ++it;
        continue;
      }
      forget(*it);
      g_object_unref(*it);
      it = clients_.erase(it);
    }
}

}  // namespace helical
