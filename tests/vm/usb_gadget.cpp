#include "tests/vm/usb_gadget.h"

#include <fcntl.h>
#include <linux/usb/gadgetfs.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace gazeloop::tests {
namespace {

using Bytes = UsbGadget::Bytes;

/// What GadgetFS wants to be written first: a tag, then descriptors.
Bytes tagged(std::uint32_t tag, std::initializer_list<const Bytes*> parts) {
    Bytes bytes(sizeof(tag));
    std::memcpy(bytes.data(), &tag, sizeof(tag));
    for (const Bytes* part : parts) {
        bytes.insert(bytes.end(), part->begin(), part->end());
    }
    return bytes;
}

void write_all(int fd, const Bytes& bytes, const std::string& to) {
    if (fd < 0 || write(fd, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
        throw std::runtime_error(to + ": " + std::strerror(errno));
    }
}

}  // namespace

UsbGadget::UsbGadget(const std::string& folder, Device device)
    : folder_(folder), device_(std::move(device)), sender_(pthread_self()) {
    struct sigaction give_up{};
    give_up.sa_handler = [](int) {};  // without SA_RESTART: it ends a write
    sigaction(SIGUSR1, &give_up, nullptr);
    const std::string file = folder_ + "/dummy_udc";
    control_ = open(file.c_str(), O_RDWR | O_CLOEXEC);
    // The configuration twice: at full speed, and at high speed, which is the one it gets.
    write_all(control_,
              tagged(0, {&device_.configuration, &device_.configuration, &device_.descriptor}),
              file);
    thread_ = std::thread([this] { serve(); });
}

UsbGadget::~UsbGadget() {
    stop_ = true;
    thread_.join();
    for (const int fd : {endpoint_.load(), control_}) {
        if (fd >= 0) {
            close(fd);
        }
    }
}

bool UsbGadget::send(std::span<const std::uint8_t> data) const {
    const int fd = endpoint_;
    return fd >= 0 && write(fd, data.data(), data.size()) == static_cast<ssize_t>(data.size());
}

void UsbGadget::serve() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);  // they are for the thread that sends
    constexpr int kLook_ms = 50;
    while (!stop_) {
        if (!device_.wanted()) {
            pthread_kill(sender_, SIGUSR1);
        }
        pollfd file{control_, POLLIN, 0};
        if (poll(&file, 1, kLook_ms) <= 0) {
            continue;
        }
        std::array<usb_gadgetfs_event, 5> events{};
        const ssize_t bytes = read(control_, events.data(), sizeof(events));
        for (std::size_t i = 0;
             bytes > 0 && i < static_cast<std::size_t>(bytes) / sizeof(events[0]); ++i) {
            if (events[i].type == GADGETFS_SETUP) {
                answer(events[i].u.setup);
            }
        }
    }
}

void UsbGadget::answer(const usb_ctrlrequest& request) {
    const bool to_host = (request.bRequestType & USB_DIR_IN) != 0;
    const bool is_standard = (request.bRequestType & USB_TYPE_MASK) == USB_TYPE_STANDARD;
    if (is_standard && request.bRequest == USB_REQ_SET_CONFIGURATION) {
        open_endpoint();
        (void)!read(control_, nullptr, 0);  // acknowledges it
        return;
    }
    Bytes data(to_host ? 0 : request.wLength);
    if (!data.empty() && read(control_, data.data(), data.size()) < 0) {
        return;  // the host has given it up
    }
    const std::optional<Bytes> answered = device_.answer(request, data);
    if (to_host) {
        if (answered) {
            const auto length = std::min<std::size_t>(answered->size(), request.wLength);
            (void)!write(control_, answered->data(), length);
        } else {
            (void)!read(control_, nullptr, 0);  // the wrong direction: a stall
        }
    } else if (data.empty()) {
        // What came with data is acknowledged already, and GadgetFS cannot refuse it.
        const std::uint8_t none = 0;
        (void)!(answered ? read(control_, nullptr, 0) : write(control_, &none, 0));
    }
}

void UsbGadget::open_endpoint() {
    if (endpoint_ >= 0) {
        return;
    }
    const std::string file = folder_ + "/" + device_.endpoint_file;
    const int fd = open(file.c_str(), O_RDWR | O_CLOEXEC);
    write_all(fd, tagged(1, {&device_.endpoint, &device_.endpoint}), file);
    endpoint_ = fd;
}

}  // namespace gazeloop::tests
