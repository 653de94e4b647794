#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::drivers::hid {

/// An open /dev/hidrawN (linux/hidraw.h).
///
/// Without hidapi, each of whose calls would stand for one system call here: up to 0.13 its
/// hid_open_path() uses freed memory where a node does not answer HIDIOCGRDESCSIZE, which a tracker
/// that is pulled out just then does not, and it cannot be given a node that is open already.
class HidrawDevice {
  public:
    /// Errors (NoDevice): it cannot be opened, or is no HID device (any more).
    [[nodiscard]] static Expected<HidrawDevice> open(const std::string& path);
    HidrawDevice(HidrawDevice&& other) noexcept;
    HidrawDevice(const HidrawDevice&) = delete;
    HidrawDevice& operator=(HidrawDevice&&) = delete;
    HidrawDevice& operator=(const HidrawDevice&) = delete;
    ~HidrawDevice();

    /// Waits for an input report; its size with the id, 0 after the time. Errors (NoDevice): the
    /// device was unplugged, or failed.
    [[nodiscard]] Expected<std::size_t> read(std::span<std::uint8_t> report,
                                             std::chrono::milliseconds longest);

    /// A feature report of at most `payload_bytes` (and 16,383 bytes in all, which is what a
    /// request can say), id first; none where the device does not give it.
    [[nodiscard]] std::optional<std::vector<std::uint8_t>> feature(std::uint8_t id,
                                                                   std::size_t payload_bytes);
    /// Whether no other HidrawDevice, of any process, has this node open.
    [[nodiscard]] bool nobody_else_reads() const;

    /// Sends a feature report, id first. Errors (NoDevice): the device does not take it, or it
    /// is longer than 16,383 bytes.
    [[nodiscard]] Expected<void> send_feature(std::span<const std::uint8_t> report);

  private:
    HidrawDevice(std::string path, int fd) : path_(std::move(path)), fd_(fd) {}
    [[nodiscard]] std::unexpected<Error> error(const std::string& what) const;

    std::string path_;
    int fd_;  ///< -1: moved from
};

}  // namespace gazeloop::drivers::hid
