#pragma once

#include <cstdint>
#include <string_view>

namespace gazeloop::openxr_layer {

enum class LogLevel : std::uint8_t { Info, Warning };

/// One line for whoever looks for what the layer does in a program that is not ours: into
/// layer.log among the user's state (mode 0600), warnings also to stderr. The same text is said
/// once in a process. Never throws.
void say(LogLevel level, std::string_view text) noexcept;

/// The same each time: that a program begins to read gaze, or may no more. Never throws.
void note(LogLevel level, std::string_view text) noexcept;

/// What was said is forgotten, with its memory: the library is unloaded.
void forget_said() noexcept;

}  // namespace gazeloop::openxr_layer
