#include "sim/uhid_device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace gazeloop::sim {
namespace {

std::unexpected<Error> no_device(const std::string& message) {
    return std::unexpected(Error{ErrorKind::NoDevice, message});
}

bool write_event(int fd, const uhid_event& event) {
    return write(fd, &event, sizeof(event)) == static_cast<ssize_t>(sizeof(event));
}

}  // namespace

Expected<UhidDevice> UhidDevice::create(const Identity& identity,
                                        std::span<const std::uint8_t> descriptor, Answers answers,
                                        const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) {
        const int why = errno;
        return no_device(fmt::format(
            "{}: {}: a virtual tracker needs it; {}", path, std::generic_category().message(why),
            why == EACCES
                ? "run this as root"
                : "as root, modprobe uhid (containers and some cloud kernels have none)"));
    }
    UhidDevice device(fd, std::move(answers));
    uhid_event event{};
    event.type = UHID_CREATE2;
    uhid_create2_req& request = event.u.create2;
    std::memcpy(request.name, identity.name.data(),
                std::min(identity.name.size(), sizeof(request.name) - 1));
    request.bus = BUS_VIRTUAL;
    request.vendor = identity.vendor;
    request.product = identity.product;
    request.rd_size =
        static_cast<std::uint16_t>(std::min(descriptor.size(), sizeof(request.rd_data)));
    std::memcpy(request.rd_data, descriptor.data(), request.rd_size);
    if (!write_event(fd, event)) {
        return no_device(fmt::format("{}: the kernel does not make the device: {}", path,
                                     std::generic_category().message(errno)));
    }
    return device;
}

UhidDevice::UhidDevice(UhidDevice&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), answers_(std::move(other.answers_)) {}

UhidDevice::~UhidDevice() {
    if (fd_ >= 0) {
        ::close(fd_);  // which destroys the device
    }
}

Expected<void> UhidDevice::send(std::span<const std::uint8_t> report) {
    uhid_event event{};
    event.type = UHID_INPUT2;
    event.u.input2.size =
        static_cast<std::uint16_t>(std::min(report.size(), sizeof(event.u.input2.data)));
    std::memcpy(event.u.input2.data, report.data(), event.u.input2.size);
    if (!write_event(fd_, event)) {
        return no_device(fmt::format("the virtual tracker: the kernel does not take a report: {}",
                                     std::generic_category().message(errno)));
    }
    return {};
}

void UhidDevice::answer_for(std::chrono::nanoseconds time, const std::function<bool()>& stop) {
    const auto until = std::chrono::steady_clock::now() + time;
    int asking = fd_;
    for (auto left = time; left.count() > 0; left = until - std::chrono::steady_clock::now()) {
        pollfd file{asking, POLLIN, 0};
        const timespec wait{left.count() / 1'000'000'000, left.count() % 1'000'000'000};
        const int ready = ppoll(&file, 1, &wait, nullptr);
        if (ready < 0 && stop()) {
            return;
        }
        const bool asked = ready > 0 && (file.revents & POLLIN) != 0;
        if (ready > 0 && (!asked || !answer())) {
            asking = -1;  // which poll() passes over: only the time is left to wait for
        }
    }
}

bool UhidDevice::answer() {
    uhid_event event{};
    const ssize_t bytes = read(fd_, &event, sizeof(event));
    if (bytes <= 0) {
        return bytes < 0 && (errno == EAGAIN || errno == EINTR);
    }
    uhid_event reply{};
    switch (event.type) {
        case UHID_GET_REPORT: {
            reply.type = UHID_GET_REPORT_REPLY;
            uhid_get_report_reply_req& answer = reply.u.get_report_reply;
            answer.id = event.u.get_report.id;
            const auto report = event.u.get_report.rtype == UHID_FEATURE_REPORT
                                    ? answers_.get_feature(event.u.get_report.rnum)
                                    : std::nullopt;
            answer.err = report ? 0 : EIO;
            if (report) {
                answer.size =
                    static_cast<std::uint16_t>(std::min(report->size(), sizeof(answer.data)));
                std::memcpy(answer.data, report->data(), answer.size);
            }
            (void)write_event(fd_, reply);
            break;
        }
        case UHID_SET_REPORT: {
            const uhid_set_report_req& request = event.u.set_report;
            const std::size_t size = std::min<std::size_t>(request.size, sizeof(request.data));
            if (request.rtype == UHID_FEATURE_REPORT) {
                answers_.set_feature({request.data, size});
            }
            reply.type = UHID_SET_REPORT_REPLY;
            reply.u.set_report_reply.id = request.id;
            (void)write_event(fd_, reply);
            break;
        }
        default:
            break;
    }
    return true;
}

}  // namespace gazeloop::sim
