#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gazeloop::bench {

struct MeasuredProgram {
    double seconds = 0.0;          ///< from start to end
    std::uint64_t peak_bytes = 0;  ///< most memory that it held at once, mapped files included
};

/// Runs a program, its output thrown away. The first word is its path. Throws std::runtime_error
/// unless it ends with 0.
MeasuredProgram measure_program(const std::vector<std::string>& command);

}  // namespace gazeloop::bench
