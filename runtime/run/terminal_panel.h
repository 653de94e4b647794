#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace spdlog::sinks {
class sink;
}

namespace gazeloop::run {

/// A few lines at the bottom of stderr's terminal that are drawn again in place. While one is
/// there, the program's log goes through it: a message takes the lines away, and they are drawn
/// below it the next time. The terminal's modes and its cursor are left as they are, so that there
/// is nothing to restore, however the program ends.
class TerminalPanel {
  public:
    struct Size {
        int columns = 80;
        int rows = 24;
    };

    /// Whether stderr is a terminal that can do this.
    [[nodiscard]] static bool possible();
    /// As the user wishes: NO_COLOR unset or empty (https://no-color.org).
    [[nodiscard]] static bool wants_colour();

    TerminalPanel();
    TerminalPanel(const TerminalPanel&) = delete;
    TerminalPanel& operator=(const TerminalPanel&) = delete;
    ~TerminalPanel();

    [[nodiscard]] Size size() const;

    /// Each line is `width` columns at most, and may have colours. Left out while the terminal
    /// takes nothing (Ctrl-S).
    void draw(const std::vector<std::string>& lines, const std::vector<int>& widths);
    void erase();

  private:
    class LogAbove;

    [[nodiscard]] std::string erasing() const;

    std::mutex mutex_;
    std::vector<int> drawn_;  ///< widths of the lines on the terminal
    std::vector<std::shared_ptr<spdlog::sinks::sink>> sinks_before_;
};

}  // namespace gazeloop::run
