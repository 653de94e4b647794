#include "drivers/datagram/datagram_source.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <utility>

#include "runtime/time/clock.h"

namespace gazeloop::drivers::datagram {
namespace {

std::int64_t realtime_ns() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// When the kernel had it, in host time: it stamps by the wall clock, whose steps must not show. So
/// between `now_ns` and a second before it, else now.
std::int64_t arrival_ns(msghdr& header, std::int64_t now_ns) {
    constexpr std::int64_t kOldest_ns = 1'000'000'000;
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr;
         part = CMSG_NXTHDR(&header, part)) {
        if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SCM_TIMESTAMPNS) {
            timespec stamp{};
            std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
            const std::int64_t age_ns =
                realtime_ns() - (std::int64_t{stamp.tv_sec} * 1'000'000'000 + stamp.tv_nsec);
            return age_ns >= 0 && age_ns < kOldest_ns ? now_ns - age_ns : now_ns;
        }
    }
    return now_ns;
}

}  // namespace

Expected<Endpoint> parse_endpoint(std::string_view text) {
    Endpoint endpoint;
    const std::size_t colon = text.rfind(':');
    if (colon != std::string_view::npos) {
        endpoint.address = text.substr(0, colon);
        text.remove_prefix(colon + 1);
    }
    in_addr ignored{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, endpoint.port);
    if (error != std::errc{} || stop != end || endpoint.port == 0 ||
        inet_pton(AF_INET, endpoint.address.c_str(), &ignored) != 1) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  "gaze osc: give a port (1 to 65535), or an IPv4 address of this machine and a "
                  "port, e.g. osc:9020 or osc:0.0.0.0:9020"});
    }
    return endpoint;
}

DatagramSource::DatagramSource(const Endpoint& endpoint)
    : endpoint_(endpoint),
      socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(endpoint.port);
    inet_pton(AF_INET, endpoint.address.c_str(), &address.sin_addr);
    const int on = 1;
    if (socket_ < 0 || setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) != 0 ||
        bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        const int why = errno;
        if (socket_ >= 0) {
            ::close(socket_);
        }
        throw SetupError(ErrorKind::NoDevice,
                         fmt::format("gaze osc: port {} of {} cannot be had ({}): another program "
                                     "may listen there",
                                     endpoint.port, endpoint.address, std::strerror(why)));
    }
}

DatagramSource::~DatagramSource() { ::close(socket_); }

void DatagramSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    for (int taken = 0; taken < kMostAtOnce; ++taken) {
        iovec place{packet_.data(), packet_.size()};
        alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> control{};
        msghdr header{};
        header.msg_iov = &place;
        header.msg_iovlen = 1;
        header.msg_control = control.data();
        header.msg_controllen = control.size();
        const ssize_t size = recvmsg(socket_, &header, 0);
        if (size < 0) {
            break;  // nothing there; an error of another datagram is none of ours
        }
        const bool whole = (header.msg_flags & MSG_TRUNC) == 0;
        const auto bytes = std::span(packet_).first(whole ? static_cast<std::size_t>(size) : 0);
        if (auto sample = gaze_.take(bytes, arrival_ns(header, now_ns))) {
            samples.push_back(*sample);
        }
    }
    if (!told_first_ && gaze_.counts().packets > 0) {
        told_first_ = true;
        events_.push_back({{now_ns, time::StampKind::Measured}, "the first datagram came"});
    }
    if (!told_other_ && gaze_.counts().others > 0) {
        told_other_ = true;
        events_.push_back(
            {{now_ns, time::StampKind::Measured},
             fmt::format("messages of no use come, the first is {}: gazeloop's README "
                         "lists those that are taken",
                         gaze_.first_other())});
    }
    // Of a flood of them one line a thousand.
    if (gaze_.counts().damaged > 1000 * damaged_told_) {
        ++damaged_told_;
        events_.push_back({{now_ns, time::StampKind::Measured},
                           fmt::format("{} of {} datagrams are no OSC", gaze_.counts().damaged,
                                       gaze_.counts().packets)});
    }
}

std::vector<SourceEvent> DatagramSource::take_events() { return std::exchange(events_, {}); }

std::string DatagramSource::description() const {
    return fmt::format("OSC datagrams at {}:{} (when the eye was seen is unknown)",
                       endpoint_.address, endpoint_.port);
}

}  // namespace gazeloop::drivers::datagram
