#pragma once

#include <sys/types.h>

#include <cstdint>

#include "runtime/preview/preview_memory.h"

namespace gazeloop::preview {

/// What has become of the window.
enum class WindowState {
    Open,
    Closed,  ///< by the user
    Broken,  ///< it ended in any other way: the display went away, a driver crashed
};

/// The preview's window, in a process of its own: this program again, run as `preview-window`. So
/// the loop is safe from what happens to a display: waiting for its refresh, a server that ends its
/// clients, a library that changes the locale.
class WindowProcess {
  public:
    /// Starts it and waits until its window can be drawn to. `eyes`: see PreviewMemory. Throws
    /// SetupError (NoDevice), naming the remedy, where there is no display.
    explicit WindowProcess(std::uint32_t eyes);
    WindowProcess(const WindowProcess&) = delete;
    WindowProcess& operator=(const WindowProcess&) = delete;
    /// Closes the window.
    ~WindowProcess();

    [[nodiscard]] PreviewMemory& memory() { return *memory_; }

    /// Never blocks.
    [[nodiscard]] WindowState state();

  private:
    void start(int memory);
    void wait_until_open();
    void end();

    PreviewMemory* memory_ = nullptr;
    int socket_ = -1;
    pid_t pid_ = -1;
    WindowState state_ = WindowState::Open;
};

}  // namespace gazeloop::preview
