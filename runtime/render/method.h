#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gazeloop::render {

/// Which samples a picture takes.
enum class Method : std::uint8_t {
    Full,    ///< every pixel
    Kfr,     ///< kernel foveated rendering (Meng et al. 2018), variant B
    Acuity,  ///< the log-polar map that the display and a MAR line ask for, in the gaze's frame
};
inline constexpr std::array<std::string_view, 3> kMethodNames{"full", "kfr", "acuity"};

[[nodiscard]] constexpr std::string_view name(Method method) {
    return kMethodNames[static_cast<std::size_t>(method)];
}

/// Scenes by the name of their file in shaders/scenes.
inline constexpr std::array<std::string_view, 1> kSceneNames{"raymarch"};

}  // namespace gazeloop::render
