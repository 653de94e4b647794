#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/command_line/command_line.h"
#include "runtime/quality/comparison.h"

namespace gazeloop::cli {

/// The options of the commands that compare pictures.
struct QualityOptions {
    std::vector<std::string> metrics;
    quality::DisplayLight light;
    std::uint64_t threads = 0;
    std::string eye = "left";
    std::string gaze = "0,0";  ///< see recordings::ComparedGaze::parse

    /// `gazes` (which must live until the command line is parsed): --gaze may be repeated, and goes
    /// there instead.
    std::vector<Option> add_to(Command command, std::vector<std::string>* gazes = nullptr);

    /// Throws SetupError (Usage) for a metric that there is not.
    [[nodiscard]] quality::MetricChoice metric_choice() const {
        return value_or_throw(quality::metrics_named(metrics));
    }
    [[nodiscard]] quality::ContrastOptions contrast() const {
        return {.light = light, .threads = static_cast<unsigned>(threads)};
    }
    [[nodiscard]] gaze::Eye which_eye() const {
        return eye == "left" ? gaze::Eye::Left : gaze::Eye::Right;
    }
};

}  // namespace gazeloop::cli
