#include "runtime/preview/gamepads.h"

#include <GLFW/glfw3.h>

namespace gazeloop::preview {
namespace {

/// By Button.
constexpr std::array<int, present::kButtonCount> kGamepadButtons{GLFW_GAMEPAD_BUTTON_A,
                                                                 GLFW_GAMEPAD_BUTTON_B,
                                                                 GLFW_GAMEPAD_BUTTON_X,
                                                                 GLFW_GAMEPAD_BUTTON_Y,
                                                                 GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER,
                                                                 GLFW_GAMEPAD_BUTTON_START};

}  // namespace

void Gamepads::take(PressedRing& ring) {
    static_assert(GLFW_JOYSTICK_LAST + 1 == kMost);
    for (std::size_t pad = 0; pad < kMost; ++pad) {
        GLFWgamepadstate state{};
        const int id = static_cast<int>(pad);
        if (glfwJoystickIsGamepad(id) == GLFW_FALSE ||
            glfwGetGamepadState(id, &state) == GLFW_FALSE) {
            edges_[pad].forget();
            continue;
        }
        for (std::size_t button = 0; button < present::kButtonCount; ++button) {
            const auto which = static_cast<present::Button>(button);
            if (edges_[pad].pressed(which, state.buttons[kGamepadButtons[button]] == GLFW_PRESS)) {
                ring.add(which);
            }
        }
    }
}

}  // namespace gazeloop::preview
