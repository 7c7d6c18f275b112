#include "engine/transmitter/usb_device.h"

#include <libusb.h>

#include <algorithm>
#include <array>
#include <utility>

namespace helical {
namespace {

TransmitterTrouble troubleOf(int code) {
  switch (code) {
    case LIBUSB_SUCCESS:
      return TransmitterTrouble::kNone;
    case LIBUSB_ERROR_PIPE:
      return TransmitterTrouble::kStalled;
    case LIBUSB_ERROR_TIMEOUT:
      return TransmitterTrouble::kTimedOut;
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return TransmitterTrouble::kAbsent;
    case LIBUSB_ERROR_ACCESS:
      return TransmitterTrouble::kNoPermission;
    case LIBUSB_ERROR_BUSY:
      return TransmitterTrouble::kBusy;
    default:
      return TransmitterTrouble::kFailed;
  }
}

struct ContextEnd {
  void operator()(libusb_context* context) const { libusb_exit(context); }
};
struct HandleEnd {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using Context = std::unique_ptr<libusb_context, ContextEnd>;
using Handle = std::unique_ptr<libusb_device_handle, HandleEnd>;

/// A new one for each opening: it looks at the bus as it is now, and needs nobody to pump its events.
Context makeContext() {
  libusb_context* context = nullptr;
  return libusb_init(&context) == 0 ? Context(context) : nullptr;
}

std::string textOf(libusb_device_handle* handle, std::uint8_t index) {
  std::array<unsigned char, 256> text;
  if (index == 0) return {};
  const int length = libusb_get_string_descriptor_ascii(handle, index, text.data(), static_cast<int>(text.size()));
  return length > 0 ? std::string(text.begin(), text.begin() + length) : std::string();
}

struct Candidate {
  UsbFound found;
  Handle handle;
};

std::vector<Candidate> candidates(libusb_context* context, const UsbWanted& wanted) {
  std::vector<Candidate> all;
  libusb_device** devices = nullptr;
  const ssize_t count = libusb_get_device_list(context, &devices);
  for (ssize_t i = 0; i < count; ++i) {
    libusb_device_descriptor descriptor;
    if (libusb_get_device_descriptor(devices[i], &descriptor) != 0) continue;
    if (descriptor.idVendor != wanted.vendor ||
        std::find(wanted.products.begin(), wanted.products.end(), descriptor.idProduct) == wanted.products.end())
      continue;
    Candidate candidate;
    candidate.found.vendor = descriptor.idVendor;
    candidate.found.product = descriptor.idProduct;
    candidate.found.bus = libusb_get_bus_number(devices[i]);
    candidate.found.address = libusb_get_device_address(devices[i]);
    libusb_device_handle* handle = nullptr;
    candidate.found.trouble = troubleOf(libusb_open(devices[i], &handle));
    if (handle != nullptr) {
      candidate.handle.reset(handle);
      candidate.found.name = textOf(handle, descriptor.iProduct);
      candidate.found.serial = textOf(handle, descriptor.iSerialNumber);
    }
    all.push_back(std::move(candidate));
  }
  if (devices != nullptr) libusb_free_device_list(devices, 1);
  return all;
}

struct Endpoint {
  std::uint8_t address = 0;  ///< 0: none
  bool bulk = false;
};

}  // namespace

struct UsbDevice::State {
  Context context;
  Handle handle;
  UsbFound found;
  Endpoint out, in;
  int timeout_ms = 50;

  TransmitterTrouble claim() {
    // The kernel's driver for input devices takes whatever calls itself one; where there is none, so much the better.
    libusb_set_auto_detach_kernel_driver(handle.get(), 1);
    if (const int failed = libusb_claim_interface(handle.get(), 0); failed != 0) return troubleOf(failed);
    libusb_config_descriptor* config = nullptr;
    const int failed = libusb_get_active_config_descriptor(libusb_get_device(handle.get()), &config);
    if (failed != 0) return troubleOf(failed);
    if (config->bNumInterfaces > 0 && config->interface[0].num_altsetting > 0) findEndpoints(config->interface[0].altsetting[0]);
    libusb_free_config_descriptor(config);
    return in.address != 0 ? TransmitterTrouble::kNone : TransmitterTrouble::kUnfit;
  }

  void findEndpoints(const libusb_interface_descriptor& interface) {
    for (int i = 0; i < interface.bNumEndpoints; ++i) {
      const libusb_endpoint_descriptor& endpoint = interface.endpoint[i];
      Endpoint& end = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0 ? in : out;
      if (end.address != 0) continue;
      end.address = endpoint.bEndpointAddress;
      end.bulk = (endpoint.bmAttributes & 3) == LIBUSB_TRANSFER_TYPE_BULK;
    }
  }

  int transfer(const Endpoint& end, unsigned char* data, std::size_t size, int& moved, int wait_ms) const {
    const auto transferring = end.bulk ? libusb_bulk_transfer : libusb_interrupt_transfer;
    return transferring(handle.get(), end.address, data, static_cast<int>(size), &moved,
                        static_cast<unsigned>(std::max(1, wait_ms)));
  }
};

UsbDevice::UsbDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}

UsbDevice::~UsbDevice() {
  libusb_release_interface(state_->handle.get(), 0);
}

std::vector<UsbFound> UsbDevice::list(const UsbWanted& wanted) {
  const Context context = makeContext();
  std::vector<UsbFound> all;
  if (!context) return all;
  for (Candidate& candidate : candidates(context.get(), wanted)) all.push_back(std::move(candidate.found));
  std::sort(all.begin(), all.end(), [](const UsbFound& a, const UsbFound& b) {
    return std::pair(a.bus, a.address) < std::pair(b.bus, b.address);
  });
  return all;
}

UsbDevice::Opening UsbDevice::open(const UsbWanted& wanted) {
  auto state = std::make_unique<State>();
  state->context = makeContext();
  state->timeout_ms = wanted.timeout_ms;
  if (!state->context) return {nullptr, TransmitterTrouble::kFailed};
  std::vector<Candidate> all = candidates(state->context.get(), wanted);
  // One that cannot be opened may be the one that is meant: it counts.
  std::erase_if(all, [&](const Candidate& candidate) {
    return candidate.handle && !wanted.serial.empty() && candidate.found.serial != wanted.serial;
  });
  if (!wanted.serial.empty() && std::any_of(all.begin(), all.end(), [](const auto& c) { return c.handle != nullptr; }))
    std::erase_if(all, [](const Candidate& candidate) { return !candidate.handle; });
  if (all.empty()) return {nullptr, TransmitterTrouble::kAbsent};
  if (all.size() > 1) return {nullptr, TransmitterTrouble::kSeveral};
  if (!all[0].handle) return {nullptr, all[0].found.trouble};
  state->handle = std::move(all[0].handle);
  state->found = std::move(all[0].found);
  if (const auto trouble = state->claim(); trouble != TransmitterTrouble::kNone) return {nullptr, trouble};
  return {std::unique_ptr<UsbDevice>(new UsbDevice(std::move(state))), TransmitterTrouble::kNone};
}

std::uint16_t UsbDevice::product() const {
  return state_->found.product;
}

const std::string& UsbDevice::serial() const {
  return state_->found.serial;
}

bool UsbDevice::hasOutEndpoint() const {
  return state_->out.address != 0;
}

TransmitterTrouble UsbDevice::control(std::uint8_t request_type, std::uint8_t request, std::uint16_t value,
                                      std::span<const std::uint8_t> data) {
  // libusb does not write to what goes out.
  const int moved = libusb_control_transfer(state_->handle.get(), request_type, request, value, 0,
                                            const_cast<unsigned char*>(data.data()),
                                            static_cast<std::uint16_t>(data.size()),
                                            static_cast<unsigned>(std::max(1, state_->timeout_ms)));
  if (moved < 0) return troubleOf(moved);
  return static_cast<std::size_t>(moved) == data.size() ? TransmitterTrouble::kNone : TransmitterTrouble::kFailed;
}

TransmitterTrouble UsbDevice::write(std::span<const std::uint8_t> data) {
  int moved = 0;
  const int failed = state_->transfer(state_->out, const_cast<unsigned char*>(data.data()), data.size(), moved,
                                      state_->timeout_ms);
  if (failed == LIBUSB_ERROR_PIPE) libusb_clear_halt(state_->handle.get(), state_->out.address);
  if (failed != 0) return troubleOf(failed);
  return static_cast<std::size_t>(moved) == data.size() ? TransmitterTrouble::kNone : TransmitterTrouble::kFailed;
}

TransmitterTrouble UsbDevice::read(std::span<std::uint8_t> data, std::size_t& count, int timeout_ms) {
  int moved = 0;
  const int failed = state_->transfer(state_->in, data.data(), data.size(), moved,
                                      timeout_ms > 0 ? timeout_ms : state_->timeout_ms);
  if (failed == LIBUSB_ERROR_PIPE) libusb_clear_halt(state_->handle.get(), state_->in.address);
  count = failed == 0 ? static_cast<std::size_t>(moved) : 0;
  return troubleOf(failed);
}

}  // namespace helical
