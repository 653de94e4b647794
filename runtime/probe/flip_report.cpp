#include <fmt/core.h>
#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "runtime/probe/flip_log.h"

namespace gazeloop::probe {
namespace {

using Json = nlohmann::ordered_json;

std::string milliseconds(const time::Span& span) {
    return span.known() ? fmt::format("{:.2f}", static_cast<double>(span.ns) / 1e6) : "-";
}

std::string_view cause(const Loss& loss) {
    const time::Span lasted = loss.lasted();
    if (!lasted.known()) {
        return "still lost";
    }
    return lasted.ns >= kLeastLamp_ns ? "lamp" : "blink";
}

Json stamp_json(const time::Stamp& stamp) {
    return {{"ns", stamp.known() ? Json(stamp.ns) : Json(nullptr)},
            {"kind", time::name(stamp.kind)}};
}

Json flip_json(const Flip& flip) {
    return {{"patch", flip.lost ? "white" : "black"},
            {"reason", gaze::kLossReasonNames[static_cast<std::size_t>(flip.reason)]},
            {"frame", flip.frame},
            {"sample",
             flip.sampled.known() || flip.arrived.known() ? Json(flip.sample) : Json(nullptr)},
            {"sampled", stamp_json(flip.sampled)},
            {"arrived", stamp_json(flip.arrived)},
            {"latched", stamp_json(flip.latched)},
            {"display", stamp_json(flip.display)},
            {"shown", stamp_json(flip.shown)}};
}

}  // namespace

std::string flips_text(const FlipLog& log) {
    const std::vector<Loss> losses = log.losses();
    std::size_t blinks = 0;
    std::size_t silent = 0;
    std::string rows;
    for (const Loss& loss : losses) {
        const Flip& flip = loss.lost;
        blinks += cause(loss) == "blink" ? 1 : 0;
        silent += flip.reason == gaze::LossReason::Stale ? 1 : 0;
        fmt::format_to(std::back_inserter(rows), "{:>8}  {:<11}{:>10}{:>20}{:>20}{:>20}\n",
                       flip.frame, cause(loss), milliseconds(loss.lasted()),
                       milliseconds(time::between(flip.sampled, flip.arrived)),
                       milliseconds(time::between(flip.sampled, flip.latched)),
                       milliseconds(time::between(flip.sampled, flip.shown)));
    }
    std::string text =
        fmt::format("patch    went white {} times: {} as long as a lamp, {} as short as a blink\n",
                    losses.size(), log.lamp_flashes(), blinks);
    if (silent > 0) {
        fmt::format_to(
            std::back_inserter(text),
            "silence  {} times no sample came for gaze.stale_ms, in place of one without "
            "an eye: the tracker\n         stops when it is blinded, and what the camera "
            "sees is longer by that time\n",
            silent);
    }
    if (log.not_kept() > 0) {
        fmt::format_to(std::back_inserter(text), "not kept {} further flips\n", log.not_kept());
    }
    if (losses.empty()) {
        return text + "The tracker never lost the eye: shine the lamp nearer to its camera.\n";
    }
    return text +
           fmt::format("\n{:>8}  {:<11}{:>10}{:>20}{:>20}{:>20}\n", "frame", "cause", "lost ms",
                       "sampled->arrived", "sampled->latched", "sampled->shown") +
           rows;
}

Json flips_json(const FlipLog& log) {
    Json losses = Json::array();
    for (const Loss& loss : log.losses()) {
        const time::Span lasted = loss.lasted();
        losses.push_back({{"cause", cause(loss)},
                          {"lasted_ns", lasted.known() ? Json(lasted.ns) : Json(nullptr)},
                          {"lost", flip_json(loss.lost)},
                          {"found", loss.found ? flip_json(*loss.found) : Json(nullptr)}});
    }
    return {{"format", "gazeloop-probe-run"},
            {"version", 1},
            {"lamp_flashes", log.lamp_flashes()},
            {"flips_not_kept", log.not_kept()},
            {"losses", losses}};
}

}  // namespace gazeloop::probe
