#pragma once

#include <cstddef>

namespace gazeloop::sim {

/// Room for as many events as usually come in ten minutes, so that these allocate nothing while a
/// frame loop runs. Later ones grow the memory as a vector does.
[[nodiscard]] inline std::size_t room_for_plans(double events_per_s) {
    constexpr double kSeconds = 600.0;
    constexpr double kMoreThanUsual = 1.25;
    return static_cast<std::size_t>(kSeconds * kMoreThanUsual * events_per_s);
}

}  // namespace gazeloop::sim
