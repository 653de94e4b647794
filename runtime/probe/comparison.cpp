#include "runtime/probe/comparison.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "runtime/session/playback.h"

namespace gazeloop::probe {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json delay_json(const std::optional<MeasuredDelay>& delay) {
    if (!delay) {
        return nullptr;
    }
    return {{"trials", delay->trials},
            {"mean_ms", delay->mean_ms},
            {"uncertain_ms", or_null(delay->uncertain_ms)},
            {"min_ms", delay->min_ms},
            {"max_ms", delay->max_ms}};
}

std::string delay_text(const MeasuredDelay& delay) {
    return fmt::format("{:.1f} ms, uncertain by {}, {:.1f} to {:.1f} ms in {} trials",
                       delay.mean_ms,
                       delay.uncertain_ms ? fmt::format("{:.1f} ms (95 %)", *delay.uncertain_ms)
                                          : "what one trial does not show",
                       delay.min_ms, delay.max_ms, delay.trials);
}

std::string difference_text(const Comparison& comparison) {
    const double longer_ms = *comparison.longer_by_ms();
    const std::optional<double>& uncertain_ms = comparison.measured.eye_lost->uncertain_ms;
    std::string text = fmt::format("{:.1f} ms {} than modelled", std::abs(longer_ms),
                                   longer_ms < 0.0 ? "shorter" : "longer");
    if (!uncertain_ms) {
        return text;
    }
    if (std::abs(longer_ms) <= *uncertain_ms) {
        return text + ", which is within the measurement's uncertainty";
    }
    return text + (longer_ms > 0.0
                       ? ", more than its uncertainty: tracker or display take longer than their "
                         "profiles say, or the tracker is slow to say that it lost the eye"
                       : ", more than its uncertainty: a profile claims too much delay, or this "
                         "session is not of the measured set-up");
}

}  // namespace

std::optional<double> Comparison::expected_ms() const {
    return modelled.mean_ms ? std::optional(*modelled.mean_ms - begin_to_middle_ms.value_or(0.0))
                            : std::nullopt;
}

std::optional<double> Comparison::longer_by_ms() const {
    const std::optional<double> expected = expected_ms();
    return expected && measured.eye_lost ? std::optional(measured.eye_lost->mean_ms - *expected)
                                         : std::nullopt;
}

Expected<Comparison> compare(const Measurement& measured, const session::OpenSession& session,
                             const latency::SummaryConfig& config) {
    EventToPhotonModel model(config.switching_ns, config.period_ns);
    const std::array<frame::FrameObserver*, 1> observers{&model};
    if (auto played = session::play(session, observers); !played) {
        return std::unexpected(played.error());
    }
    Comparison comparison{
        .measured = measured, .modelled = model.result(), .begin_to_middle_ms = {}};
    if (measured.pulsed) {
        comparison.begin_to_middle_ms = 0.0;
    } else if (config.persistence_ns) {
        comparison.begin_to_middle_ms = static_cast<double>(*config.persistence_ns) / 2e6;
    }
    return comparison;
}

std::string comparison_text(const Comparison& comparison) {
    const Measurement& measured = comparison.measured;
    std::string text =
        fmt::format("\neye-to-photon measured by lamp and camera ({})\n", measured.source);
    auto out = std::back_inserter(text);
    if (!measured.eye_lost) {
        return text + "  the patch never followed the lamp: nothing was measured\n";
    }
    fmt::format_to(out, "  measured    {}\n", delay_text(*measured.eye_lost));
    if (const std::optional<double> expected = comparison.expected_ms()) {
        fmt::format_to(out,
                       "  modelled    {:.1f} ms ({}), for something that happens at any moment\n",
                       *expected, time::name(comparison.modelled.kind));
        fmt::format_to(out, "  difference  {}\n", difference_text(comparison));
        if (!comparison.begin_to_middle_ms) {
            text +=
                "              to the middle of a pixel's light, not its begin: the profile does "
                "not say how long it is lit\n";
        }
    } else {
        text += "  modelled    unknown: no frame's age of gaze is known\n";
    }
    if (measured.eye_found) {
        fmt::format_to(out, "  eye found   {}\n", delay_text(*measured.eye_found));
    }
    for (const std::string& warning : measured.warnings) {
        fmt::format_to(out, "  warning     {}\n", warning);
    }
    return text;
}

Json comparison_json(const Comparison& comparison) {
    return {{"source", comparison.measured.source},
            {"measured", delay_json(comparison.measured.eye_lost)},
            {"eye_found", delay_json(comparison.measured.eye_found)},
            {"warnings", comparison.measured.warnings},
            {"modelled",
             {{"frames", comparison.modelled.frames},
              {"kind", time::name(comparison.modelled.kind)},
              {"mean_ms", or_null(comparison.expected_ms())},
              {"sd_ms", or_null(comparison.modelled.sd_ms)},
              {"begin_to_middle_of_light_ms", or_null(comparison.begin_to_middle_ms)}}},
            {"longer_than_modelled_ms", or_null(comparison.longer_by_ms())}};
}

}  // namespace gazeloop::probe
