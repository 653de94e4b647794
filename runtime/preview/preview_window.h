#pragma once

#include <string_view>

namespace gazeloop::preview {

/// How the window's process is told what it is: its command, and the descriptors it inherits.
inline constexpr const char* kWindowCommand = "preview-window";
inline constexpr int kWindowMemoryFd = 3;
inline constexpr int kWindowSocketFd = 4;
/// What it says on the socket when its window can be drawn to; anything else is why it cannot.
inline constexpr std::string_view kWindowIsOpen = "open\n";

/// What the window's keys do, for --help.
inline constexpr const char* kWindowKeys =
    "1, 2, 3 left, right, both; f fovea ring; b stage bars; Esc or q end the run";

/// The window's process: shows what PreviewMemory gives, at its own pace, until it is closed or the
/// loop's process ends. Returns the exit code: 0 when the user closed it.
int preview_window();

}  // namespace gazeloop::preview
