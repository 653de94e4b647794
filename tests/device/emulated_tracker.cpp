#include "tests/device/emulated_tracker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <utility>

namespace gazeloop::tests {
namespace {

constexpr const char* kHidPath = "/devices/emulated/0003:1209:E7E7.0001";
constexpr const char* kHidSyspath = "/sys/devices/emulated/0003:1209:E7E7.0001";

std::string taken(gchar* text) {
    std::string copy = text == nullptr ? "" : text;
    g_free(text);
    return copy;
}

/// The memory that an ioctl's argument points at.
UMockdevIoctlData* pointed_at(UMockdevIoctlClient* client, std::size_t bytes) {
    UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
    return umockdev_ioctl_data_resolve(argument, 0, bytes, nullptr);
}

bool fill(UMockdevIoctlClient* client, std::size_t bytes, std::vector<std::uint8_t> with) {
    UMockdevIoctlData* const data = pointed_at(client, bytes);
    if (data == nullptr) {
        return false;
    }
    with.resize(std::min(with.size(), bytes));
    umockdev_ioctl_data_update(data, 0, with.data(), static_cast<gint>(with.size()));
    umockdev_ioctl_data_unref(data);
    umockdev_ioctl_client_complete(client, static_cast<glong>(with.size()), 0);
    return true;
}

/// Ends the request with ETIMEDOUT then; reads through another descriptor go on meanwhile.
void give_up_after(UMockdevIoctlClient* client, std::chrono::milliseconds time) {
    GSource* const timer = g_timeout_source_new(static_cast<guint>(time.count()));
    const auto give_up = [](gpointer data) -> gboolean {
        umockdev_ioctl_client_complete(static_cast<UMockdevIoctlClient*>(data), -1, ETIMEDOUT);
        return G_SOURCE_REMOVE;
    };
    g_source_set_callback(timer, give_up, g_object_ref(client), g_object_unref);
    g_source_attach(timer, g_source_get_context(g_main_current_source()));
    g_source_unref(timer);
}

}  // namespace

EmulatedTracker::EmulatedTracker(std::vector<std::uint8_t> descriptor)
    : descriptor_(std::move(descriptor)),
      testbed_(umockdev_testbed_new()),
      handler_(umockdev_ioctl_base_new()) {
    g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(on_ioctl), this);
    g_signal_connect(handler_, "handle-read", G_CALLBACK(on_read), this);
}

EmulatedTracker::~EmulatedTracker() {
    if (fifo_ >= 0) {
        unplug();
    }
    g_object_unref(handler_);
    g_object_unref(testbed_);
}

std::string EmulatedTracker::node() const { return fmt::format("/dev/hidraw{}", plugged_ - 1); }

std::string EmulatedTracker::hidraw_syspath() const {
    return fmt::format("{}/hidraw/hidraw{}", kHidSyspath, plugged_ - 1);
}

void EmulatedTracker::plug_in() {
    fault_ = Fault::None;
    ++plugged_;
    real_node_ = taken(umockdev_testbed_get_root_dir(testbed_)) + node();
    std::string hex;
    for (const std::uint8_t byte : descriptor_) {
        hex += fmt::format("{:02X}", byte);
    }
    const std::string description = fmt::format(
        "P: {0}\n"
        "E: SUBSYSTEM=hid\n"
        "E: HID_ID=0003:00001209:0000E7E7\n"
        "E: HID_NAME=Emulated Eye Tracker\n"
        "H: report_descriptor={1}\n"
        "\n"
        "P: {0}/hidraw/hidraw{2}\n"
        "E: SUBSYSTEM=hidraw\n"
        "E: DEVNAME=/dev/hidraw{2}\n"
        "L: device=../../../0003:1209:E7E7.0001\n",
        kHidPath, hex, plugged_ - 1);
    // All of it, before anybody can see the device.
    GError* error = nullptr;
    if (umockdev_testbed_attach_ioctl(testbed_, node().c_str(), handler_, &error) == 0) {
        throw std::runtime_error(error->message);
    }
    std::filesystem::create_directories(std::filesystem::path(real_node_).parent_path());
    if (mkfifo(real_node_.c_str(), 0600) != 0) {
        throw std::runtime_error("no FIFO at " + real_node_ + ": " + std::strerror(errno));
    }
    fifo_ = open(real_node_.c_str(), O_RDWR | O_CLOEXEC);
    // As many packets as hidraw keeps of a device, one a page.
    constexpr int kQueueBytes = 64 * 4096;
    if (fifo_ < 0 || fcntl(fifo_, F_SETFL, O_DIRECT | O_NONBLOCK) != 0 ||
        fcntl(fifo_, F_SETPIPE_SZ, kQueueBytes) < 0) {
        throw std::runtime_error("no packets through " + real_node_);
    }
    if (umockdev_testbed_add_from_string(testbed_, description.c_str(), &error) == 0) {
        throw std::runtime_error(error->message);
    }
    umockdev_testbed_uevent(testbed_, hidraw_syspath().c_str(), "add");
}

void EmulatedTracker::unplug() {
    set_fault(Fault::ReadFails);
    umockdev_testbed_uevent(testbed_, hidraw_syspath().c_str(), "remove");
    umockdev_testbed_remove_device(testbed_, hidraw_syspath().c_str());
    umockdev_testbed_remove_device(testbed_, kHidSyspath);
    unlink(real_node_.c_str());
    close(fifo_);
    fifo_ = -1;
}

void EmulatedTracker::set_feature(std::uint8_t id, std::vector<std::uint8_t> report) {
    const std::lock_guard lock(mutex_);
    features_[id] = std::move(report);
}

void EmulatedTracker::leave_unanswered(std::uint8_t id, std::chrono::milliseconds given_up_after) {
    const std::lock_guard lock(mutex_);
    unanswered_[id] = given_up_after;
}

std::optional<std::vector<std::uint8_t>> EmulatedTracker::sent(std::uint8_t id) const {
    const std::lock_guard lock(mutex_);
    const auto found = sent_.find(id);
    return found == sent_.end() ? std::nullopt : std::optional(found->second);
}

int EmulatedTracker::asked() const {
    const std::lock_guard lock(mutex_);
    return asked_;
}

int EmulatedTracker::requests_taken() const {
    const std::lock_guard lock(mutex_);
    return taken_;
}

bool EmulatedTracker::try_send(std::span<const std::uint8_t> report) const {
    return write(fifo_, report.data(), report.size()) == static_cast<ssize_t>(report.size());
}

void EmulatedTracker::send(std::span<const std::uint8_t> report) const {
    constexpr int kTries = 10'000;
    for (int i = 0; i < kTries; ++i) {
        if (try_send(report)) {
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    throw std::runtime_error("nobody reads the emulated tracker");
}

void EmulatedTracker::set_fault(Fault fault) {
    fault_ = fault;
    if (fault == Fault::ReadFails) {
        wake_reader();
    }
}

void EmulatedTracker::set_mode(unsigned mode) const {
    // Whoever may not open the node still is to see it.
    chmod(real_node_.substr(0, real_node_.size() - node().size()).c_str(), 0755);
    chmod(real_node_.c_str(), mode);
}

void EmulatedTracker::set_link(const std::string& name, const std::string& target) const {
    // Past umockdev, which would look for the testbed's folder in the testbed.
    const std::filesystem::path link =
        taken(umockdev_testbed_get_root_dir(testbed_)) + "/dev/" + name;
    std::filesystem::create_directories(link.parent_path());
    std::filesystem::remove(link);
    std::filesystem::create_symlink(target, link);
}

void EmulatedTracker::wake_reader() const {
    const std::uint8_t any = 0;
    (void)!write(fifo_, &any, 1);
}

gboolean EmulatedTracker::on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    if (static_cast<EmulatedTracker*>(self)->fault_ != Fault::ReadFails) {
        return FALSE;
    }
    umockdev_ioctl_client_complete(client, -1, EIO);
    return TRUE;
}

gboolean EmulatedTracker::on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    return static_cast<EmulatedTracker*>(self)->answer(client) ? TRUE : FALSE;
}

bool EmulatedTracker::answer(UMockdevIoctlClient* client) {
    const gulong request = umockdev_ioctl_client_get_request(client);
    const std::size_t bytes = _IOC_SIZE(request);
    if (request == HIDIOCGRDESCSIZE) {
        const int size = static_cast<int>(descriptor_.size());
        std::vector<std::uint8_t> answer(sizeof(size));
        std::memcpy(answer.data(), &size, sizeof(size));
        return fill(client, bytes, answer);
    }
    if (_IOC_TYPE(request) != 'H') {
        return false;
    }
    const bool get = _IOC_NR(request) == 0x07;
    const bool set = _IOC_NR(request) == 0x06;
    if (!get && !set) {
        umockdev_ioctl_client_complete(client, -1, EINVAL);
        return true;
    }
    if (fault_ == Fault::FeaturesStall) {
        umockdev_ioctl_client_complete(client, -1, EPIPE);
        return true;
    }
    UMockdevIoctlData* const data = pointed_at(client, bytes);
    if (data == nullptr) {
        return false;
    }
    guint8* read = nullptr;
    gint length = 0;
    umockdev_ioctl_data_retrieve(data, &read, &length);
    const std::vector<std::uint8_t> report(read, read + length);
    g_free(read);
    umockdev_ioctl_data_unref(data);
    const std::lock_guard lock(mutex_);
    asked_ += get ? 1 : 0;
    if (const auto none = unanswered_.find(report.front()); none != unanswered_.end()) {
        give_up_after(client, none->second);
        return true;
    }
    if (set) {
        sent_[report.front()] = report;
        ++taken_;
        umockdev_ioctl_client_complete(client, static_cast<glong>(report.size()), 0);
        return true;
    }
    const auto found = features_.find(report.front());
    if (found == features_.end()) {
        umockdev_ioctl_client_complete(client, -1, EPIPE);
        return true;
    }
    return fill(client, bytes, found->second);
}

}  // namespace gazeloop::tests
