#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "runtime/session/session_file.h"
#include "runtime/time/clock.h"
#include "tests/bench/bench.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watch/played_gaze.h"
#include "tests/support/watch/watched_call.h"
#include "tests/support/watch/watched_loop.h"

namespace gazeloop::bench {
namespace {

using tests::WatchedFrame;

constexpr const char* kBench = "loop";
constexpr std::size_t kWarmUp = 60;

struct Case {
    const char* name;
    tests::WatchedLoop loop;
    bool tail;  ///< frames enough for a 99th percentile
};

/// The smallest value that the share of all values does not exceed. Precondition: not empty.
double percentile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

std::vector<double> of_each(const std::vector<WatchedFrame>& frames,
                            const std::function<double(const WatchedFrame&)>& value) {
    std::vector<double> values;
    for (std::size_t i = kWarmUp; i < frames.size(); ++i) {
        const double one = value(frames[i]);
        if (one >= 0.0) {
            values.push_back(one);
        }
    }
    return values;
}

/// The loop's own work in each frame. Readings of the clock around each watched call are taken off,
/// as measured on calls that do nothing.
void add_work(const Case& at, const std::vector<WatchedFrame>& frames,
              std::vector<Figure>& figures) {
    const double watching_ns = static_cast<double>(tests::cpu_ns_of_watching_a_call());
    const auto own_us = of_each(frames, [&](const WatchedFrame& frame) {
        const double ns =
            static_cast<double>(frame.cpu_ns) - watching_ns * static_cast<double>(frame.calls);
        return std::max(0.0, ns) * 1e-3;
    });
    const auto fovea_us = of_each(frames, [](const WatchedFrame& frame) {
        return static_cast<double>(frame.gaze.fovea_ns) * 1e-3;
    });
    const auto vulkan_us = of_each(frames, [](const WatchedFrame& frame) {
        return static_cast<double>(frame.gaze.vulkan_ns) * 1e-3;
    });
    const auto allocations = of_each(
        frames, [](const WatchedFrame& frame) { return static_cast<double>(frame.allocations); });
    const auto calls =
        of_each(frames, [](const WatchedFrame& frame) { return static_cast<double>(frame.calls); });
    const auto add = [&](const char* metric, double value, const char* unit,
                         std::optional<double> target) {
        figures.push_back({kBench, at.name, metric, value, unit, "lower", std::nullopt, target});
    };
    add("gaze to fovea, p50", percentile(fovea_us, 0.5), "us", std::nullopt);
    add("gaze to first Vulkan call, p50", percentile(vulkan_us, 0.5), "us", std::nullopt);
    add("own CPU a frame, p50", percentile(own_us, 0.5), "us", std::nullopt);
    if (at.tail) {
        add("gaze to fovea, p99", percentile(fovea_us, 0.99), "us", 50.0);
        add("gaze to first Vulkan call, p99", percentile(vulkan_us, 0.99), "us", std::nullopt);
        add("own CPU a frame, p99", percentile(own_us, 0.99), "us", 300.0);
    }
    add("most allocations a frame", *std::ranges::max_element(allocations), "", 0.0);
    add("Vulkan and OpenXR calls", percentile(calls, 0.5), "", std::nullopt);
}

/// A runtime's one ray for both eyes, split at a distance or where the last frame's depth says:
/// turn by turn, so that what else the machine does meets both.
void add_split_gaze(const Options& options, std::vector<Figure>& figures) {
    const std::array cases{Case{"openxr gaze, by distance",
                                {.openxr = true,
                                 .openxr_gaze = true,
                                 .from_depth = false,
                                 .scale = 0.25,
                                 .frames = 560},
                                true},
                           Case{"openxr gaze, by depth",
                                {.openxr = true, .openxr_gaze = true, .scale = 0.25, .frames = 560},
                                true}};
    std::array<std::vector<WatchedFrame>, cases.size()> frames;
    const tests::PlayedGaze gaze;
    for (unsigned round = 0; round < options.rounds; ++round) {
        for (std::size_t i = 0; i < cases.size(); ++i) {
            if (!options.wants(cases[i].name)) {
                continue;
            }
            const auto more = tests::run_watched_loop(cases[i].loop);
            frames[i].insert(frames[i].end(), more.begin() + kWarmUp, more.end());
        }
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (!frames[i].empty()) {
            add_work(cases[i], frames[i], figures);
        }
    }
}

constexpr const char* kMemoryCase = "10,000 frames, headless";

/// Growth of the process over the second half of 10,000 frames, by least squares.
void add_memory(std::vector<Figure>& figures) {
    const tests::TemporaryFolder folder;
    const auto frames = tests::run_watched_loop({.paced = false,
                                                 .scale = 0.01,
                                                 .frames = 10'000,
                                                 .resident_every = 250,
                                                 .record = folder / "session.gaze"});
    double n = 0.0;
    double x = 0.0;
    double y = 0.0;
    double xx = 0.0;
    double xy = 0.0;
    for (std::size_t i = frames.size() / 2; i < frames.size(); ++i) {
        if (frames[i].resident_bytes > 0) {
            const double frame = static_cast<double>(i);
            const double bytes = static_cast<double>(frames[i].resident_bytes);
            n += 1.0;
            x += frame;
            y += bytes;
            xx += frame * frame;
            xy += frame * bytes;
        }
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x);
    figures.push_back(
        {kBench, kMemoryCase, "memory growth a frame", slope, "B", "lower", std::nullopt, 16.0});
}

/// From the start of the program to the end of its first frame.
void add_start_up(const char* target, const Options& options, std::vector<Figure>& figures) {
    const std::string name = fmt::format("start-up, {}", target);
    if (!options.wants(name)) {
        return;
    }
    std::vector<double> start_ms;
    for (unsigned round = 0; round < options.rounds; ++round) {
        const tests::ScratchFolder folder;
        const std::string session = folder.file("session.gaze");
        const std::int64_t start_ns = time::monotonic_ns();
        const tests::ProgramResult result =
            tests::run_gazeloop({"run", "--target", target, "--frames", "1", "--set",
                                 "render.scale=0.25", "--record", session});
        if (result.exit_code != 0) {
            throw std::runtime_error(result.err);
        }
        const auto recorded = value_or_throw(session::read_session(session));
        const std::int64_t end_ns = recorded.frames.at(0).frame.stamps.end_frame.ns;
        start_ms.push_back(static_cast<double>(end_ns - start_ns) * 1e-6);
    }
    figures.push_back({kBench, name, "to the first frame", median(start_ms), "ms", "lower"});
}

}  // namespace

std::vector<Figure> loop(const Options& options) {
    spdlog::set_level(spdlog::level::warn);
    const std::array cases{
        Case{"headless 320x360, 70 Hz", {.scale = 0.25, .frames = 1060}, true},
        Case{"headless 1280x1440", {.paced = false, .scale = 1.0, .frames = 110}, false},
        Case{"openxr 320x360, 70 Hz", {.openxr = true, .scale = 0.25, .frames = 1060}, true}};
    std::vector<Figure> figures;
    for (const Case& at : cases) {
        if (!options.wants(at.name)) {
            continue;
        }
        const tests::TemporaryFolder folder;
        tests::WatchedLoop watched = at.loop;
        watched.record = folder / "session.gaze";
        add_work(at, tests::run_watched_loop(watched), figures);
    }
    if (options.wants(kMemoryCase)) {
        add_memory(figures);
    }
    add_split_gaze(options, figures);
    for (const char* target : {"headless", "openxr"}) {
        add_start_up(target, options, figures);
    }
    return figures;
}

}  // namespace gazeloop::bench
