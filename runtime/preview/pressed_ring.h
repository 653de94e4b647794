#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "runtime/present/button_source.h"

namespace gazeloop::preview {

/// Presses on their way from the window's process to the loop's, which share it. One writes, one
/// reads; neither waits. Who reads too late gets the last kPlaces.
struct PressedRing {
    static constexpr std::uint32_t kPlaces = 64;
    static constexpr std::uint8_t kFirstButton = 0x80;  ///< below: a key's character

    std::atomic<std::uint32_t> count{0};  ///< presses so far
    std::array<std::atomic<std::uint8_t>, kPlaces> codes{};

    void add(std::uint8_t code) {
        const std::uint32_t at = count.load(std::memory_order_relaxed);
        codes[at % kPlaces].store(code, std::memory_order_relaxed);
        count.store(at + 1, std::memory_order_release);
    }
    void add(present::Button button) {
        add(static_cast<std::uint8_t>(kFirstButton + static_cast<std::uint8_t>(button)));
    }
};
static_assert(std::atomic<std::uint8_t>::is_always_lock_free);
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

/// The loop's end of it.
class PressedReader final : public present::ButtonSource {
  public:
    /// The ring must outlive this.
    explicit PressedReader(const PressedRing& ring) : ring_(ring) {}

    void take(std::vector<present::Pressed>& pressed) override {
        const std::uint32_t count = ring_.count.load(std::memory_order_acquire);
        if (count - taken_ > PressedRing::kPlaces) {
            taken_ = count - PressedRing::kPlaces;
        }
        for (; taken_ != count; ++taken_) {
            const std::uint8_t code =
                ring_.codes[taken_ % PressedRing::kPlaces].load(std::memory_order_relaxed);
            if (code < PressedRing::kFirstButton) {
                pressed.emplace_back(static_cast<char>(code));
            } else if (code < PressedRing::kFirstButton + present::kButtonCount) {
                pressed.emplace_back(
                    static_cast<present::Button>(code - PressedRing::kFirstButton));
            }
        }
    }

  private:
    const PressedRing& ring_;
    std::uint32_t taken_ = 0;
};

}  // namespace gazeloop::preview
