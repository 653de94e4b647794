#include "runtime/run/probe_run.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/probe/instructions.h"
#include "runtime/probe/live_probe.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/run/run_checks.h"

namespace gazeloop::run {

std::optional<ErrorKind> probe_run(const ProbeRun& wanted, FrameRunRequest request,
                                   ProgramSettings& settings) {
    // Where the patch is, the scene's depth would be wrong.
    value_or_throw(settings.set("render.depth", "false", "gazeloop probe"));
    const std::string& json = wanted.json;
    const bool quiet = wanted.quiet;
    // With JSON on stdout, nothing else goes there.
    std::FILE* const out = json == "-" ? stderr : stdout;
    request.json.reset();  // the probe's own result goes there
    request.quiet = quiet || json == "-";
    check_results(request, {{"--json", json}});
    if (!quiet) {
        fmt::print(out, "{}\n", probe::kInstructions);
        std::fflush(out);
    }
    probe::FlipLog log;
    request.make_overlay = [&](const vulkan::Context& context,
                               const render::RendererConfig& config) {
        return std::make_unique<probe::LiveProbe>(context, config.frames_in_flight,
                                                  settings.values().gaze.minimum_confidence, log);
    };
    const auto trials = static_cast<std::uint64_t>(wanted.trials.value_or(ProbeRun::kTrials));
    // A length that was asked for holds, unless trials were too.
    const bool until_trials = wanted.trials || request.loop.end_with_source;
    request.loop.stop = [&log, trials, until_trials]() -> std::optional<LoopEnd> {
        return until_trials && log.lamp_flashes() >= trials ? std::optional(LoopEnd::Limit)
                                                            : std::nullopt;
    };
    const auto failure = frame_run(request);
    if (!quiet) {
        fmt::print(out, "\n{}", probe::flips_text(log));
    }
    if (!json.empty()) {
        value_or_throw(report::write_text(json, report::json_text(probe::flips_json(log))));
    }
    return failure;
}

}  // namespace gazeloop::run
