// Preloaded: GLFW has a gamepad. GAZELOOP_TEST_GAMEPAD names the button that somebody presses on it
// for a tenth of each half second, by its number.
#include <GLFW/glfw3.h>

#include <chrono>
#include <cstdlib>

extern "C" int glfwJoystickIsGamepad(int id) {
    return id == GLFW_JOYSTICK_3 ? GLFW_TRUE : GLFW_FALSE;
}

extern "C" int glfwGetGamepadState(int id, GLFWgamepadstate* state) {
    const char* const button = std::getenv("GAZELOOP_TEST_GAMEPAD");
    if (id != GLFW_JOYSTICK_3 || button == nullptr) {
        return GLFW_FALSE;
    }
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
    *state = {};
    state->buttons[std::atoi(button)] = ms % 500 < 100 ? GLFW_PRESS : GLFW_RELEASE;
    return GLFW_TRUE;
}
