#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "runtime/methods/method.h"
#include "runtime/methods/registry.h"
#include "runtime/render/passes/interleaved_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) {
    return rows_of(values.interleaved);
}

/// The method whose texels take turns.
const Method& whole() { return *find_method("kfr"); }

/// Those by which the method whose texels take turns is made: the LP-buffer is tall where nobody
/// says how tall. What foveated contrast is lost to columns is a fraction of what is lost to rows.
MethodSettings of_whole(const MethodSettings& values) {
    constexpr double kTall = 0.35;
    MethodSettings tall = values;
    if (tall.kfr.aspect == 0.0) {
        tall.kfr.aspect = kTall;
    }
    return tall;
}

/// Precondition: one of the choices.
foveation::CellTurns turns(const std::string& every) {
    foveation::CellTurns turns;
    std::from_chars(every.data(), every.data() + every.size(), turns.every);
    return turns;
}

/// Precondition: one of the choices.
render::InterleavedConfig::Sharp sharp_of(const std::string& name) {
    const auto& names = render::InterleavedConfig::kSharpNames;
    return static_cast<render::InterleavedConfig::Sharp>(std::ranges::find(names, name) -
                                                         names.begin());
}

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const MethodSettings tall = of_whole(subject.values);
    auto planned = whole().plan({.values = tall,
                                 .settings = subject.settings,
                                 .field = subject.field,
                                 .line = subject.line});
    if (!planned) {
        return planned;
    }
    const InterleavedSettings& set = subject.values.interleaved;
    double texels = 0.0;
    double pixels = 0.0;
    for (const PlanFigure& figure : planned->figures) {
        texels = figure.name == "texels_shaded" ? figure.value : texels;
        pixels = figure.name == "disc_pixels" ? figure.value : pixels;
    }
    planned->parameters +=
        fmt::format(", 1 of {} texels a frame, 1 of {} pixels", set.every, set.disc_every);
    planned->samples = static_cast<std::uint64_t>(texels / turns(set.every).every +
                                                  pixels / turns(set.disc_every).every);
    return planned;
}

Expected<void> check_picture(const MethodSettings& values, const settings::Settings& settings,
                             foveation::ImageSize image) {
    const MethodSettings tall = of_whole(values);
    return whole().check_picture(tall, settings, image);
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& settings) {
    const MethodSettings tall = of_whole(values);
    const InterleavedSettings& set = values.interleaved;
    const render::InterleavedConfig config{.texels = turns(set.every),
                                           .pixels = turns(set.disc_every),
                                           .visits = static_cast<std::uint32_t>(set.visits),
                                           .jitter = set.jitter,
                                           .follow = set.follow,
                                           .hold = set.hold,
                                           .sharp = sharp_of(set.sharp),
                                           .refill = set.refill};
    auto kfr = parameters(tall.kfr, settings);
    if (!kfr) {
        return std::unexpected(kfr.error());
    }
    return [config, kfr = *std::move(kfr)](const render::PassSetup& setup) {
        return render::make_interleaved_passes(setup, config, kfr);
    };
}

}  // namespace

Method interleaved_method() {
    return {.name = "interleaved",
            .description = "a log-polar buffer whose texels take turns; what they showed is kept",
            .rows = rows,
            .plan = plan,
            .check_picture = check_picture,
            .passes = passes};
}

}  // namespace gazeloop::methods
