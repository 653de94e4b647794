#include "tests/device/emulated_psvr2.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "sim/psvr2_packet.h"

namespace gazeloop::tests {
namespace {

constexpr const char* kSyspath = "/sys/devices/usb1";
constexpr std::size_t kFifoBytes = 4096;
constexpr std::size_t kSetupBytes = 8;

/// The host's copy of its own structure.
usbdevfs_urb& urb_in(UMockdevIoctlData* data) {
    return *reinterpret_cast<usbdevfs_urb*>(data->data);
}

void complete(UMockdevIoctlClient* client, int error = 0) {
    umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
}

}  // namespace

EmulatedPsvr2::EmulatedPsvr2()
    : testbed_(umockdev_testbed_new()), handler_(umockdev_ioctl_base_new()) {
    g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(on_ioctl), this);
    gchar* const root = umockdev_testbed_get_root_dir(testbed_);
    root_ = root;
    g_free(root);
}

EmulatedPsvr2::~EmulatedPsvr2() {
    if (fifo_ >= 0) {
        unplug();
    }
    g_object_unref(handler_);
    g_object_unref(testbed_);
    forget(waiting_);
    forget(ended_);
}

void EmulatedPsvr2::forget(std::deque<Urb>& urbs) {
    for (const Urb& urb : urbs) {
        umockdev_ioctl_data_unref(urb.urb);
        umockdev_ioctl_data_unref(urb.buffer);
    }
    urbs.clear();
}

std::string EmulatedPsvr2::node() const {
    return fmt::format("/dev/bus/usb/001/{:03}", device_number_);
}

void EmulatedPsvr2::plug_in() {
    {
        const std::lock_guard lock(mutex_);
        ++device_number_;
        gone_ = false;
        halted_ = false;
        to_send_.clear();
        forget(waiting_);
        forget(ended_);
    }
    std::string hex;
    for (const std::uint8_t byte : sim::psvr2_descriptors()) {
        hex += fmt::format("{:02X}", byte);
    }
    const std::string description = fmt::format(
        "P: /devices/usb1\n"
        "E: SUBSYSTEM=usb\n"
        "E: DEVTYPE=usb_device\n"
        "E: PRODUCT=54c/cde/100\n"
        "E: DEVNAME=/dev/bus/usb/001/{0:03}\n"
        "A: busnum=1\\n\n"
        "A: devnum={0}\\n\n"
        "A: bConfigurationValue=1\\n\n"
        "A: speed=480\\n\n"
        "H: descriptors={1}\n",
        device_number_, hex);
    // All of it, before anybody can see the device.
    const std::filesystem::path real_node = root_ + node();
    std::filesystem::create_directories(real_node.parent_path());
    if (mkfifo(real_node.c_str(), 0600) != 0) {
        throw std::runtime_error("no FIFO at " + real_node.string() + ": " + std::strerror(errno));
    }
    fifo_ = open(real_node.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (fifo_ < 0 || fcntl(fifo_, F_SETPIPE_SZ, kFifoBytes) < 0) {
        throw std::runtime_error("no small FIFO at " + real_node.string());
    }
    show_whether_any_has_ended();
    GError* error = nullptr;
    if (umockdev_testbed_attach_ioctl(testbed_, node().c_str(), handler_, &error) == 0 ||
        umockdev_testbed_add_from_string(testbed_, description.c_str(), &error) == 0) {
        throw std::runtime_error(error->message);
    }
    umockdev_testbed_uevent(testbed_, kSyspath, "add");
}

void EmulatedPsvr2::unplug() {
    {
        const std::lock_guard lock(mutex_);
        gone_ = true;
        while (!waiting_.empty()) {
            const Urb urb = waiting_.front();
            waiting_.pop_front();
            finish(urb, -ESHUTDOWN, 0);
        }
    }
    umockdev_testbed_uevent(testbed_, kSyspath, "remove");
    umockdev_testbed_remove_device(testbed_, kSyspath);
    unlink((root_ + node()).c_str());
    const std::lock_guard lock(mutex_);
    close(fifo_);
    fifo_ = -1;
}

void EmulatedPsvr2::set_fault(Fault fault) {
    const std::lock_guard lock(mutex_);
    fault_ = fault;
    show_whether_any_has_ended();
}

void EmulatedPsvr2::set_mode(unsigned mode) const {
    chmod(root_.c_str(), 0755);
    chmod((root_ + node()).c_str(), mode);
}

void EmulatedPsvr2::send(std::span<const std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    to_send_.emplace_back(bytes.begin(), bytes.end());
    deliver();
}

void EmulatedPsvr2::halt() {
    const std::lock_guard lock(mutex_);
    halted_ = true;
    while (!waiting_.empty()) {
        const Urb urb = waiting_.front();
        waiting_.pop_front();
        finish(urb, -EPIPE, 0);
    }
}

EmulatedPsvr2::Seen EmulatedPsvr2::seen() const {
    const std::lock_guard lock(mutex_);
    Seen seen = seen_;
    seen.listening = waiting_.size();
    return seen;
}

gboolean EmulatedPsvr2::on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    auto* const headset = static_cast<EmulatedPsvr2*>(self);
    const std::lock_guard lock(headset->mutex_);
    headset->answer(client);
    return TRUE;
}

void EmulatedPsvr2::answer(UMockdevIoctlClient* client) {
    UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
    const auto request = umockdev_ioctl_client_get_request(client);
    if (request == USBDEVFS_REAPURBNDELAY || request == USBDEVFS_REAPURB) {
        reap(client);
        return;
    }
    if (gone_) {
        complete(client, ENODEV);
        return;
    }
    switch (request) {
        case USBDEVFS_GET_CAPABILITIES: {
            UMockdevIoctlData* const data =
                umockdev_ioctl_data_resolve(argument, 0, sizeof(std::uint32_t), nullptr);
            std::uint32_t capabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                         USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                         USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
            umockdev_ioctl_data_update(data, 0, reinterpret_cast<guint8*>(&capabilities),
                                       sizeof(capabilities));
            umockdev_ioctl_data_unref(data);
            complete(client);
            return;
        }
        case USBDEVFS_GETDRIVER: {
            if (fault_ != Fault::KernelDriver) {
                complete(client, ENODATA);
                return;
            }
            UMockdevIoctlData* const data =
                umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_getdriver), nullptr);
            char name[] = "headset";
            umockdev_ioctl_data_update(data, offsetof(usbdevfs_getdriver, driver),
                                       reinterpret_cast<guint8*>(name), sizeof(name));
            umockdev_ioctl_data_unref(data);
            complete(client);
            return;
        }
        case USBDEVFS_CLAIMINTERFACE: {
            UMockdevIoctlData* const data =
                umockdev_ioctl_data_resolve(argument, 0, sizeof(unsigned), nullptr);
            unsigned interface = 0;
            std::memcpy(&interface, data->data, sizeof(interface));
            umockdev_ioctl_data_unref(data);
            const bool taken = fault_ == Fault::ClaimedElsewhere || fault_ == Fault::KernelDriver;
            if (!taken) {
                ++seen_.claims;
                seen_.claimed.push_back(interface);
            }
            complete(client, taken ? EBUSY : 0);
            return;
        }
        case USBDEVFS_RELEASEINTERFACE:
            ++seen_.releases;
            // Nobody asks for them again: the node is closed next.
            forget(waiting_);
            forget(ended_);
            complete(client);
            return;
        case USBDEVFS_CLEAR_HALT:
            if (fault_ == Fault::PulledOut) {
                unlink((root_ + node()).c_str());
            }
            if (fault_ == Fault::PulledOut || fault_ == Fault::HaltStays) {
                complete(client, EPROTO);
                return;
            }
            ++seen_.halts_cleared;
            seen_.order += 'H';
            halted_ = false;
            complete(client);
            return;
        case USBDEVFS_SUBMITURB:
            submit(client);
            return;
        case USBDEVFS_DISCARDURB:
            discard(client);
            return;
        default:
            complete(client, ENOTTY);
            return;
    }
}

void EmulatedPsvr2::submit(UMockdevIoctlClient* client) {
    Urb urb;
    urb.urb = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0,
                                          sizeof(usbdevfs_urb), nullptr);
    urb.buffer =
        umockdev_ioctl_data_resolve(urb.urb, offsetof(usbdevfs_urb, buffer),
                                    static_cast<gsize>(urb_in(urb.urb).buffer_length), nullptr);
    complete(client);
    if (urb_in(urb.urb).type == USBDEVFS_URB_TYPE_CONTROL) {
        take_request(urb);
    } else if (halted_) {
        finish(urb, -EPIPE, 0);
    } else {
        seen_.order += 'R';
        seen_.endpoints.push_back(urb_in(urb.urb).endpoint);
        waiting_.push_back(urb);
        deliver();
    }
}

void EmulatedPsvr2::take_request(const Urb& urb) {
    const std::uint8_t* const setup = urb.buffer->data;
    const auto u16 = [&](std::size_t at) {
        return static_cast<std::uint16_t>(setup[at] | setup[at + 1] << 8U);
    };
    const auto length = static_cast<std::size_t>(urb.buffer->data_len) - kSetupBytes;
    const auto asks = sim::psvr2_gaze_request({.request_type = setup[0],
                                               .request = setup[1],
                                               .value = u16(2),
                                               .index = u16(4),
                                               .payload = {setup + kSetupBytes, length}});
    if (fault_ == Fault::RequestStalls || !asks || u16(6) != length) {
        ++seen_.others;
        finish(urb, -EPIPE, 0);
        return;
    }
    ++(*asks ? seen_.starts : seen_.stops);
    seen_.order += *asks ? "S" : "";
    finish(urb, 0, static_cast<int>(length));
}

void EmulatedPsvr2::reap(UMockdevIoctlClient* client) {
    if (fault_ == Fault::EventsFail) {
        complete(client, EIO);
        return;
    }
    if (ended_.empty()) {
        complete(client, gone_ ? ENODEV : EAGAIN);
        return;
    }
    const Urb urb = ended_.front();
    ended_.pop_front();
    UMockdevIoctlData* const pointer = umockdev_ioctl_data_resolve(
        umockdev_ioctl_client_get_arg(client), 0, sizeof(void*), nullptr);
    umockdev_ioctl_data_set_ptr(pointer, 0, urb.urb);
    show_whether_any_has_ended();
    complete(client);
    umockdev_ioctl_data_unref(pointer);
    umockdev_ioctl_data_unref(urb.buffer);
    umockdev_ioctl_data_unref(urb.urb);
}

void EmulatedPsvr2::discard(UMockdevIoctlClient* client) {
    gulong address = 0;
    std::memcpy(&address, umockdev_ioctl_client_get_arg(client)->data, sizeof(address));
    const auto found = std::ranges::find_if(
        waiting_, [&](const Urb& urb) { return urb.urb->client_addr == address; });
    if (found == waiting_.end()) {
        complete(client, EINVAL);
        return;
    }
    if (fault_ == Fault::NothingEnds) {
        complete(client);
        return;
    }
    const Urb urb = *found;
    waiting_.erase(found);
    complete(client);
    finish(urb, -ENOENT, 0);
}

void EmulatedPsvr2::finish(const Urb& urb, int status, int actual_length) {
    urb_in(urb.urb).status = status;
    urb_in(urb.urb).actual_length = actual_length;
    ended_.push_back(urb);
    show_whether_any_has_ended();
}

void EmulatedPsvr2::deliver() {
    while (!waiting_.empty() && !to_send_.empty()) {
        const Urb urb = waiting_.front();
        waiting_.pop_front();
        const std::vector<std::uint8_t>& bytes = to_send_.front();
        const std::size_t room = static_cast<std::size_t>(urb.buffer->data_len);
        const std::size_t length = std::min(room, bytes.size());
        std::copy_n(bytes.begin(), length, urb.buffer->data);
        finish(urb, bytes.size() > room ? -EOVERFLOW : 0, static_cast<int>(length));
        to_send_.pop_front();
    }
}

void EmulatedPsvr2::show_whether_any_has_ended() const {
    static constexpr std::array<std::uint8_t, kFifoBytes> kFull{};
    if (fifo_ < 0) {
        return;
    }
    if (ended_.empty() && !gone_ && fault_ != Fault::EventsFail) {
        while (write(fifo_, kFull.data(), kFull.size()) > 0) {
        }
    } else {
        std::array<std::uint8_t, kFifoBytes> taken{};
        while (read(fifo_, taken.data(), taken.size()) > 0) {
        }
    }
}

}  // namespace gazeloop::tests
