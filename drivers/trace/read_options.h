#pragma once

#include <cstdint>
#include <string>

namespace gazeloop::drivers {

/// How a trace's directions are to be turned before they are used.
enum class AxesCorrection : std::uint8_t {
    None,
    MirrorX,   ///< "-x": left and right are exchanged in directions, places or both
    SwapEyes,  ///< "swap-eyes": the left eye's columns are the right eye's
    MirrorZ,   ///< "-z": every direction points behind
    MirrorXZ,  ///< "-x-z": and left and right are exchanged: turned by half a turn
};

/// What the user says about a trace.
struct ReadOptions {
    std::string format = "auto";  ///< "auto", or a format's name
    AxesCorrection axes = AxesCorrection::None;
    /// Also read a file of which much was dropped or changed.
    bool accept_repairs = false;
    /// A longer time without rows is played this long, s, (0, 1e6].
    double longest_gap_s = 10.0;
};

}  // namespace gazeloop::drivers
