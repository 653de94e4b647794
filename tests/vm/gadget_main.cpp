// vm_gadget tracker|psvr2: that device on the kernel's dummy USB host controller, with a simulated
// person's gaze, until a signal pulls it out. Prints how many reports the host fetched.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <exception>
#include <string_view>

#include "runtime/time/clock.h"
#include "sim/gaze_generator.h"
#include "sim/psvr2_packet.h"
#include "sim/virtual_tracker.h"
#include "tests/vm/usb_gadget.h"

namespace gazeloop::tests {
namespace {

constexpr std::uint16_t kRate_hz = 120;
constexpr std::int64_t kPeriod_ns = 1'000'000'000 / kRate_hz;
constexpr const char* kGadgetFolder = "/dev/gadget";

volatile std::sig_atomic_t pulled_out = 0;
std::atomic<bool> asked{false};

using Bytes = UsbGadget::Bytes;

std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value); }
std::uint8_t high(std::size_t value) { return static_cast<std::uint8_t>(value >> 8U); }

/// The virtual tracker's, without what it says of its capabilities: GadgetFS hands over at most 256
/// bytes at a request.
Bytes tracker_descriptor() {
    constexpr std::array<std::uint8_t, 2> kCapabilities{0x85, 0x11};   // report id 0x11
    constexpr std::array<std::uint8_t, 2> kConfiguration{0x85, 0x12};  // report id 0x12
    const auto whole = sim::virtual_tracker_descriptor();
    const auto from = std::ranges::search(whole, kCapabilities).begin();
    const auto to = std::ranges::search(whole, kConfiguration).begin();
    Bytes bytes(whole.begin(), from);
    bytes.insert(bytes.end(), {0x15, 0x00});  // the range that follows begins at 0
    bytes.insert(bytes.end(), to, whole.end());
    return bytes;
}

/// HID 1.11, 7.1 and 7.2: descriptor, feature reports.
std::optional<Bytes> tracker_answers(const usb_ctrlrequest& request,
                                     std::span<const std::uint8_t> data) {
    constexpr std::uint8_t kReportDescriptor = 0x22;
    constexpr std::uint8_t kFeature = 3;
    constexpr std::uint8_t kGetReport = 0x01;
    constexpr std::uint8_t kSetReport = 0x09;
    constexpr std::uint8_t kSetIdle = 0x0A;
    const std::uint8_t kind = high(request.wValue);
    const std::uint8_t id = low(request.wValue);
    switch (request.bRequestType) {
        case USB_DIR_IN | USB_TYPE_STANDARD | USB_RECIP_INTERFACE:
            if (request.bRequest == USB_REQ_GET_DESCRIPTOR && kind == kReportDescriptor) {
                return tracker_descriptor();
            }
            return std::nullopt;
        case USB_DIR_IN | USB_TYPE_CLASS | USB_RECIP_INTERFACE:
            return request.bRequest == kGetReport && kind == kFeature
                       ? sim::virtual_tracker_feature(id, kRate_hz)
                       : std::nullopt;
        case USB_DIR_OUT | USB_TYPE_CLASS | USB_RECIP_INTERFACE:
            if (request.bRequest == kSetReport && data.size() >= 2 &&
                data[0] == sim::kVirtualControlId) {
                asked = data[1] != 0;
                return Bytes();
            }
            return request.bRequest == kSetIdle ? std::optional(Bytes()) : std::nullopt;
        default:
            return std::nullopt;
    }
}

/// A HID device whose packets are shorter than its reports.
UsbGadget::Device tracker() {
    const std::size_t descriptor_bytes = tracker_descriptor().size();
    UsbGadget::Device device;
    device.descriptor = {18,
                         USB_DT_DEVICE,
                         0x00,
                         0x02,
                         0,
                         0,
                         0,
                         64,
                         low(sim::kVirtualVendor),
                         high(sim::kVirtualVendor),
                         low(sim::kVirtualProduct),
                         high(sim::kVirtualProduct),
                         0x00,
                         0x01,
                         0,
                         0,
                         0,
                         1};
    device.endpoint = {7, USB_DT_ENDPOINT, USB_DIR_IN | 1, USB_ENDPOINT_XFER_INT, 64, 0, 4};
    device.configuration = {9,
                            USB_DT_CONFIG,
                            34,
                            0,
                            1,
                            1,
                            0,
                            USB_CONFIG_ATT_ONE,
                            50,
                            9,
                            USB_DT_INTERFACE,
                            0,
                            0,
                            1,
                            USB_CLASS_HID,
                            0,
                            0,
                            0,
                            9,
                            0x21,
                            0x11,
                            0x01,
                            0,
                            1,
                            0x22,
                            low(descriptor_bytes),
                            high(descriptor_bytes)};
    device.configuration.insert(device.configuration.end(), device.endpoint.begin(),
                                device.endpoint.end());
    device.endpoint_file = "ep5in-int";
    device.answer = tracker_answers;
    device.wanted = [] { return asked.load(); };
    return device;
}

std::optional<Bytes> headset_answers(const usb_ctrlrequest& request,
                                     std::span<const std::uint8_t> data) {
    const auto wanted = sim::psvr2_gaze_request({.request_type = request.bRequestType,
                                                 .request = request.bRequest,
                                                 .value = request.wValue,
                                                 .index = request.wIndex,
                                                 .payload = data});
    if (!wanted) {
        return std::nullopt;
    }
    asked = *wanted;
    return Bytes();
}

UsbGadget::Device headset() {
    const std::vector<std::uint8_t> bytes = sim::psvr2_descriptors();
    UsbGadget::Device device;
    device.descriptor.assign(bytes.begin(), bytes.begin() + USB_DT_DEVICE_SIZE);
    device.configuration.assign(bytes.begin() + USB_DT_DEVICE_SIZE, bytes.end());
    device.endpoint.assign(bytes.end() - USB_DT_ENDPOINT_SIZE, bytes.end());
    device.endpoint_file = "ep6in-bulk";  // any that can do bulk: the host sees the descriptor's
    device.answer = headset_answers;
    device.wanted = [] { return asked.load(); };
    return device;
}

/// Like a device: at its rate, whether or not the last one was fetched late.
std::uint64_t send_gaze(const UsbGadget& gadget, bool is_headset) {
    const gaze::GazeTrace trace = sim::generate_gaze({}, 60.0);
    std::uint64_t sent = 0;
    const std::int64_t begin_ns = time::monotonic_ns();
    for (std::uint32_t i = 0; pulled_out == 0; ++i) {
        const std::int64_t due_ns = begin_ns + i * kPeriod_ns;
        while (pulled_out == 0 && time::monotonic_ns() < due_ns) {
            time::sleep_until_ns(due_ns);  // a signal ends it early
        }
        if (!asked) {
            continue;
        }
        const gaze::GazeSample& sample = trace.samples[i % trace.samples.size()];
        const auto time_us = static_cast<std::uint64_t>(i * kPeriod_ns / 1000);
        const bool fetched = is_headset ? gadget.send(sim::psvr2_packet(sample, time_us, i))
                                        : gadget.send(sim::virtual_tracker_report(sample, time_us));
        sent += fetched ? 1 : 0;
    }
    return sent;
}

int gadget_main(std::string_view name) {
    const bool is_headset = name == "psvr2";
    if (!is_headset && name != "tracker") {
        fmt::print(stderr, "usage: vm_gadget tracker|psvr2\n");
        return 2;
    }
    struct sigaction action{};
    action.sa_handler = [](int) { pulled_out = 1; };  // without SA_RESTART: it ends a write, too
    sigaction(SIGTERM, &action, nullptr);
    const UsbGadget gadget(kGadgetFolder, is_headset ? headset() : tracker());
    fmt::print("{} reports sent\n", send_gaze(gadget, is_headset));
    return 0;
}

}  // namespace
}  // namespace gazeloop::tests

int main(int count, char** arguments) {
    try {
        return gazeloop::tests::gadget_main(count == 2 ? arguments[1] : "");
    } catch (const std::exception& error) {
        fmt::print(stderr, "vm_gadget: {}\n", error.what());
        return 1;
    }
}
