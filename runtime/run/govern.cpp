#include "runtime/run/govern.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>
#include <vector>

#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/run/fitted_scale.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/settings/settings_for_now.h"

namespace gazeloop::run {
namespace {

constexpr std::string_view kByGovernor = "the governor";

/// What draws a level. Errors: no such method, a setting that is none of its own or does not hold.
Expected<render::MakePasses> passes_of(const governor::Level& level, ProgramSettings& settings) {
    settings::SettingsForNow now(settings);
    if (auto set = now.set("render.method", level.method, kByGovernor); !set) {
        return std::unexpected(set.error());
    }
    methods::MethodSettings any;
    std::vector<std::string> known;
    for (const settings::SettingRow& row : methods::rows_of(any)) {
        if (settings.is_in_use(row)) {
            known.push_back(row.key);
        }
    }
    for (const auto& [key, text] : level.settings) {
        if (std::ranges::find(known, key) == known.end()) {
            return std::unexpected(Error{
                ErrorKind::Usage, fmt::format("the method {} has no such setting: {}", level.method,
                                              settings::unknown_name("setting", key, known))});
        }
        if (auto set = now.set(key, text, kByGovernor); !set) {
            return std::unexpected(set.error());
        }
    }
    return methods::find_method(level.method)->passes(settings.values().methods, settings);
}

/// Why a run cannot be governed; empty: it can. `any_choice`: also one that is the built-in one.
std::string why_not(const ProgramSettings& settings, const FrameRunRequest& request,
                    bool any_choice) {
    const bool another = settings.values().render.method != render::RenderSettings().method;
    if (any_choice ? !settings.is_built_in("render.method") : another) {
        return settings.with_origin("render.method") + " chooses one";
    }
    return request.snapshot ? "a --snapshot shows the buffers of one" : "";
}

void check_use(const ProgramSettings& settings, const FrameRunRequest& request) {
    const std::string why = why_not(settings, request, false);
    if (!why.empty()) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("{}: the governor's front decides by which method a frame is "
                                     "drawn, and {}: leave one of the two out",
                                     settings.origin("governor.use"), why));
    }
}

/// What a headless run would draw with; a run over OpenXR has its runtime's choice.
std::unique_ptr<vulkan::Context> device_of(const ProgramSettings& settings) {
    return std::make_unique<vulkan::Context>(
        vulkan::ContextOptions{.validation = settings.values().vulkan.validation,
                               .device = settings.values().vulkan.device,
                               .device_origin = settings.origin("vulkan.device")},
        nullptr);
}

bool renders_in_software(const vulkan::Context& device) {
    return device.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
}

std::vector<double> costs_of(const governor::Front& front) {
    std::vector<double> ms;
    std::ranges::transform(front.levels, std::back_inserter(ms), &governor::Level::ms);
    return ms;
}

}  // namespace

std::unique_ptr<GovernedFrames> govern(ProgramSettings& settings, FrameRunRequest& request) {
    const governor::GovernorSettings& asked = settings.values().governor;
    const bool replay = request.clock == RunClock::Recorded;
    if (asked.use == "off" || request.chooser != nullptr || (replay && asked.use != "on")) {
        return nullptr;
    }
    std::unique_ptr<vulkan::Context> device;
    if (asked.use == "software" && !replay) {
        std::string why = why_not(settings, request, true);
        if (why.empty()) {
            device = device_of(settings);
            why = renders_in_software(*device) ? "" : "a GPU renders";
        }
        if (!why.empty()) {
            spdlog::info("no governor: {}", why);
            value_or_throw(settings.set("governor.use", "off", kByGovernor));
            return nullptr;
        }
        value_or_throw(settings.set("governor.use", "on", settings.origin("governor.use")));
    }
    if (replay && !asked.front.empty()) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("{}: frames are drawn by the levels that were recorded: leave "
                                     "it out, or replay the gaze with --clock wall",
                                     settings.with_origin("governor.front")));
    }
    if (!replay) {
        check_use(settings, request);
        value_or_throw(governor::take_front(asked, settings));
    }
    const governor::Front front = value_or_throw(governor::front_in_force(asked, settings));
    const governor::GovernorOptions options = value_or_throw(governor::options_of(asked, front));
    std::vector<render::MakePasses> passes;
    for (const governor::Level& level : front.levels) {
        auto made = passes_of(level, settings);
        if (!made) {
            throw SetupError(ErrorKind::BadInput,
                             fmt::format("{}: level '{}': {}", settings.origin("governor.levels"),
                                         level.text(), made.error().message));
        }
        passes.push_back(std::move(*made));
    }
    if (request.clock == RunClock::Wall && asked.fit_scale &&
        settings.is_built_in("render.scale")) {
        device = device ? std::move(device) : device_of(settings);
        fit_scale(*device, passes[passes.size() / 2], settings);
    }
    auto governed = std::make_unique<GovernedFrames>(asked, options, front.levels.size(), replay);
    request.chooser = governed.get();
    request.observer = governed.get();
    request.prepare_chooser = [governed = governed.get(), passes = std::move(passes),
                               ms = costs_of(front)](
                                  const FrameRunRequest::MakeRenderer& make,
                                  const FrameRunRequest::TimeRenderer& time_of) mutable {
        std::vector<std::unique_ptr<render::FrameRenderer>> renderers;
        for (std::size_t level = 0; level < passes.size(); ++level) {
            renderers.push_back(make(passes[level]));
            if (const auto here_ms = time_of(*renderers.back())) {
                ms[level] = *here_ms;
            }
        }
        governed->set_renderers(std::move(renderers), ms);
    };
    return governed;
}

std::optional<governor::Front> governed_front(std::span<const NamedValue> settings) {
    const auto text_of = [&](std::string_view key) {
        const auto found = std::ranges::find(settings, key, &NamedValue::name);
        return found == settings.end() ? std::string() : found->value;
    };
    const std::string levels = text_of("governor.levels");
    if (text_of("governor.use") != "on" || levels.empty()) {
        return std::nullopt;
    }
    return value_or_throw(governor::parse_front(levels));
}

}  // namespace gazeloop::run
