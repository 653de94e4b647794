#include "drivers/psvr2/usb_headset.h"

#include <fmt/format.h>
#include <libusb.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <new>
#include <span>
#include <thread>
#include <utility>

#include "drivers/device/last_words.h"
#include "runtime/time/clock.h"

namespace gazeloop::drivers::psvr2 {
namespace {

constexpr int kGazeInterface = 5;
constexpr std::uint8_t kSetReport = 9;
constexpr std::uint8_t kGazeStream = 0x0C;
constexpr unsigned kRequestTimeout_ms = 500;
/// After so many halts and errors with no data between them, it is opened again.
constexpr int kMostFailures = 5;
/// A headset that is pulled out fails at once. Its hub tells the kernel a moment later: hubs are
/// polled at least four times per second.
constexpr std::int64_t kMayStillGo_ns = 500'000'000;
/// How long the transfers of a device that is released may take to end.
constexpr std::int64_t kLongestEnd_ns = 2'000'000'000;

std::unexpected<Error> no_device(const FoundDevice& found, const std::string& what) {
    return std::unexpected(Error{ErrorKind::NoDevice, fmt::format("{}: {}", found.text(), what)});
}

/// The bus and the address in /dev/bus/usb/BBB/DDD.
struct UsbAddress {
    unsigned bus = 0;
    unsigned device = 0;

    friend bool operator==(const UsbAddress&, const UsbAddress&) = default;
};

UsbAddress address_in(const std::string& path) {
    UsbAddress address;
    std::sscanf(path.c_str(), "/dev/bus/usb/%u/%u", &address.bus, &address.device);
    return address;
}

/// The bulk endpoint that the gaze comes from; 0 where the device has none. (0x85 on the headset;
/// taken from its descriptor, where a gadget may have another.)
std::uint8_t gaze_endpoint(libusb_device* device) {
    libusb_config_descriptor* config = nullptr;
    if (libusb_get_active_config_descriptor(device, &config) != 0) {
        return 0;
    }
    std::uint8_t found = 0;
    for (const libusb_interface& interface : std::span(config->interface, config->bNumInterfaces)) {
        if (interface.num_altsetting < 1 ||
            interface.altsetting[0].bInterfaceNumber != kGazeInterface) {
            continue;
        }
        const libusb_interface_descriptor& setting = interface.altsetting[0];
        for (const libusb_endpoint_descriptor& endpoint :
             std::span(setting.endpoint, setting.bNumEndpoints)) {
            const bool bulk =
                (endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) == LIBUSB_TRANSFER_TYPE_BULK;
            if (found == 0 && bulk && (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0) {
                found = endpoint.bEndpointAddress;
            }
        }
    }
    libusb_free_config_descriptor(config);
    return found;
}

}  // namespace

// ---- context and handle

void UsbContext::Exit::operator()(libusb_context* context) const { libusb_exit(context); }

Expected<UsbContext> UsbContext::create() {
    libusb_context* context = nullptr;
    if (const int result = libusb_init(&context); result != 0) {
        return std::unexpected(Error{
            ErrorKind::NoDevice, fmt::format("USB cannot be used: {}",
                                             libusb_strerror(static_cast<libusb_error>(result)))});
    }
    return UsbContext(context);
}

void UsbHandle::Close::operator()(libusb_device_handle* handle) const {
    libusb_release_interface(handle, kGazeInterface);  // an error where it was not claimed
    libusb_close(handle);
}

Expected<UsbHandle> UsbHandle::open(const UsbContext& context, const FoundDevice& found) {
    libusb_device** list = nullptr;
    const ssize_t count = libusb_get_device_list(context.get(), &list);
    if (count < 0) {
        return no_device(found, "USB devices cannot be listed");
    }
    const UsbAddress address = address_in(found.path);
    int result = LIBUSB_ERROR_NO_DEVICE;
    libusb_device_handle* opened = nullptr;
    std::uint8_t endpoint = 0;
    for (libusb_device* const device : std::span(list, static_cast<std::size_t>(count))) {
        if (address ==
            UsbAddress{libusb_get_bus_number(device), libusb_get_device_address(device)}) {
            result = libusb_open(device, &opened);
            endpoint = gaze_endpoint(device);
        }
    }
    libusb_free_device_list(list, 1);
    if (result != 0) {
        return no_device(found, fmt::format("cannot be opened: {}",
                                            libusb_strerror(static_cast<libusb_error>(result))));
    }
    UsbHandle handle(opened, endpoint);
    if (endpoint == 0) {
        return no_device(found, "has no gaze interface (5, with a bulk endpoint)");
    }
    if (libusb_kernel_driver_active(opened, kGazeInterface) == 1) {
        return no_device(found, "a kernel driver has its gaze interface (5): unload that driver");
    }
    if (const int claimed = libusb_claim_interface(opened, kGazeInterface); claimed != 0) {
        return no_device(found,
                         claimed == LIBUSB_ERROR_BUSY
                             ? std::string("another program uses its gaze interface (5): close it "
                                           "(SteamVR, Monado and the like)")
                             : fmt::format("its gaze interface (5) cannot be claimed: {}",
                                           libusb_strerror(static_cast<libusb_error>(claimed))));
    }
    return handle;
}

// ---- the headset

void UsbHeadset::Transfer::Free::operator()(libusb_transfer* transfer) const {
    libusb_free_transfer(transfer);
}

UsbHeadset::UsbHeadset(UsbContext context, UsbHandle handle, const FoundDevice& found,
                       const Psvr2Options& options)
    : text_(found.text()),
      path_(found.path),
      remarks_{std::string(kSupport.verified)},
      context_(std::move(context)),
      handle_(std::move(handle)),
      samples_(options.delay),
      keeper_(time::monotonic_ns()) {
    for (std::unique_ptr<Transfer>& transfer : data_) {
        transfer = new_transfer();
        libusb_fill_bulk_transfer(transfer->transfer.get(), handle_.get(), handle_.endpoint(),
                                  transfer->bytes.data(), static_cast<int>(transfer->bytes.size()),
                                  on_data, transfer.get(), 0);
    }
    request_ = new_transfer();
    submit_all();
}

std::unique_ptr<UsbHeadset::Transfer> UsbHeadset::new_transfer() {
    auto transfer = std::make_unique<Transfer>();
    transfer->owner = this;
    transfer->transfer.reset(libusb_alloc_transfer(0));
    if (!transfer->transfer) {
        throw std::bad_alloc();
    }
    return transfer;
}

UsbHeadset::~UsbHeadset() {
    feed_ = nullptr;
    const std::int64_t until_ns = time::monotonic_ns() + kLongestEnd_ns;
    cancel_all();
    bool ended = end_all(until_ns);
    if (ended && !gone_) {
        ask(Asking::Stop, time::monotonic_ns());
        ended = end_all(until_ns);
    }
    if (!ended) {
        leave_what_is_under_way();
    }
}

bool UsbHeadset::end_all(std::int64_t until_ns) {
    while (any_under_way() || request_->under_way) {
        if (time::monotonic_ns() >= until_ns || !wait(kLongestRead)) {
            return false;
        }
    }
    return true;
}

/// Closing the device detaches its transfers, so that no callback comes. But libusb has no way to
/// free a transfer that has not ended.
void UsbHeadset::leave_what_is_under_way() {
    static std::atomic<Transfer*> left{nullptr};  // so that all of them can still be reached
    const auto leave = [](std::unique_ptr<Transfer>& transfer) {
        if (!transfer->under_way) {
            return 0;
        }
        Transfer* const kept = transfer.release();
        kept->left_before = left.exchange(kept);
        return 1;
    };
    int count = leave(request_);
    for (std::unique_ptr<Transfer>& transfer : data_) {
        count += leave(transfer);
    }
    say_last_words(fmt::format("{}: {} of its transfers do not end: left, and the device closed",
                               text_, count));
}

Expected<void> UsbHeadset::read(std::chrono::milliseconds longest, DeviceFeed& feed) {
    feed_ = &feed;
    std::int64_t now_ns = time::monotonic_ns();
    if (failure_.empty()) {
        keep_alive(now_ns);
    }
    tell_loss();
    // Right after a failure it is only waited for: it may go.
    const auto until_due = std::chrono::nanoseconds(
        std::max<std::int64_t>(failure_.empty() ? keeper_.next_ns() - now_ns : kMayStillGo_ns,
                               std::chrono::nanoseconds(std::chrono::milliseconds(1)).count()));
    const auto pause = std::min(std::chrono::duration_cast<std::chrono::microseconds>(longest),
                                std::chrono::duration_cast<std::chrono::microseconds>(until_due));
    const bool waited = wait(pause);
    tell_loss();
    if (!waited && !gone_) {
        std::this_thread::sleep_for(pause);  // libusb did not: no turning in circles
    }
    if (halted_ && !any_under_way() && failure_.empty()) {
        recover();
    }
    feed_ = nullptr;
    if (const auto why = why_over(time::monotonic_ns())) {
        return std::unexpected(Error{ErrorKind::NoDevice, fmt::format("{}: {}", path_, *why)});
    }
    return {};
}

/// The gaze counts as lost from the failure to the next packet. The loop is told before the cause
/// is known and before an endpoint is cleared, which may take a while.
void UsbHeadset::tell_loss() {
    if (halted_ || gone_ || !failure_.empty()) {
        feed_->push_loss(time::measured_now());
    }
}

/// A failure is only the reason once it is clear that the headset is still there.
std::optional<std::string> UsbHeadset::why_over(std::int64_t now_ns) {
    if (!gone_ && failure_.empty()) {
        return std::nullopt;
    }
    gone_ = gone_ || ::access(path_.c_str(), F_OK) != 0;
    if (gone_) {
        return "unplugged";
    }
    failed_ns_ = failed_ns_.value_or(now_ns);
    return now_ns - *failed_ns_ < kMayStillGo_ns ? std::nullopt : std::optional(failure_);
}

bool UsbHeadset::wait(std::chrono::microseconds longest) {
    constexpr std::int64_t kSecond_us = 1'000'000;
    timeval time{.tv_sec = longest.count() / kSecond_us, .tv_usec = longest.count() % kSecond_us};
    const int result = libusb_handle_events_timeout_completed(context_.get(), &time, nullptr);
    if (result == 0 || result == LIBUSB_ERROR_INTERRUPTED) {
        return true;
    }
    note(result, "waiting for its data");
    return false;
}

void UsbHeadset::on_data(libusb_transfer* transfer) {
    const std::int64_t arrived_ns = time::monotonic_ns();
    Transfer& ours = *static_cast<Transfer*>(transfer->user_data);
    ours.under_way = false;
    ours.owner->take(ours, arrived_ns);
}

void UsbHeadset::take(Transfer& transfer, std::int64_t arrived_ns) {
    switch (transfer.transfer->status) {
        case LIBUSB_TRANSFER_COMPLETED:
        case LIBUSB_TRANSFER_OVERFLOW:  // longer than any packet, and refused as such
            break;
        case LIBUSB_TRANSFER_NO_DEVICE:
            gone_ = true;
            return;
        case LIBUSB_TRANSFER_CANCELLED:
            return;
        case LIBUSB_TRANSFER_STALL:
        case LIBUSB_TRANSFER_ERROR:
        case LIBUSB_TRANSFER_TIMED_OUT:
            halted_ = true;
            cancel_all();
            return;
    }
    if (feed_ == nullptr || !failure_.empty()) {
        return;  // it ends
    }
    const auto length = static_cast<std::size_t>(transfer.transfer->actual_length);
    keeper_.heard(arrived_ns);
    failures_in_a_row_ = 0;
    if (std::exchange(told_silent_, false)) {
        feed_->tell({arrived_ns, time::StampKind::Measured}, "sends again");
    }
    if (auto sample = samples_.take({transfer.bytes.data(), length}, arrived_ns)) {
        feed_->push(*sample, samples_.lost_before_last());
    }
    while (auto change = samples_.take_change()) {
        feed_->tell({arrived_ns, time::StampKind::Measured}, std::move(*change));
    }
    submit(transfer);
}

void UsbHeadset::submit(Transfer& transfer) {
    if (halted_ || gone_) {
        return;
    }
    const int result = libusb_submit_transfer(transfer.transfer.get());
    transfer.under_way = result == 0;
    note(result, "reading");
}

void UsbHeadset::submit_all() {
    for (const std::unique_ptr<Transfer>& transfer : data_) {
        submit(*transfer);
    }
}

void UsbHeadset::cancel_all() {
    for (const std::unique_ptr<Transfer>& transfer : data_) {
        if (transfer->under_way) {
            libusb_cancel_transfer(transfer->transfer.get());
        }
    }
}

bool UsbHeadset::any_under_way() const {
    return std::ranges::any_of(
        data_, [](const std::unique_ptr<Transfer>& transfer) { return transfer->under_way; });
}

/// Takes the result of a libusb call.
void UsbHeadset::note(int result, std::string_view doing) {
    if (result == LIBUSB_ERROR_NO_DEVICE) {
        gone_ = true;
    } else if (result != 0 && failure_.empty()) {
        failure_ =
            fmt::format("{} failed: {}", doing, libusb_strerror(static_cast<libusb_error>(result)));
    }
}

void UsbHeadset::ask(Asking what, std::int64_t now_ns) {
    if (request_->under_way) {
        return;
    }
    keeper_.asked(now_ns);
    libusb_fill_control_setup(
        request_->bytes.data(),
        static_cast<std::uint8_t>(static_cast<unsigned>(LIBUSB_ENDPOINT_OUT) |
                                  static_cast<unsigned>(LIBUSB_REQUEST_TYPE_VENDOR) |
                                  static_cast<unsigned>(LIBUSB_RECIPIENT_ENDPOINT)),
        kSetReport, kGazeStream, 0, kRequestBytes);
    // Report id and subcommand of two bytes each, and a length of four: no more follows.
    const std::array<std::uint8_t, kRequestBytes> request{kGazeStream, 0,
                                                          static_cast<std::uint8_t>(what)};
    std::ranges::copy(request, request_->bytes.begin() + LIBUSB_CONTROL_SETUP_SIZE);
    libusb_fill_control_transfer(request_->transfer.get(), handle_.get(), request_->bytes.data(),
                                 on_asked, request_.get(), kRequestTimeout_ms);
    const int result = libusb_submit_transfer(request_->transfer.get());
    request_->under_way = result == 0;
    note(result, "asking for gaze");
}

void UsbHeadset::on_asked(libusb_transfer* transfer) {
    Transfer& ours = *static_cast<Transfer*>(transfer->user_data);
    ours.under_way = false;
    UsbHeadset& headset = *ours.owner;
    if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE) {
        headset.gone_ = true;
    } else if (transfer->status != LIBUSB_TRANSFER_COMPLETED && headset.feed_ != nullptr &&
               !std::exchange(headset.told_refused_, true)) {
        headset.feed_->tell(time::measured_now(),
                            "does not take the request for gaze; listening nevertheless");
    }
}

void UsbHeadset::keep_alive(std::int64_t now_ns) {
    if (now_ns < keeper_.next_ns()) {
        return;
    }
    if (keeper_.silent(now_ns) && !std::exchange(told_silent_, true)) {
        feed_->tell({now_ns, time::StampKind::Measured},
                    "silent for half a second: asking for gaze until it comes");
    }
    ask(Asking::Start, now_ns);
}

void UsbHeadset::recover() {
    halted_ = false;
    if (gone_) {
        return;
    }
    if (++failures_in_a_row_ > kMostFailures) {
        failure_ = "its gaze endpoint does not recover";
        return;
    }
    note(libusb_clear_halt(handle_.get(), handle_.endpoint()), "clearing its halted endpoint");
    if (gone_ || !failure_.empty()) {
        return;
    }
    const time::Stamp now = time::measured_now();
    if (failures_in_a_row_ == 1) {
        feed_->tell(now, "its gaze endpoint was halted: cleared, and asked for gaze again");
    }
    ask(Asking::Start, now.ns);
    submit_all();
}

}  // namespace gazeloop::drivers::psvr2
