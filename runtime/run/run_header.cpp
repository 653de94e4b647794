#include "runtime/run/run_header.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>

#include "runtime/environment.h"
#include "runtime/run/picture_device.h"
#include "runtime/version.h"

namespace gazeloop::run {
namespace {

/// Absolute, for a report that is made elsewhere; empty where there can be none.
std::string runtime_metrics_file(const std::string& target) {
    const auto file = environment_value("XRT_METRICS_FILE");
    return file && target == "openxr" ? std::filesystem::absolute(*file).string() : "";
}

std::string now_utc() {
    return fmt::format(
        "{:%Y-%m-%dT%H:%M:%SZ}",
        fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

}  // namespace

session::SessionHeader run_header(const FrameRunRequest& request,
                                  const display::DisplayProfile& display, latency::LoopClock clock,
                                  const present::FrameTarget& target,
                                  const vulkan::Context& context, const frame::PassList& passes,
                                  const frame::GridList& grids) {
    const std::string& name = request.settings->values().target.name;
    session::SessionHeader header;
    header.passes = passes;
    header.grids = grids;
    header.study = static_cast<bool>(request.record_study);
    header.meta = {.program = fmt::format("gazeloop {}", kVersion),
                   .command_line = request.command_line,
                   .started_utc = now_utc(),
                   .clock = clock,
                   .target = name,
                   .target_format = vk::to_string(target.format()),
                   .runtime_metrics = runtime_metrics_file(name),
                   .display = display};
    header.config = request.settings->list();
    for (const auto& [property, value] : target.properties()) {
        header.device.push_back({property, value});
    }
    for (NamedValue& one : picture_device(context)) {
        header.device.push_back(std::move(one));
    }
    return header;
}

}  // namespace gazeloop::run
