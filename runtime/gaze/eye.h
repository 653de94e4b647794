#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace gazeloop::gaze {

/// The order of views in OpenXR's primary stereo configuration; also the index into PerEye.
enum class Eye : std::size_t { Left = 0, Right = 1 };

inline constexpr std::size_t kEyeCount = 2;
inline constexpr std::array<Eye, kEyeCount> kEyes{Eye::Left, Eye::Right};
inline constexpr std::array<std::string_view, kEyeCount> kEyeNames{"left", "right"};

template <typename T>
using PerEye = std::array<T, kEyeCount>;

[[nodiscard]] constexpr std::size_t index(Eye eye) { return static_cast<std::size_t>(eye); }
[[nodiscard]] constexpr Eye other(Eye eye) { return eye == Eye::Left ? Eye::Right : Eye::Left; }

}  // namespace gazeloop::gaze
