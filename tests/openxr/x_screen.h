#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/background_process.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {

/// A picture in memory: 8 bits per channel, RGB, top row first.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 3>> pixels{};

    [[nodiscard]] const std::array<std::uint8_t, 3>& at(std::uint32_t x, std::uint32_t y) const {
        return pixels[std::size_t{y} * width + x];
    }
};

/// An X server whose screen nobody sees (Xvfb).
class XScreen {
  public:
    explicit XScreen(const ScratchFolder& scratch);

    [[nodiscard]] bool ready() const { return !number_.empty(); }
    [[nodiscard]] BackgroundProcess& process() { return process_; }
    /// The value of DISPLAY for programs that are to show themselves there.
    [[nodiscard]] std::string display() const;
    /// The top left corner of what is shown now; nothing where the server does not answer.
    [[nodiscard]] std::optional<Image> capture(std::uint16_t width, std::uint16_t height) const;

  private:
    BackgroundProcess process_;
    std::string number_;  ///< of the display; empty if the server did not start
};

}  // namespace gazeloop::tests
