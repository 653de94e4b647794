#pragma once

#include <array>

#include "runtime/preview/pressed_ring.h"

namespace gazeloop::preview {

/// The game controllers of this machine, as GLFW knows them: those whose buttons it can name.
/// A, B, X, Y and the right shoulder are the first to the fifth choice, start goes on.
class Gamepads {
  public:
    /// Adds what has been pressed since the last call. Precondition: glfwInit() has been called.
    void take(PressedRing& ring);

  private:
    static constexpr std::size_t kMost = 16;  ///< GLFW's

    std::array<present::PressEdges, kMost> edges_{};
};

}  // namespace gazeloop::preview
