#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace gazeloop::present {

/// What somebody presses on a controller, whose buttons have other names on each kind: the first to
/// the fifth of what there is to choose from, or to go on.
enum class Button : std::uint8_t { First, Second, Third, Fourth, Fifth, GoOn };
inline constexpr std::size_t kButtonCount = 6;
inline constexpr std::array<std::string_view, kButtonCount> kButtonNames{
    "first", "second", "third", "fourth", "fifth", "go_on"};

/// A key by its character, or a button.
using Pressed = std::variant<char, Button>;

/// Where presses come from while a run goes on. Used on the loop's thread.
class ButtonSource {
  public:
    ButtonSource() = default;
    ButtonSource(const ButtonSource&) = delete;
    ButtonSource& operator=(const ButtonSource&) = delete;
    virtual ~ButtonSource() = default;

    /// Adds what was pressed since the last call, in its order. Never blocks.
    virtual void take(std::vector<Pressed>& pressed) = 0;
};

/// Tells presses from buttons that stay down. One that is down when it is first seen, or seen again
/// after forget(), was pressed for something else: it counts once it has been up.
class PressEdges {
  public:
    PressEdges() { forget(); }

    /// Whether the button has gone down since the last call for it.
    [[nodiscard]] bool pressed(Button button, bool down) {
        bool& was_down = down_[static_cast<std::size_t>(button)];
        const bool goes_down = down && !was_down;
        was_down = down;
        return goes_down;
    }
    void forget() { down_.fill(true); }

  private:
    std::array<bool, kButtonCount> down_{};
};

}  // namespace gazeloop::present
