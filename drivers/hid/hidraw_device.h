#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/error.h"

struct hid_device_;

namespace gazeloop::drivers::hid {

/// Why a request for, or of, a feature report came to nothing.
struct RequestFailure {
    enum class Why : std::uint8_t {
        Refused,     ///< the device does not know it, or does not want to
        Unanswered,  ///< nothing came until the kernel gave up: 5 s on Linux
        NotMade,     ///< others before it went unanswered
    };
    Why why = Why::Refused;
    double seconds = 0.0;  ///< that it took

    friend bool operator==(const RequestFailure&, const RequestFailure&) = default;
};

/// An open /dev/hidrawN, through hidapi's hidraw backend. Two faults of its open are worked around.
/// Up to 0.13 it uses freed memory where a node does not answer HIDIOCGRDESCSIZE. And it keeps its
/// last error in a global variable. So we open and ask the node ourselves first, keep it open, and
/// let one thread open at a time. One case remains: a tracker that is pulled out in the
/// microseconds between the two questions. From 0.14 on that is an error like any other.
///
/// One thread may make requests while another reads: they go through our own file descriptor.
class HidrawDevice {
  public:
    /// Errors (NoDevice): it cannot be opened, or is no HID device (any more).
    [[nodiscard]] static Expected<HidrawDevice> open(const std::string& path);

    /// Waits for an input report; gives its size with the id, or 0 when the time is over. Errors
    /// (NoDevice): the device was unplugged, or failed.
    [[nodiscard]] Expected<std::size_t> read(std::span<std::uint8_t> report,
                                             std::chrono::milliseconds longest);

    /// A feature report of at most `payload_bytes` (and 16,383 bytes in all, the most that a
    /// request can state), id first.
    [[nodiscard]] std::expected<std::vector<std::uint8_t>, RequestFailure> feature(
        std::uint8_t id, std::size_t payload_bytes);
    /// Whether no other HidrawDevice, of any process, has this node open.
    [[nodiscard]] bool nobody_else_reads() const;

    /// Sends a feature report, id first; refused, too, where it is longer than 16,383 bytes.
    [[nodiscard]] std::expected<void, RequestFailure> send_feature(
        std::span<const std::uint8_t> report);

  private:
    /// A file descriptor of our own on the node, asked first and locked; hidapi cannot be given
    /// one.
    class Node {
      public:
        explicit Node(const std::string& path);
        Node(Node&& other) noexcept;
        Node(const Node&) = delete;
        Node& operator=(Node&&) = delete;
        Node& operator=(const Node&) = delete;
        ~Node();
        [[nodiscard]] int fd() const { return fd_; }

      private:
        int fd_;  ///< -1: it could not be opened, or was moved from
    };
    struct Close {
        void operator()(hid_device_* device) const;
    };

    HidrawDevice(std::string path, Node node) : path_(std::move(path)), node_(std::move(node)) {}
    [[nodiscard]] std::unexpected<Error> error(const std::string& what) const;

    std::string path_;
    Node node_;
    std::unique_ptr<hid_device_, Close> device_;
};

}  // namespace gazeloop::drivers::hid
