#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/error.h"

struct hid_device_;

namespace gazeloop::drivers::hid {

/// An open /dev/hidrawN, through hidapi.
class HidrawDevice {
  public:
    /// Errors (NoDevice): it cannot be opened, or is no HID device (any more).
    ///
    /// hidapi up to 0.13 uses freed memory where a node does not answer HIDIOCGRDESCSIZE, so that
    /// the node is asked before it is opened with it, and kept open meanwhile.
    [[nodiscard]] static Expected<HidrawDevice> open(const std::string& path);

    /// Waits for an input report; its size with the id, 0 after the time. Errors (NoDevice): the
    /// device was unplugged, or failed.
    [[nodiscard]] Expected<std::size_t> read(std::span<std::uint8_t> report,
                                             std::chrono::milliseconds longest);

    /// A feature report of at most `payload_bytes`, id first; none where the device does not give
    /// it.
    [[nodiscard]] std::optional<std::vector<std::uint8_t>> feature(std::uint8_t id,
                                                                   std::size_t payload_bytes);
    /// Sends a feature report, id first. Errors (NoDevice): the device does not take it.
    [[nodiscard]] Expected<void> send_feature(std::span<const std::uint8_t> report);

  private:
    struct Close {
        void operator()(hid_device_* device) const;
    };
    explicit HidrawDevice(std::string path, hid_device_* device)
        : path_(std::move(path)), device_(device) {}
    [[nodiscard]] std::unexpected<Error> error(const std::string& what) const;

    std::string path_;
    std::unique_ptr<hid_device_, Close> device_;
};

}  // namespace gazeloop::drivers::hid
