#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::sim {

/// A HID device that is real to the kernel, made through /dev/uhid. The destructor removes it.
class UhidDevice {
  public:
    struct Identity {
        std::string name;
        std::uint16_t vendor = 0;
        std::uint16_t product = 0;
    };
    struct Answers {
        /// A feature report, id first; none if there is none of that id.
        std::function<std::optional<std::vector<std::uint8_t>>(std::uint8_t id)> get_feature;
        std::function<void(std::span<const std::uint8_t> report)> set_feature;
    };

    /// Errors (NoDevice): there is no /dev/uhid, it may not be opened, or the kernel refuses the
    /// descriptor; with the remedy. `path` is for tests.
    [[nodiscard]] static Expected<UhidDevice> create(const Identity& identity,
                                                     std::span<const std::uint8_t> descriptor,
                                                     Answers answers,
                                                     const std::string& path = "/dev/uhid");
    UhidDevice(UhidDevice&& other) noexcept;
    UhidDevice(const UhidDevice&) = delete;
    UhidDevice& operator=(UhidDevice&&) = delete;
    UhidDevice& operator=(const UhidDevice&) = delete;
    ~UhidDevice();

    /// Sends an input report, id first. Errors (NoDevice): the kernel does not take it.
    [[nodiscard]] Expected<void> send(std::span<const std::uint8_t> report);

    /// Answers what the kernel asks for this long, or until a signal comes and `stop` says so.
    void answer_for(std::chrono::nanoseconds time, const std::function<bool()>& stop);

  private:
    UhidDevice(int fd, Answers answers) : fd_(fd), answers_(std::move(answers)) {}
    /// False where the kernel asks nothing any more.
    bool answer();

    int fd_;
    Answers answers_;
};

}  // namespace gazeloop::sim
