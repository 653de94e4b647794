#pragma once

#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace gazeloop::trade {

/// How long equal pieces of work will still take, by those that are done.
class TimeLeft {
  public:
    explicit TimeLeft(std::size_t pieces) : left_(pieces) {}

    void done_one() {
        ++done_;
        --left_;
    }

    /// ", 12 s left" or ", 3 min left"; empty when nothing is left.
    [[nodiscard]] std::string text() const {
        if (left_ == 0 || done_ == 0) {
            return {};
        }
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun_;
        const double seconds =
            spent.count() / static_cast<double>(done_) * static_cast<double>(left_);
        constexpr double kMinute = 60.0;
        constexpr double kInSeconds = 100.0;
        return seconds < kInSeconds ? fmt::format(", {:.0f} s left", seconds)
                                    : fmt::format(", {:.0f} min left", seconds / kMinute);
    }

  private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    std::size_t done_ = 0;
    std::size_t left_;
};

}  // namespace gazeloop::trade
