#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

struct _XDisplay;  // NOLINT(bugprone-reserved-identifier): X's own name

namespace gazeloop::tests {

/// An X server of its own that shows nothing (Xvfb).
class XServer {
  public:
    XServer();
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;
    ~XServer() { end(); }

    /// For DISPLAY; empty where Xvfb is not installed or did not start.
    [[nodiscard]] const std::string& name() const { return name_; }
    void end();

  private:
    pid_t pid_ = -1;
    std::string name_;
};

/// What is on a window, row by row from the top.
struct Screenshot {
    int width = 0;
    int height = 0;
    std::vector<std::array<std::uint8_t, 3>> pixels;
};

/// The only window of a server that has a title, as somebody sees it who sits there.
class SeenWindow {
  public:
    explicit SeenWindow(const XServer& server);
    SeenWindow(const SeenWindow&) = delete;
    SeenWindow& operator=(const SeenWindow&) = delete;
    ~SeenWindow();

    /// Waits for a window that is shown, and for its title to contain `part`. Returns the title;
    /// empty after half a minute.
    std::string wait_for_title(const std::string& part);
    [[nodiscard]] Screenshot screenshot() const;
    void press(char key);
    void resize(int width, int height) const;
    /// As the frame's close button does.
    void close() const;

  private:
    std::string find(const std::string& part);

    _XDisplay* display_ = nullptr;
    unsigned long window_ = 0;
    unsigned long key_time_ = 0;
};

}  // namespace gazeloop::tests
