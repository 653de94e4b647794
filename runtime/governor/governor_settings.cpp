#include "runtime/governor/governor_settings.h"

#include "runtime/governor/front_file.h"

namespace gazeloop::governor {

double GovernorSettings::budget_of(std::int64_t period_ns) const {
    constexpr double kNsPerMs = 1e6;
    return budget_ms > 0.0 ? budget_ms : budget_share * static_cast<double>(period_ns) / kNsPerMs;
}

std::vector<settings::SettingRow> rows_of(GovernorSettings& governor) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Number;
    using settings::Path;
    using settings::Whole;
    constexpr double kMostLoss = 1e6;
    const settings::OnlyWhile only{.key = "governor.use", .values = {"on", "software"}};
    return {
        {"governor.budget_ms", "what a frame may take, ms; 0: a share of the display's period",
         Number{&governor.budget_ms, 0.0, 1e5}, Concerns::Output, only},
        {"governor.budget_share", "that share", Number{&governor.budget_share, 0.05, 1.0},
         Concerns::Output, only},
        {"governor.fit_scale",
         "at the start, choose a render.scale that the middle level keeps the budget with, unless "
         "it is set",
         &governor.fit_scale, Concerns::Output, only},
        {"governor.floor", "greatest loss (the front's figure) in fixations; 0: the front's last",
         Number{&governor.floor, 0.0, kMostLoss}, Concerns::Output, only},
        {"governor.floor_blink", "the same in blinks",
         Number{&governor.floor_blink, 0.0, kMostLoss}, Concerns::Output, only},
        {"governor.floor_lost", "the same while the gaze is lost",
         Number{&governor.floor_lost, 0.0, kMostLoss}, Concerns::Output, only},
        {"governor.floor_saccade", "the same in saccades (needs gaze.events)",
         Number{&governor.floor_saccade, 0.0, kMostLoss}, Concerns::Output, only},
        {"governor.front", "the levels: a name, or a .toml file as gazeloop trade --front makes it",
         Path{&governor.front, ".toml"}, Concerns::Output, only},
        {"governor.levels", "the levels themselves: FIGURE;METHOD KEY=VALUE...,MS,LOSS;...",
         Choice{.value = &governor.levels}, Concerns::Picture, only},
        {"governor.patience_frames", "how long a better level waits for a saccade or a blink",
         Whole{&governor.patience_frames, 0, 1'000'000}, Concerns::Output, only},
        {"governor.settle_frames", "how long a better level must have had room",
         Whole{&governor.settle_frames, 2, 1'000'000}, Concerns::Output, only},
        {"governor.use",
         "keep frames within their budget by moving along a measured front: off, on, or where a "
         "processor renders and nothing chose the method",
         Choice{.value = &governor.use, .names = {"off", "on", "software"}}, Concerns::Picture},
    };
}

Expected<void> take_front(const GovernorSettings& governor, settings::Settings& all) {
    const std::string name = governor.front;
    if (name.empty() || (all.is_built_in("governor.front") && !governor.levels.empty())) {
        return {};
    }
    const auto front = all.at_origin("governor.front", load_front(name));
    if (!front) {
        return std::unexpected(front.error());
    }
    if (auto set = all.set("governor.levels", front_text(*front), name); !set) {
        return set;
    }
    return all.set("governor.front", "", "taken");
}

Expected<Front> front_in_force(const GovernorSettings& governor, const settings::Settings& all) {
    return all.at_origin("governor.levels", parse_front(governor.levels));
}

Expected<GovernorOptions> options_of(const GovernorSettings& governor, const Front& front) {
    const auto worst = worst_levels(
        front, {governor.floor, governor.floor_saccade, governor.floor_blink, governor.floor_lost});
    if (!worst) {
        return std::unexpected(worst.error());
    }
    return GovernorOptions{.settle_frames = static_cast<std::size_t>(governor.settle_frames),
                           .patience_frames = static_cast<std::size_t>(governor.patience_frames),
                           .worst = *worst};
}

}  // namespace gazeloop::governor
