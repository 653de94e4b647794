#include "runtime/run/study_request.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "runtime/methods/registry.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/settings/settings_for_now.h"

namespace gazeloop::run {
namespace {

constexpr std::string_view kOrigin = "the study's plan";
constexpr std::size_t kLongestSettings = 240;  // what a session's row holds

/// The passes of a stimulus, whose settings are `now`'s from then on. Errors: as Settings::set()
/// and the method's.
Expected<render::MakePasses> passes_of(const study::Stimulus& stimulus,
                                       const ProgramSettings& settings,
                                       settings::SettingsForNow& now) {
    if (auto set = now.set("render.method", stimulus.method, kOrigin); !set) {
        return std::unexpected(set.error());
    }
    for (const auto& [key, value] : stimulus.settings) {
        if (auto set = now.set(key, value, kOrigin); !set) {
            return std::unexpected(set.error());
        }
    }
    return methods::find_method(stimulus.method)->passes(settings.values().methods, settings);
}

/// Whether a factor's setting is one of the method's.
Expected<void> check_factor(const study::Plan& plan, const study::Factor& factor,
                            ProgramSettings& settings) {
    if (auto set = settings::SettingsForNow(settings).set("render.method", plan.method, kOrigin);
        !set) {
        return set;
    }
    methods::MethodSettings any;
    std::vector<std::string> known;
    for (const settings::SettingRow& row : methods::rows_of(any)) {
        if (methods::is_setting_of(row, *methods::find_method(plan.method))) {
            known.push_back(row.key);
        }
    }
    if (study::is_of_all_methods(factor.key)) {
        return {};
    }
    if (std::ranges::find(known, factor.key) == known.end()) {
        return std::unexpected(Error{
            ErrorKind::Usage, fmt::format("{}: factor {}: the method {} has no such setting: {}",
                                          plan.name, factor.name, plan.method,
                                          settings::unknown_name("setting", factor.key, known))});
    }
    return {};
}

template <typename Study>
void show(Study& study, ProgramSettings& settings, FrameRunRequest& request) {
    if (request.snapshot) {
        throw SetupError(ErrorKind::Usage,
                         "--snapshot: a study's pictures are drawn by several methods: leave it "
                         "out, or look at one with gazeloop run");
    }
    request.chooser = &study;
    request.many_pictures = true;
    request.prepare_chooser = [&](const FrameRunRequest::MakeRenderer& make,
                                  const FrameRunRequest::TimeRenderer& /*time_of*/) {
        study.set_stimuli(std::make_unique<study::Stimuli>(
            [make, &settings](const study::Stimulus& stimulus) {
                settings::SettingsForNow now(settings);
                return make(value_or_throw(passes_of(stimulus, settings, now)));
            },
            study.samples()));
    };
}

}  // namespace

Expected<void> take_plan(const study::Plan& plan, ProgramSettings& settings) {
    // What draws a scene is made at the start, and stays on the device.
    constexpr std::size_t kMostScenes = 16;
    for (const study::Factor& factor : plan.factors) {
        if (factor.key == "render.scene" && factor.levels.size() > kMostScenes) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("{}: factor {}: {} scenes are more than {}", plan.name,
                                  factor.name, factor.levels.size(), kMostScenes)});
        }
        if (factor.key.empty() && factor.levels.size() > 1) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("{}: factor {}: key is empty, and what its levels mean is "
                                  "nothing that this program can show: name a setting, or leave "
                                  "one level",
                                  plan.name, factor.name)});
        }
        if (factor.key.empty()) {
            continue;
        }
        if (auto checked = check_factor(plan, factor, settings); !checked) {
            return checked;
        }
    }
    for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
        const study::Trial trial{.levels = plan.levels_of(cell)};
        for (const study::Stimulus& stimulus :
             {study::reference_stimulus(plan, trial),
              study::test_stimulus(plan, trial, trial.levels.front())}) {
            settings::SettingsForNow now(settings);
            if (auto passes = passes_of(stimulus, settings, now); !passes) {
                return std::unexpected(passes.error());
            }
            const std::string text = stimulus.settings_text();
            const auto blank = [](const auto& one) { return one.second.contains(' '); };
            if (text.size() > kLongestSettings || std::ranges::any_of(stimulus.settings, blank)) {
                return std::unexpected(
                    Error{ErrorKind::Usage,
                          fmt::format("{}: settings of a picture that are longer than {} bytes, or "
                                      "have blanks, cannot be recorded with it: {}",
                                      plan.name, kLongestSettings, text)});
            }
        }
    }
    return settings.set("render.method", plan.reference_method, kOrigin);
}

void show_study(study::StudyRun& study, ProgramSettings& settings, FrameRunRequest& request) {
    show(study, settings, request);
    request.observer = &study;
    request.record_study = [&study](session::SessionRecorder& recorder) {
        study.set_recorder(&recorder);
    };
    request.loop.end_with_source = false;
    request.loop.stop = [&study]() -> std::optional<LoopEnd> {
        return study.over() || study.too_slow() || study.cannot_keep() || study.nobody_answers()
                   ? std::optional(LoopEnd::Limit)
                   : std::nullopt;
    };
}

void show_study(study::ReplayedStudy& study, ProgramSettings& settings, FrameRunRequest& request) {
    show(study, settings, request);
}

}  // namespace gazeloop::run
