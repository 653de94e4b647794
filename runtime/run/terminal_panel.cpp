#include "runtime/run/terminal_panel.h"

#include <poll.h>
#include <spdlog/sinks/sink.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "runtime/environment.h"

namespace gazeloop::run {
namespace {

/// In one call, so that a program that is killed leaves no half of it.
void write_all(const std::string& text) {
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t more = ::write(STDERR_FILENO, text.data() + done, text.size() - done);
        if (more <= 0) {
            return;  // the terminal has gone: there is nobody to tell
        }
        done += static_cast<std::size_t>(more);
    }
}

}  // namespace

/// Hands messages on to the sinks that were there before, above the panel.
class TerminalPanel::LogAbove final : public spdlog::sinks::sink {
  public:
    explicit LogAbove(TerminalPanel& panel) : panel_(panel) {}
    void log(const spdlog::details::log_msg& message) override {
        const std::lock_guard lock(panel_.mutex_);
        write_all(panel_.erasing());
        panel_.drawn_.clear();
        for (const auto& before : panel_.sinks_before_) {
            if (before->should_log(message.level)) {
                before->log(message);
                before->flush();
            }
        }
    }
    void flush() override {}
    void set_pattern(const std::string&) override {}  // the ones before have theirs
    void set_formatter(std::unique_ptr<spdlog::formatter>) override {}

  private:
    TerminalPanel& panel_;
};

bool TerminalPanel::possible() {
    return isatty(STDERR_FILENO) == 1 && environment_value("TERM").value_or("dumb") != "dumb";
}

bool TerminalPanel::wants_colour() { return !environment_value("NO_COLOR"); }

TerminalPanel::TerminalPanel() {
    auto& sinks = spdlog::default_logger()->sinks();
    sinks_before_ = std::exchange(sinks, {std::make_shared<LogAbove>(*this)});
}

TerminalPanel::~TerminalPanel() {
    erase();
    spdlog::default_logger()->sinks() = sinks_before_;
}

TerminalPanel::Size TerminalPanel::size() const {
    winsize window{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0 ||
        window.ws_row == 0) {
        return {};
    }
    return {window.ws_col, window.ws_row};
}

std::string TerminalPanel::erasing() const {
    // A terminal that has become narrower has broken the lines.
    const int columns = size().columns;
    int rows = 0;
    for (const int width : drawn_) {
        rows += std::max(1, (width + columns - 1) / columns);
    }
    return rows > 0 ? "\r\x1b[" + std::to_string(rows) + "A\x1b[J" : "";
}

void TerminalPanel::draw(const std::vector<std::string>& lines, const std::vector<int>& widths) {
    const std::lock_guard lock(mutex_);
    pollfd terminal{STDERR_FILENO, POLLOUT, 0};
    if (poll(&terminal, 1, 0) <= 0) {
        return;
    }
    std::string text = erasing();
    for (const std::string& line : lines) {
        text += line + "\r\n";
    }
    write_all(text);
    drawn_ = widths;
}

void TerminalPanel::erase() {
    const std::lock_guard lock(mutex_);
    write_all(erasing());
    drawn_.clear();
}

}  // namespace gazeloop::run
