#pragma once

#include <string_view>

namespace gazeloop::drivers {

/// Takes a line, from any thread, without its end. Must not throw.
using LastWords = void (*)(std::string_view) noexcept;

/// Where goes what a device has to say while it is closed, when nobody takes its source's events
/// any more: a program's log. Until a program says where, onto stderr, never stdout: this may be a
/// guest in somebody else's program.
void set_last_words(LastWords say) noexcept;
void say_last_words(std::string_view line) noexcept;

}  // namespace gazeloop::drivers
